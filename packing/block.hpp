#pragma once
// Phase 1: one block of spheres, packed to the target porosity by gravity, shaking and a light lid.

#include <cstdint>
#include <vector>

#include "core/base/monitor.hpp"
#include "core/scene/particle_store.hpp"
#include "core/solver_options.hpp"
#include "kernels/contact_kernels.hpp"
#include "packing/density_range.hpp"
#include "packing/grading.hpp"
#include "packing/packing_options.hpp"

namespace grainfield::packing {

/// What the spheres are made of during the packing (Table 2 of Tran et al.).
struct Material {
    double density = 2600;              ///< [kg/m3]
    double normal_stiffness = 9e8;      ///< k_n [Pa]
    double stiffness_ratio = 0.1;       ///< k_s/k_n [-]
    double friction_angle = 0.6;        ///< phi [rad]
    core::Damping damping{0.2, 0.2};    ///< local [-]
    double wall_friction_angle = 0;     ///< [rad]
    double wall_stiffness_ratio = 0.2;  ///< k_s/k_n of the box [-]
};

/// Bulk weight of a packing [N/m3].
double bulk_unit_weight(const Material& material, double porosity, double gravity);

/// Above this share of the block's smallest side walls and few grains decide the sample [-].
inline constexpr double large_grain = 0.2;

struct Block {
    core::ParticleStore spheres;  ///< at rest in [0, size]
    core::ParticleStore hanging;  ///< the same spheres at rest under gravity reversed
    GradingDraw grading;
    Vec3 size{0, 0, 0};                    ///< b_x, b_y as it came out, b_z [m]
    DensityRange range;                    ///< that these spheres can have in this block
    double porosity = 0;                   ///< [-]
    double settled_height = 0;             ///< of the bed before compaction [m]
    double mean_stress = 0;                ///< a third of the trace, own weight included [Pa]
    double compaction_friction_angle = 0;  ///< the lowest friction that was needed [rad]
    std::int64_t steps = 0;                ///< taken [-]

    /// Diameter of the largest grain over the block's smallest side [-].
    double largest_grain() const { return grading.diameter.back() / size.minCoeff(); }
};

/// Packs one block. Spheres fall into the box, settle with full friction (the loosest state), and
/// are compacted by shaking under a light lid to the porosity or the relative density asked for:
/// the friction is lowered only as far as that needs and is restored for the final settling. With
/// `compaction_friction` they are shaken with that, and the porosity follows. How dense they can be
/// is found by shaking a copy without friction. Ends at rest with all centres inside and a mean
/// stress of no more than twice that of the block's own weight.
/// Throws InputError if the porosity cannot be reached, naming those that can.
Block pack_block(const PackingOptions& options, const Grading& grading, const Material& material,
                 const kernels::KernelTable& kernels, core::Monitor& monitor);

}  // namespace grainfield::packing
