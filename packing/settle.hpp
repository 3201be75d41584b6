#pragma once
// Brings a flipped sample to rest under gravity in a frictionless box.

#include "core/driver.hpp"

namespace grainfield::packing {

/// Gravity is switched on over one period of the sample's slowest vertical oscillation, so that it
/// leaves little motion behind, and the rest is taken out by the local damping and by stopping all
/// motion whenever the kinetic energy passes a maximum (dynamic relaxation). Ends when the
/// unbalanced force ratio is below 1e-3, the floor carries the weight within 0.2 % and the motion
/// is negligible. Walls: x low, x high, y low, [y high,] z low, z high or any box without a lid.
/// floor_wall is the index of the wall below; gravity g [m/s2] along -y.
void settle_under_gravity(core::Driver& driver, std::size_t floor_wall, double gravity, double height);

}  // namespace grainfield::packing
