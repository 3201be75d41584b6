#include "triaxial/statistics/bootstrap.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial::statistics {
namespace {

// C(9, 5) = 126 different resamples of five values, but 10 of three.
constexpr std::size_t fewest_resampled = 5;

// Acceleration, Efron & Tibshirani Eq. (14.15): a sixth of the skewness of the jackknife
// replicates' influence, zero where there is none.
double acceleration(std::span<const double> jackknife) {
    const double centre = *mean(jackknife);
    double squares = 0;
    double cubes = 0;
    for (const double theta : jackknife) {
        const double d = centre - theta;
        squares += d * d;
        cubes += d * d * d;
    }
    return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0.0;
}

std::optional<Interval> interval_of(std::span<const double> values, const Statistic& statistic,
                                    double confidence, const Resampling& resampling) {
    tail_of(confidence);
    resampling.validate();
    if (values.size() < fewest_resampled) return {};
    if (std::ranges::min(values) == std::ranges::max(values)) return {};
    return bca_interval(statistic(values), bootstrap_replicates(values, statistic, resampling),
                        jackknife_replicates(values, statistic), confidence);
}

}  // namespace

std::vector<double> bootstrap_replicates(std::span<const double> values, const Statistic& statistic,
                                         const Resampling& resampling) {
    resampling.validate();
    if (values.empty()) throw InputError("a bootstrap of no values");
    const core::RandomStream stream(resampling.seed, core::Stream::bootstrap);
    std::vector<double> sample(values.size());
    std::vector<double> replicates(resampling.resamples);
    for (std::size_t r = 0; r < replicates.size(); ++r) {
        std::array<std::uint32_t, 4> words{};
        for (std::size_t i = 0; i < sample.size(); ++i) {
            if (i % 4 == 0) words = stream.bits(r, i / 4);
            // A 32-bit fraction times n: no value is favoured by more than n/2^32.
            sample[i] = values[(std::uint64_t{words[i % 4]} * values.size()) >> 32];
        }
        replicates[r] = statistic(sample);
    }
    return replicates;
}

std::vector<double> jackknife_replicates(std::span<const double> values,
                                         const Statistic& statistic) {
    if (values.size() < 2) throw InputError("a jackknife of fewer than two values");
    std::vector<double> sample(values.begin() + 1, values.end());
    std::vector<double> replicates(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        replicates[i] = statistic(sample);
        // The sample that lacks value i + 1 differs from this one in its i-th place.
        if (i < sample.size()) sample[i] = values[i];
    }
    return replicates;
}

std::optional<Interval> bca_interval(double estimate, std::span<const double> bootstrap,
                                     std::span<const double> jackknife, double confidence) {
    const double tail = tail_of(confidence);
    const std::vector<double> ascending = sorted(bootstrap);
    const auto [first, last] = std::equal_range(ascending.begin(), ascending.end(), estimate);
    // Eq. (14.14); replicates equal to the estimate count by half.
    const double below =
        0.5 * static_cast<double>((first - ascending.begin()) + (last - ascending.begin())) /
        static_cast<double>(ascending.size());
    if (!(below > 0 && below < 1)) return {};
    const boost::math::normal normal;
    const double bias = quantile(normal, below);
    const double a = acceleration(jackknife);
    // Eq. (14.10): the levels at which the replicates' quantiles are read.
    const auto end_at = [&](double p) -> std::optional<double> {
        const double w = bias + quantile(normal, p);
        if (1 - a * w <= 0) return {};
        return sample_quantile(ascending, cdf(normal, bias + w / (1 - a * w)));
    };
    const auto lower = end_at(tail);
    const auto upper = end_at(1 - tail);
    if (!lower || !upper) return {};
    return Interval{*lower, *upper};
}

std::optional<Interval> bootstrap_interval_of_deviation(std::span<const double> values,
                                                        double confidence,
                                                        const Resampling& resampling) {
    require_finite(values);
    return interval_of(
        values, [](std::span<const double> x) { return *standard_deviation(x); }, confidence,
        resampling);
}

std::optional<Interval> bootstrap_interval_of_variation(std::span<const double> values,
                                                        double confidence,
                                                        const Resampling& resampling) {
    require_positive(values);
    return interval_of(
        values, [](std::span<const double> x) { return *coefficient_of_variation(x); }, confidence,
        resampling);
}

}  // namespace grainfield::triaxial::statistics
