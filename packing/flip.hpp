#pragma once
// Phase 2: the flip technique. A block is cloned by mirroring, block by block.

#include <array>
#include <cstdint>

#include "core/particle_store.hpp"

namespace grainfield::packing {

/// Fills n_x x n_y x n_z blocks with mirror images of the block [0, size]: rows by mirrors across
/// y-z planes, slices across x-z planes, the sample across x-y planes. Spheres come block by block
/// (i fastest, then j, then k) in the order they have in the block, and carry (i, j, k). A sphere
/// that touched a wall of the block with overlap d touches its image across that wall, each
/// overlapping the mirror plane by d.
core::ParticleStore flip(const core::ParticleStore& block, const Vec3& size,
                         const std::array<std::int32_t, 3>& blocks);

/// Orders the spheres of a block along a Z-order curve, so that neighbours in space are neighbours
/// in memory.
core::ParticleStore sort_in_space(const core::ParticleStore& block, const Vec3& size);

}  // namespace grainfield::packing
