#pragma once
// All pairs of spheres closer than a skin, by grids of cells that suit each size of sphere.

#include <vector>

#include "core/scene/particle_store.hpp"
#include "kernels/contact_kernels.hpp"

namespace grainfield::core {

/// Pairs (i < j) with |x_j - x_i| < r_i + r_j + skin, sorted by i, then j.
///
/// Spheres are sorted into levels by radius, a factor of two each, and every level has a grid of
/// its own whose cells fit its spheres; a sphere looks in the grids of its own and of larger
/// spheres. The work stays proportional to the number of spheres at any size range. Memory: a few
/// words a sphere, however far apart they lie. Positions must be finite.
/// skin >= 0 [m].
std::vector<kernels::Pair> find_pairs(const Vec3Column& position, const Column<double>& radius,
                                      double skin);

}  // namespace grainfield::core
