#pragma once
// Brings a sample to an isotropic stress with six servo walls.

#include <array>

#include "core/driver.hpp"
#include "core/servo.hpp"

namespace grainfield::packing {

/// Dimensions between the opposite walls of a box made by core::box_walls() [m].
Vec3 box_dimensions(const core::Simulation& simulation);
/// Area of the walls that face an axis [m2].
double wall_area(const Vec3& dimensions, int axis);
/// Mean compressive stress on the two walls that face an axis [Pa].
double axis_stress(const core::Simulation& simulation, int axis);

/// What the kinetic energy of a sample that is strained at `rate` [1/s] under `stress` [Pa] never
/// reaches while its step is short enough: ten times that of the motion imposed, and a hundredth of
/// stress times volume, many times the energy in the contacts [J].
double most_kinetic_energy(const core::Simulation& simulation, double rate, double stress);

struct IsotropicResult {
    std::int64_t steps = 0;             ///< [-]
    double unbalanced_force_ratio = 0;  ///< at the end [-]
    double stress_error = 0;            ///< largest of the six walls, relative [-]
};

/// Compresses until the unbalanced force ratio is below 1e-3 and every wall's stress within 0.2 %
/// of `stress` [Pa]. The scene's first six walls must be those of core::box_walls(). Gravity as the
/// scene has it. Walls stand still afterwards. Throws SimulationError if the state is not reached.
IsotropicResult compress_isotropically(core::Driver& driver, double stress);

}  // namespace grainfield::packing
