#pragma once
// The buffers of the Verlet lists, and how much of them motion has used up. A buffer is what a
// sphere may move, beyond the homogeneous strain of the box, before a list could miss a contact:
//
//                 radius      inner buffer      outer buffer
//     centre |---------------|-------------|---------------------->
//            inner list: pairs whose inner reaches meet; holds for tens of steps
//            outer list: pairs whose outer reaches meet; serves several inner lists
//
// Every sphere has its own, larger the faster it moves: loose spheres that fly about do not force a
// rebuild every few steps, and spheres that stay have few candidates.

#include "core/state/bytes.hpp"
#include "core/vector/domain_lists.hpp"

namespace grainfield::core {

/// What buffers are chosen by.
struct BufferRules {
    double inner, most_inner, least_inner;  ///< [m]
    double outer, most_outer;               ///< [m]
    kernels::AffineMotion rate;             ///< of the box at present [1/s]
    kernels::AffineMotion since_search;     ///< motion of the box
    double strain = 0;                      ///< the largest since the search [-]
};

/// What is left of a sphere's outer buffer for an inner one.
enum class Remainder { none, scarce, enough };

/// Spheres that are short of outer buffer.
struct Shortage {
    bool exhausted = false;            ///< some have none left for an inner list
    std::vector<std::int32_t> scarce;  ///< slots of these and of those that soon will, ascending
};

template <class T>
class VerletBuffers {
  public:
    VerletBuffers(const World& world, Decomposition<T>& sample);

    /// Where everything was when the inner lists were built, and the buffers since then.
    const BuiltState& built() const { return built_; }

    /// Largest share of any inner buffer that motion has used up; at 1 a contact may have been
    /// missed [-].
    double used() const;
    /// Foresees the motion of the box at the end of a step [s]: spheres are measured against it.
    void foresee(double step) { affine_ = affine_motion(step); }
    const kernels::AffineMotion& affine() const { return affine_; }
    /// The largest share of its inner buffer that a sphere's own motion has used up [-].
    void set_used_by_spheres(double share) { used_by_spheres_ = share; }

    /// Makes the present positions those of the inner list to be built. Throws SimulationError for
    /// the first that is not a number. With `outer_holds`, adds up the displacements since the
    /// search.
    void take_positions(bool outer_holds);
    /// Walls stand from now on where the inner lists were built.
    void take_walls();
    /// The inner lists are built: nothing of their buffers is used up.
    void begin_inner();
    /// Here and now is where the outer list is searched.
    void begin_outer();

    /// `outer_holds`: inner buffers are to be chosen, within those of the last search.
    BufferRules rules(bool outer_holds) const;
    /// Inner buffers of all spheres, within what motion since the search has left of the outer.
    Shortage choose_inner(const BufferRules& rules);
    /// Inner buffer of the k-th sphere of domain d; unchanged if there is none left.
    Remainder choose_inner(std::size_t d, std::size_t k, const BufferRules& rules);
    /// Outer buffer of the k-th sphere of a domain [m].
    double choose_outer(const Domain<T>& domain, std::size_t k, const BufferRules& rules);
    /// Gives a sphere that is searched for now a position at the last search: the one from which
    /// the strain of the box alone would have brought it here. So it fits into the old outer list.
    void join_outer(std::size_t slot, const BufferRules& rules);

    double outer(std::size_t slot) const { return double{outer_.buffer[slot]}; }  ///< [m]
    /// Where a sphere was at the search [m].
    Vec3 searched_position(std::size_t slot) const;

    template <class Archive>
    void serialize(Archive& archive) {
        archive(built_.position, bytes(built_.buffer), built_.wall_buffer, bytes(built_.walls),
                bytes(built_.reach), bytes(built_.middle), bytes(outer_.moved),
                bytes(outer_.buffer), bytes(outer_.walls), bytes(affine_), used_by_spheres_,
                reach_per_buffer_);
    }

  private:
    SlotRadii radii() const { return {sample_.order.sphere, world_.spheres().radius}; }
    kernels::AffineMotion affine_motion(double ahead) const;
    kernels::AffineMotion affine_rate() const;
    double foreseen_way(const Domain<T>& domain, std::size_t k, double steps,
                        const kernels::AffineMotion& rate) const;
    [[noreturn]] void name_lost_sphere(const Domain<T>& domain) const;

    const World& world_;
    Decomposition<T>& sample_;
    BuiltState built_;
    struct {
        Column<std::array<float, 3>> moved;  // since the search, by slot [m]
        Column<float> buffer;                // by slot [m]
        std::vector<Vec3> walls;             // their points [m]
    } outer_;
    kernels::AffineMotion affine_;  // of the box since the build, as the last step foresaw it
    double used_by_spheres_ = 0;    // [-]
    double reach_per_buffer_ = 0;   // largest (radius + buffer)/buffer [-]
};

/// Items of all parts, one part after the other.
template <class Item>
std::vector<Item> joined(const std::vector<std::vector<Item>>& parts) {
    std::vector<Item> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// What the box's strain takes from a sphere's buffer [m]: its half of the way that the strain
/// brings it closer to a neighbour.
inline double by_strain(double strain, double radius, double buffer) {
    return strain * (radius + buffer);
}

}  // namespace grainfield::core
