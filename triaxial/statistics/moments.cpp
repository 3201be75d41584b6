#include "triaxial/statistics/moments.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "core/base/errors.hpp"

namespace grainfield::triaxial::statistics {
namespace {

// Sum of (x - centre)^power.
double central_sum(std::span<const double> values, double centre, int power) {
    double sum = 0;
    for (const double x : values) {
        const double d = x - centre;
        sum += power == 1 ? d : power == 2 ? d * d : d * d * d;
    }
    return sum;
}

}  // namespace

std::optional<double> mean(std::span<const double> values) {
    require_finite(values);
    if (values.empty()) return {};
    const auto n = static_cast<double>(values.size());
    const double first = std::accumulate(values.begin(), values.end(), 0.0) / n;
    // The second pass takes out the round-off of the first; equal values give themselves.
    return first + central_sum(values, first, 1) / n;
}

std::optional<double> standard_deviation(std::span<const double> values) {
    const auto centre = mean(values);
    if (values.size() < 2) return {};
    return std::sqrt(central_sum(values, *centre, 2) / static_cast<double>(values.size() - 1));
}

std::optional<double> coefficient_of_variation(std::span<const double> values) {
    const auto deviation = standard_deviation(values);
    if (!deviation) return {};
    const double centre = *mean(values);
    if (centre == 0) throw InputError("the coefficient of variation of values of mean zero");
    return *deviation / centre;
}

std::optional<double> skewness(std::span<const double> values) {
    const auto deviation = standard_deviation(values);
    if (values.size() < 3 || *deviation == 0) return {};
    const auto n = static_cast<double>(values.size());
    const double third = central_sum(values, *mean(values), 3) / std::pow(*deviation, 3);
    return third * n / ((n - 1) * (n - 2));
}

Interval interval_of_mean(double n, double mean, double deviation, double confidence) {
    const boost::math::students_t student(n - 1);
    const double half =
        quantile(complement(student, tail_of(confidence))) * deviation / std::sqrt(n);
    return {mean - half, mean + half};
}

Interval chi_square_interval_of_deviation(double n, double deviation, double confidence) {
    const boost::math::chi_squared chi2(n - 1);
    const double tail = tail_of(confidence);
    return {deviation * std::sqrt((n - 1) / quantile(complement(chi2, tail))),
            deviation * std::sqrt((n - 1) / quantile(chi2, tail))};
}

std::optional<Interval> interval_of_mean(std::span<const double> values, double confidence) {
    const auto deviation = standard_deviation(values);
    if (!deviation) return {};
    return interval_of_mean(static_cast<double>(values.size()), *mean(values), *deviation,
                            confidence);
}

std::optional<Interval> chi_square_interval_of_deviation(std::span<const double> values,
                                                         double confidence) {
    const auto deviation = standard_deviation(values);
    if (!deviation) return {};
    return chi_square_interval_of_deviation(static_cast<double>(values.size()), *deviation,
                                            confidence);
}

}  // namespace grainfield::triaxial::statistics
