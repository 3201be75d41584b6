#pragma once
// Brings a sample to an isotropic stress with servo walls.

#include <cstdint>

#include "core/drive/driver.hpp"

namespace grainfield::packing {

struct IsotropicResult {
    std::int64_t steps = 0;             ///< [-]
    double unbalanced_force_ratio = 0;  ///< at the end [-]
    double stress_error = 0;            ///< largest of the servo walls, relative [-]
};

/// Compresses until the unbalanced force ratio is below 1e-3 and every servo wall's stress within
/// 0.2 % of `stress` [Pa]. The scene's first six walls must be those of core::box_walls(). Under
/// gravity the wall that the spheres fall to stands, and carries `stress` and the weight; without,
/// all six are servo walls. Walls stand still afterwards. Throws SimulationError if the state is
/// not reached.
IsotropicResult compress_isotropically(core::Driver& driver, double stress);

}  // namespace grainfield::packing
