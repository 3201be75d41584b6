#pragma once
// The inner loop of the neighbour search: which of many points lie near one.

#include <cstddef>
#include <cstdint>

namespace grainfield::kernels {

/// Spheres as the search reads them, one column each; entries may be read up to most_lanes past the
/// end. Single precision: this search only proposes, callers add a margin for round-off and check.
struct PointColumns {
    const float *x, *y, *z;  ///< centres [m]
    const float* radius;     ///< [m]
};

/// Lists the points begin <= m < end whose surface is closer than `margin` [m] to that of the
/// sphere at (x, y, z). Writes their indices, ascending, to `found` (room for end - begin +
/// most_lanes of them) and returns how many they are. Uses the widest vectors of this machine; the
/// result does not depend on them beyond round-off of the distance.
std::size_t find_near(const PointColumns& points, std::size_t begin, std::size_t end, float x,
                      float y, float z, float radius, float margin, std::int32_t* found);

}  // namespace grainfield::kernels
