#pragma once
// Averages of one-dimensional correlations over two unit intervals: the factors of covariances.

#include <cstdint>
#include <span>

namespace grainfield::randomfield {

/// Average of exp(-u^2 tau^2), tau the distance of a point of one unit interval from a point of
/// another, `lag` further on:
///   F_k(u) = integral over v in [-1, 1] of (1 - |v|) exp(-u^2 (k + v)^2), u >= 0, k = |lag|.
/// Relative error below 1e-13 + 4e-16 u^2 (k - 1)^2, the second part that of any exponential [-].
double gaussian_cell_average(double u, std::int32_t lag);

/// values[k] = gaussian_cell_average(u, k).
void gaussian_cell_averages(double u, std::span<double> values);

/// The same of exp(-a |tau|), a > 0 [-].
double exponential_cell_average(double a, std::int32_t lag);

}  // namespace grainfield::randomfield
