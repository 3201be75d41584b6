#pragma once
// How mean and deviation settle as a campaign grows.

#include <cstddef>
#include <span>
#include <vector>

#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {

/// Mean and deviation of the first `count[k]` values, with their intervals; all vectors are of
/// one length.
struct Convergence {
    std::vector<std::size_t> count;            ///< 2, 3, ..., n [-]
    std::vector<double> mean;                  ///< [as the values]
    std::vector<Interval> mean_interval;       ///< Student's t [as the values]
    std::vector<double> deviation;             ///< over n - 1 [as the values]
    std::vector<Interval> deviation_interval;  ///< chi-square [as the values]
};

/// Running moments in the order of the values, by Welford's update (1962, Technometrics 4). The
/// intervals are moments.hpp's classical ones; that of the deviation is too narrow for values of
/// heavier tails than the normal's. Empty below two values. Throws InputError for values that are
/// not finite.
Convergence convergence(std::span<const double> values, double confidence = 0.95);

}  // namespace grainfield::triaxial::statistics
