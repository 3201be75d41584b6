#pragma once
// The reference engine: scalar, double precision, one pass after the other, written to be read.
// Its results are the same, bit for bit, for any number of threads, any skin and any age of the
// lists.

#include "core/engine.hpp"
#include "core/reference/contact_list.hpp"

namespace grainfield::core {

/// What the kernels need of spheres begin <= i < end that follows from their masses.
struct Inertias {
    Column<double> inverse_mass, inverse_inertia;  ///< [1/kg], [1/(kg m2)]

    Inertias() = default;
    Inertias(const World& world, std::size_t begin, std::size_t end);
};

class ReferenceEngine : public Engine {
  public:
    ReferenceEngine(World& world, const kernels::ReferenceKernels& kernels)
        : Engine(world), kernels_(kernels) {
        upload();
    }

    void compute_forces(bool sums) override;
    void move(double step) override;
    void download() override {}
    void download_resultants() override {}
    void upload() override;
    void scale_velocities(double factor) override;
    void forget_walls() override { contacts_.forget_walls(); }
    void invalidate_lists() override;
    std::vector<TouchingContact> touching() const override;
    std::int64_t touching_count() const override;
    std::int64_t candidate_count() const override {
        return static_cast<std::int64_t>(contacts_.size());
    }
    std::vector<kernels::Pair> neighbours() const override {
        return {contacts_.pairs().begin(), contacts_.pairs().end()};
    }
    double resultant_sum() override;
    std::size_t restore(std::span<const ContactShear> contacts) override {
        std::size_t found = 0;
        for (const auto& [i, j, shear] : contacts) found += contacts_.restore(i, j, shear);
        return found;
    }
    void save(StateWriter& archive) const override;
    void load(StateReader& archive) override;
    bool suspicious() const override { return true; }
    bool alarmed() const override;
    std::int64_t list_builds() const override { return contacts_.builds(); }

  private:
    void wall_forces(bool sums);
    bool lists_outdated() const;
    double unpaired_wall_motion() const;
    kernels::AffineMotion affine_motion(double ahead) const;  // in so many seconds [s]
    kernels::SphereColumns sphere_columns() const;
    kernels::ContactParameters contact_parameters() const;

    const kernels::ReferenceKernels& kernels_;
    ContactList contacts_;
    Column<double> friction_;             // tan(phi) [-]
    Inertias inertias_;                   // of all spheres
    double max_square_displacement_ = 0;  // since the lists were built, beyond affine [m2]
};

/// Columns of a world's spheres from `begin` on for the kernels that move them and measure their
/// motion; `inertias` begin there too and have to last as long as the columns are used.
kernels::MotionColumns motion_columns(World& world, std::size_t begin, const Inertias& inertias);
/// Parameters of a step of length new_step [s]; 0 to measure.
kernels::MotionParameters motion_parameters(const World& world, double new_step);

}  // namespace grainfield::core
