#pragma once
// Places spheres at random without overlap.

#include <cstdint>

#include "core/base/monitor.hpp"
#include "core/scene/particle_store.hpp"

namespace grainfield::packing {

/// Moves the spheres of the store (radii set) to random places in a box of base `width` x `depth`,
/// as tall as it takes [m], floor at y = 0; no two overlap and none reaches out. Large spheres are
/// placed first. Returns the height of the box [m].
/// Throws InputError if a sphere does not fit between the side walls, and Interrupted where the
/// monitor asks to stop.
double place_at_random(core::ParticleStore& spheres, double width, double depth, double height,
                       std::uint64_t seed, core::Monitor* monitor = nullptr);

}  // namespace grainfield::packing
