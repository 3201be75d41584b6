#pragma once
// Exact covariance between local averages of a unit-variance field over equal cells.

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/vec3.hpp"
#include "randomfield/covariance/correlation.hpp"

namespace grainfield::randomfield {

/// Covariance of the averages over two cells of one grid, by their distance in cells, tabulated
/// once for all lags below `lags` in each direction. Relative error at most 1e-12 (tested against
/// independent integrations) for any aspect of the cells, theta of 1e-3 cells to 1e4 domains, as
/// far as the numbers are normal ones (above 1e-300).
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
    std::vector<double> table_;  ///< x fastest
};

}  // namespace grainfield::randomfield
