#pragma once
// What a packing is asked to be: grading, block, clones, porosity.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/vec3.hpp"

namespace grainfield::packing {

/// Sieve curve by mass (Table 1 of Tran et al.), linear in the diameter between sieves.
struct Grading {
    std::vector<double> sieve_diameter{0.010, 0.020, 0.040, 0.100, 0.160, 0.200};  ///< [m]
    std::vector<double> passing{0, 0, 31.47, 90.93, 99.64, 100};                   ///< by mass [%]

    /// Throws InputError naming the key and value: sieves ascending and positive, passing
    /// non-decreasing from 0 to 100, as many of one as of the other, at least two.
    void validate() const;
};

/// Spheres that can be numbered in 32 bits, with room for the search of a count [-].
inline constexpr std::int32_t most_spheres = 500'000'000;

struct PackingOptions {
    std::uint64_t seed = 1;                        ///< of the block's draw and placing [-]
    Vec3 block{0.25, 0.25, 0.25};                  ///< b_x, b_y, b_z [m]
    std::array<std::int32_t, 3> blocks{6, 12, 6};  ///< n_x, n_y, n_z [-]
    double porosity = 0.40;                        ///< of the block [-]
    /// In place of the porosity, which then only counts the spheres: the block is as high as it
    /// comes out. Relative density [-]; friction angle while it is shaken [rad].
    std::optional<double> relative_density, compaction_friction;
    double gravity = 9.81;                ///< along -y [m/s2]
    std::optional<std::int32_t> spheres;  ///< fixes the count of one block [-]
    /// Isotropic stress the sample is brought to after settling, gravity switched off; unset: the
    /// sample stays settled under gravity [Pa]
    std::optional<double> isotropic_stress;
    std::int32_t max_spheres = 1'000'000;  ///< expected in one block: more are refused [-]

    void validate() const;  ///< throws InputError naming field, value and what is allowed
};

}  // namespace grainfield::packing
