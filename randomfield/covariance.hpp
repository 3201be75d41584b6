#pragma once
// Exact covariance between local averages of the Markov field over equal cells, Eq. (10).

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/vec3.hpp"
#include "randomfield/correlation.hpp"

namespace grainfield::randomfield {

/// Average of exp(-u^2 tau^2), tau the distance of a point of one unit interval from a point of
/// another, `lag` further on:
///   F_k(u) = integral over v in [-1, 1] of (1 - |v|) exp(-u^2 (k + v)^2), u >= 0, k = |lag|.
/// Good to 1e-14 relative where it is not negligible (public for its tests) [-].
double gaussian_cell_average(double u, std::int32_t lag);

/// Covariance of the averages of a unit-variance field over two cells of one grid, by their
/// distance in cells. Tabulated once for all lags below `lags` in each direction.
class LocalAverageCovariance {
  public:
    /// cell_size in metres, all > 0.
    LocalAverageCovariance(const Vec3& cell_size, const CorrelationModel& correlation,
                           const std::array<std::int32_t, 3>& lags);

    /// Covariance at a lag in cells; the sign does not matter [-].
    [[nodiscard]] double operator()(std::int32_t i, std::int32_t j, std::int32_t k) const;

    /// Variance of one cell's average, gamma(D): below 1 [-].
    [[nodiscard]] double gamma() const { return table_[0]; }

  private:
    std::array<std::int32_t, 3> lags_;
    std::vector<double> table_;
};

}  // namespace grainfield::randomfield
