#pragma once
// Brings a flipped sample to rest under gravity in a frictionless box.

#include "core/drive/driver.hpp"

namespace grainfield::packing {

/// Runs with the scene's damping until the unbalanced force ratio is below 1e-2 (loose spheres that
/// still roll or bounce in their pores included), the floor carries the weight within 1 % and the
/// kinetic energy is negligible; what little motion is left is then stopped. `floor_wall` is the
/// index of the wall below, gravity g [m/s2] acts along -y, `height` [m] is the sample's.
/// Throws SimulationError if the sample does not come to rest.
void settle_under_gravity(core::Driver& driver, std::size_t floor_wall, double gravity,
                          double height);

}  // namespace grainfield::packing
