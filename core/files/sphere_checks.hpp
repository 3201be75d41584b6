#pragma once
// Checks of a sample when it is loaded, before any computing. Both throw InputError that names the
// source (a file), the sphere's id (its index from 0), its line where known, and what is allowed.

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "core/scene/particle_store.hpp"

namespace grainfield::core {

/// Largest overlap of two spheres of a sample, relative to the smaller radius [-]. Stresses of the
/// paper's size give some 1e-4; a tenth is no state of a granular material but a wrong file.
inline constexpr double largest_relative_overlap = 0.1;

/// At least one sphere, every number finite, radii > 0, masses and stiffnesses >= 0, friction
/// angles in [0, pi/2). `lines`: SphereFile::lines, or empty.
void check_spheres(const ParticleStore& spheres, const std::string& source,
                   std::span<const std::int32_t> lines = {});

/// No two spheres overlap by more than largest_relative_overlap. `candidates` holds every pair
/// that may touch, once or twice, in any order; the message names the worst and the number.
void check_overlaps(const ParticleStore& spheres,
                    std::span<const std::pair<std::int32_t, std::int32_t>> candidates,
                    const std::string& source, std::span<const std::int32_t> lines = {});

}  // namespace grainfield::core
