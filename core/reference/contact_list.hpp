#pragma once
// Candidates for contacts between spheres and with walls, their history, and who takes part in
// which: rebuilt only when the motion since the last build could have brought a new pair together.

#include <span>
#include <vector>

#include "core/scene/particle_store.hpp"
#include "core/scene/scene.hpp"
#include "core/state/bytes.hpp"
#include "kernels/sphere_kernels.hpp"

namespace grainfield::core {

class ContactList {
  public:
    std::span<const kernels::Pair> pairs() const { return pairs_; }
    std::span<const kernels::WallPair> wall_pairs() const { return wall_pairs_; }
    std::size_t size() const { return pairs_.size() + wall_pairs_.size(); }

    /// Starts of the ranges of pairs() whose sums are added up apart, and the end of the last. A
    /// range holds the pairs of one chunk of first spheres: its sum does not depend on the skin.
    std::span<const std::size_t> pair_ranges() const { return pair_ranges_; }
    /// The same for wall_pairs(): one wall's spheres of one chunk.
    std::span<const std::size_t> wall_ranges() const { return wall_ranges_; }

    /// Columns of the sphere pairs, indexed like pairs().
    kernels::ContactColumns pair_columns() { return columns(0); }
    /// Columns of the wall contacts, indexed like wall_pairs().
    kernels::ContactColumns wall_columns() { return columns(pairs_.size()); }
    /// Columns of both, sphere pairs first, as incidences index them.
    kernels::ContactColumns all_columns() { return columns(0); }

    bool touching(std::size_t contact) const { return touching_[contact] != 0; }
    const Vec3& shear(std::size_t contact) const { return shear_[contact]; }
    const Vec3& force(std::size_t contact) const { return force_[contact]; }

    const std::uint32_t* offsets() const { return offsets_.data(); }
    const kernels::Incidence* incidences() const { return incidences_.data(); }

    /// Finds all candidates within the skin [m]; contacts keep their history. Throws
    /// SimulationError if a position is not finite.
    void build(const ParticleStore& spheres, std::span<const Wall> walls, double skin);

    /// Restores the history of a contact (used when a saved state is loaded): j >= 0 a sphere,
    /// -1-w a wall. Returns false if they are no candidates.
    bool restore(std::int32_t i, std::int32_t j, const Vec3& shear);

    /// Drops all wall candidates and their history; the next build finds new ones.
    void forget_walls();

    /// True before the first build and after forget_walls().
    bool stale() const { return stale_; }
    double skin() const { return skin_; }
    const Vec3Column& built_position() const { return built_position_; }   ///< [m]
    const std::vector<Vec3>& built_walls() const { return built_walls_; }  ///< wall points [m]
    std::int64_t builds() const { return builds_; }

    template <class Archive>
    void serialize(Archive& archive) {
        archive(bytes(pairs_), bytes(wall_pairs_), bytes(pair_ranges_), bytes(wall_ranges_),
                bytes(shear_), bytes(force_), bytes(moment_), bytes(touching_), bytes(offsets_),
                bytes(incidences_), built_position_, bytes(built_walls_), stale_, skin_, builds_);
    }

  private:
    kernels::ContactColumns columns(std::size_t first);
    void carry_history(std::span<const kernels::Pair> old_pairs,
                       std::span<const kernels::WallPair> old_wall_pairs,
                       const Column<Vec3>& old_shear, const Column<std::uint8_t>& old_touching);
    void index_incidences(std::size_t spheres);

    std::vector<kernels::Pair> pairs_;
    std::vector<kernels::WallPair> wall_pairs_;
    std::vector<std::size_t> pair_ranges_{0}, wall_ranges_{0};
    Column<Vec3> shear_, force_, moment_;
    Column<std::uint8_t> touching_;
    std::vector<std::uint32_t> offsets_;
    std::vector<kernels::Incidence> incidences_;
    Vec3Column built_position_;
    std::vector<Vec3> built_walls_;
    bool stale_ = true;
    double skin_ = 0;
    std::int64_t builds_ = 0;
};

}  // namespace grainfield::core
