#pragma once
// Random samples for the tests of the statistics, and what chance allows a share to be.

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/random.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {

/// What a test that is right fails with, over all seeds there are [-].
constexpr double significance = 1e-6;

/// Sample number `which` of n standard normal values.
inline std::vector<double> normal_sample(std::uint64_t which, std::size_t n) {
    std::vector<double> values(n);
    core::RandomStream(2026, core::Stream::perturbation).normals(which, 0, values);
    return values;
}

inline std::vector<double> lognormal_sample(std::uint64_t which, std::size_t n, double sigma,
                                            double mu = 0) {
    std::vector<double> values = normal_sample(which, n);
    for (double& x : values) x = std::exp(mu + sigma * x);
    return values;
}

inline std::vector<double> uniform_sample(std::uint64_t which, std::size_t n) {
    const core::RandomStream stream(2026, core::Stream::perturbation);
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = stream.uniform(which, i);
    return values;
}

/// The interval of exact(p) successes' share in so many trials.
inline Interval share_of(double p, std::size_t trials) {
    const auto n = static_cast<double>(trials);
    const boost::math::binomial successes(n, p);
    return {quantile(successes, 0.5 * significance) / n,
            quantile(complement(successes, 0.5 * significance)) / n};
}

/// How far, at the significance, n values' empirical distribution can rise above their true one
/// anywhere: Massart 1990, one-sided.
inline double largest_excess(std::size_t n) {
    return std::sqrt(-std::log(significance) / (2 * static_cast<double>(n)));
}

/// The largest rise of p values' empirical distribution above the uniform one.
inline double excess_above_uniform(std::vector<double> p) {
    p = sorted(p);
    const auto n = static_cast<double>(p.size());
    double excess = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        excess = std::max(excess, static_cast<double>(i + 1) / n - p[i]);
    return excess;
}

/// The same below it.
inline double excess_below_uniform(std::vector<double> p) {
    for (double& x : p) x = 1 - x;
    return excess_above_uniform(p);
}

}  // namespace grainfield::triaxial::statistics
