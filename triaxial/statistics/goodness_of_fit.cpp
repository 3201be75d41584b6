#include "triaxial/statistics/goodness_of_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace grainfield::triaxial::statistics {
namespace {

// Below this Table 4.7's modification of A^2 is not good to its third digit, and D tells little.
constexpr std::size_t fewest_tested = 8;

/// The fit that the distance tests measure from: deviations are over n - 1, as in their tables.
Fit tested_fit(Family family, std::span<const double> values) {
    Fit tested = fit(family, values);
    const auto n = static_cast<double>(values.size());
    if (family == Family::normal) tested.parameters[1] *= std::sqrt(n / (n - 1));
    return tested;
}

/// D = max over the values in order of i/n - F(x_i) and F(x_i) - (i - 1)/n.
double kolmogorov_smirnov(const Fit& fit, std::span<const double> ascending) {
    const auto n = static_cast<double>(ascending.size());
    double distance = 0;
    for (std::size_t i = 0; i < ascending.size(); ++i) {
        const double f = fit.cdf(ascending[i]);
        const auto rank = static_cast<double>(i);
        distance = std::max({distance, (rank + 1) / n - f, f - rank / n});
    }
    return distance;
}

/// A^2 = -n - 1/n sum of (2i - 1) (ln F(x_i) + ln(1 - F(x_(n+1-i)))).
double anderson_darling(const Fit& fit, std::span<const double> ascending) {
    // A value that far out in the tail counts as one at 1e-308.
    constexpr double least = std::numeric_limits<double>::min();
    const std::size_t n = ascending.size();
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double below = std::max(fit.cdf(ascending[i]), least);
        const double above = std::max(fit.exceedance(ascending[n - 1 - i]), least);
        sum += static_cast<double>(2 * i + 1) * (std::log(below) + std::log(above));
    }
    return -static_cast<double>(n) - sum / static_cast<double>(n);
}

using Distance = double (*)(const Fit&, std::span<const double>);

/// The share of samples of the fit that lie at least as far from their own fits as `observed`.
double bootstrap_p(Distance distance, double observed, const Fit& model,
                   const Resampling& resampling) {
    const core::RandomStream stream(resampling.seed, core::Stream::parametric_bootstrap);
    std::vector<double> sample(model.count);
    std::size_t reached = 0;
    for (std::size_t r = 0; r < resampling.resamples; ++r) {
        for (std::size_t i = 0; i < sample.size(); ++i)
            sample[i] = model.quantile(stream.uniform(r, i));
        std::ranges::sort(sample);
        if (distance(tested_fit(model.family, sample), sample) >= observed) ++reached;
    }
    return static_cast<double>(1 + reached) / static_cast<double>(1 + resampling.resamples);
}

/// A sample in order, lognormal values as normal ones.
struct Prepared {
    Family family = Family::normal;
    std::vector<double> ascending;  // [as the values, or their logarithms]
};

Prepared prepare(Family family, std::span<const double> values) {
    Prepared prepared{family, sorted(values)};
    if (family == Family::lognormal) {
        prepared.family = Family::normal;
        for (double& x : prepared.ascending) x = std::log(x);
    }
    return prepared;
}

void require_values_of(Family family, std::span<const double> values) {
    if (is_positive(family))
        require_positive(values);
    else
        require_finite(values);
}

/// A test by distance. `normal_p` is the published p for normal values, where there is one.
std::optional<DistanceTest> distance_test(Distance distance, Family family,
                                          std::span<const double> values,
                                          const Resampling& resampling,
                                          double (*normal_p)(double, std::size_t)) {
    resampling.validate();
    require_values_of(family, values);
    if (values.size() < fewest_tested) return {};
    const Prepared sample = prepare(family, values);
    const Fit tested = tested_fit(sample.family, sample.ascending);
    DistanceTest test{.statistic = distance(tested, sample.ascending)};
    test.p_value = normal_p != nullptr && sample.family == Family::normal
                       ? normal_p(test.statistic, values.size())
                       : bootstrap_p(distance, test.statistic, tested, resampling);
    return test;
}

}  // namespace

std::size_t chi_square_bins(std::size_t n) {
    const double most = std::round(2 * std::pow(static_cast<double>(n), 0.4));
    return std::min(static_cast<std::size_t>(most), n / 5);
}

std::optional<ChiSquareTest> chi_square_test(std::span<const double> values, const Fit& fit,
                                             std::optional<std::size_t> bins) {
    require_finite(values);
    const std::size_t fewest = fit.fitted + 2;
    if (bins && (*bins < fewest || values.empty()))
        throw InputError(
            fmt::format("a chi-square test of {} values in {} bins: needs a value and at least {} "
                        "bins, with {} parameters fitted",
                        values.size(), *bins, fewest, fit.fitted));
    ChiSquareTest test{.bins = bins.value_or(chi_square_bins(values.size()))};
    if (test.bins < fewest) return {};
    test.degrees_of_freedom = test.bins - 1 - fit.fitted;

    std::vector<std::size_t> observed(test.bins, 0);
    for (const double x : values) {
        const double place = fit.cdf(x) * static_cast<double>(test.bins);
        ++observed[std::min(static_cast<std::size_t>(place), test.bins - 1)];
    }
    const double expected = static_cast<double>(values.size()) / static_cast<double>(test.bins);
    for (const std::size_t count : observed) {
        const double excess = static_cast<double>(count) - expected;
        test.statistic += excess * excess / expected;
    }
    const boost::math::chi_squared chi2(static_cast<double>(test.degrees_of_freedom));
    test.p_value = cdf(complement(chi2, test.statistic));
    return test;
}

std::optional<DistanceTest> kolmogorov_smirnov_test(Family family, std::span<const double> values,
                                                    const Resampling& resampling) {
    return distance_test(kolmogorov_smirnov, family, values, resampling, nullptr);
}

std::optional<DistanceTest> anderson_darling_test(Family family, std::span<const double> values,
                                                  const Resampling& resampling) {
    return distance_test(anderson_darling, family, values, resampling, anderson_darling_p);
}

double anderson_darling_p(double statistic, std::size_t n) {
    if (n < fewest_tested || !std::isfinite(statistic))
        throw InputError(fmt::format("p of A^2 = {} of {} values: takes a number and at least {}",
                                     statistic, n, fewest_tested));
    const auto count = static_cast<double>(n);
    const double a = std::min(statistic * (1 + 0.75 / count + 2.25 / (count * count)), 13.0);
    // Table 4.9, row by row.
    if (a >= 0.6) return std::exp(1.2937 - 5.709 * a + 0.0186 * a * a);
    if (a >= 0.34) return std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
    if (a >= 0.2) return 1 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
    return 1 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
}

}  // namespace grainfield::triaxial::statistics
