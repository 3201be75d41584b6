#pragma once
// Phase 2: the flip technique. A block is cloned by mirroring, block by block.

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/particle_store.hpp"

namespace grainfield::packing {

/// Fills n_x x n_y x n_z blocks with mirror images of the block [0, size]: rows by mirrors across
/// y-z planes, slices across x-z planes, the sample across x-y planes. Spheres come block by block
/// (i fastest, then j, then k) in the order they have in the block, and carry (i, j, k). A sphere
/// that touched a wall of the block with overlap d touches its image across that wall, each
/// overlapping the mirror plane by d.
///
/// The rows of odd j stand on their heads. `hanging` is the same block (sphere by sphere) as it is
/// mirrored into them; it may have been settled under gravity reversed, so that loose spheres do
/// not have to fall across their pores in every clone.
core::ParticleStore flip(const core::ParticleStore& block, const core::ParticleStore& hanging,
                         const Vec3& size, const std::array<std::int32_t, 3>& blocks);

/// Order of the spheres of a block along a Z-order curve, so that neighbours in space are
/// neighbours in memory.
std::vector<std::size_t> order_in_space(const core::ParticleStore& block, const Vec3& size);

/// The spheres in the order given: the k-th of the result is the order[k]-th.
core::ParticleStore reordered(const core::ParticleStore& spheres,
                              const std::vector<std::size_t>& order);

}  // namespace grainfield::packing
