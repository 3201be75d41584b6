#pragma once
// Local averages of the spherical correlation, which has a tip at zero lag and ends at its range.

#include <array>
#include <cstdint>
#include <span>

#include "kernels/vec3.hpp"

namespace grainfield::randomfield {

/// Covariance of two cells' averages of 1 - 3/2 h + 1/2 h^3 (0 for h >= 1), for all lags below
/// `lags`, x fastest, into `table`. `edge`: the cells' edges in units of the range, all > 0.
void spherical_cell_averages(const Vec3& edge, const std::array<std::int32_t, 3>& lags,
                             std::span<double> table);

}  // namespace grainfield::randomfield
