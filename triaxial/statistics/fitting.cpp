// Maximum likelihood and moments (distributions.hpp). Values are taken relative to their mean A,
// so that neither their unit nor a small coefficient of variation costs digits.

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/errors.hpp"
#include "triaxial/statistics/distributions.hpp"
#include "triaxial/statistics/moments.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {
namespace {

// Newton doubles the digits a step: the step after one below 2^-45 is below a double's round-off.
constexpr int newton_digits = 45;
constexpr std::uintmax_t most_steps = 200;

// Values closer than this have no deviation that their digits could tell.
constexpr double least_relative_range = 1e-9;

void require_fittable(Family family, std::span<const double> values) {
    if (is_positive(family))
        require_positive(values);
    else
        require_finite(values);
    if (values.size() < 2)
        throw InputError(
            fmt::format("a {} fit of {} values: needs two at least", name(family), values.size()));
    const auto [low, high] = std::ranges::minmax(values);
    if (high - low <= least_relative_range * std::max(std::abs(low), std::abs(high)))
        throw InputError(fmt::format("a {} fit of {} values, all {}: they must differ",
                                     name(family), values.size(), low));
}

double average(std::span<const double> values) {
    return *mean(values);
}

/// Mean and deviation over n, the normal's maximum likelihood.
std::array<double, 2> normal_parameters(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    return {average(values), *standard_deviation(values) * std::sqrt((n - 1) / n)};
}

std::vector<double> logarithms(std::span<const double> values, double unit) {
    std::vector<double> logs(values.size());
    std::ranges::transform(values, logs.begin(), [&](double x) { return std::log(x / unit); });
    return logs;
}

std::array<double, 2> lognormal_parameters(std::span<const double> values) {
    const double a = average(values);
    auto parameters = normal_parameters(logarithms(values, a));
    parameters[0] += std::log(a);
    return parameters;
}

/// ln(k) - psi(k) and its derivative. Beyond 1000 by the asymptotic series (Abramowitz & Stegun
/// 6.3.18, to 1e-17 there), for the difference loses the digits that both have in common.
std::pair<long double, long double> log_minus_digamma(long double k) {
    if (k > 1000) {
        const long double q = 1 / (k * k);
        return {0.5L / k + q / 12 - q * q / 120, -0.5L * q - q / (6 * k) + q * q / (30 * k)};
    }
    return {std::log(k) - boost::math::digamma(k), 1 / k - boost::math::trigamma(k)};
}

/// Gamma: ln(k) - psi(k) = s = ln(A) - mean(ln x), theta = A/k.
std::array<double, 2> gamma_parameters(std::span<const double> values) {
    const double a = average(values);
    // With r = x/A - 1, whose mean is zero, s = -mean(ln(1 + r) - r): no large terms cancel, and
    // round-off of A counts by its square.
    long double s = 0;
    for (const double x : values) s -= boost::math::log1pmx((static_cast<long double>(x) - a) / a);
    s /= static_cast<long double>(values.size());
    // Within 1.5 % of the root for any s (Minka 2002, "Estimating a Gamma distribution").
    const long double start = (3 - s + std::sqrt((s - 3) * (s - 3) + 24 * s)) / (12 * s);
    std::uintmax_t steps = most_steps;
    const long double k = boost::math::tools::newton_raphson_iterate(
        [s](long double shape) {
            auto score = log_minus_digamma(shape);
            score.first -= s;
            return score;
        },
        start, 0.9L * start, 1.1L * start, newton_digits, steps);
    return {static_cast<double>(k), static_cast<double>(a / k)};
}

/// Weibull: sum(x^k ln x)/sum(x^k) - 1/k = mean(ln x), lambda = mean(x^k)^(1/k).
std::array<double, 2> weibull_parameters(std::span<const double> values) {
    const double a = average(values);
    const std::vector<double> logs = logarithms(values, a);
    const auto moments = normal_parameters(logs);
    const double centre = moments[0];
    const double spread = moments[1];
    const double largest = std::ranges::max(logs);
    double weights = 0;
    // Weights x^k relative to the largest, which can then not overflow.
    const auto score = [&](double k) {
        weights = 0;
        double first = 0;
        double second = 0;
        for (const double z : logs) {
            const double w = std::exp(k * (z - largest));
            const double d = z - centre;
            weights += w;
            first += w * d;
            second += w * d * d;
        }
        const double m = first / weights;
        return std::pair{m - 1 / k, second / weights - m * m + 1 / (k * k)};
    };
    // The score rises with k; at 1/(largest - centre) it cannot be above zero, for no weighted
    // mean exceeds the largest.
    const double low = 1 / (largest - centre);
    const double start = std::max(low, std::numbers::pi / (std::sqrt(6.0) * spread));
    double high = 2 * start;
    while (score(high).first <= 0) high *= 2;
    std::uintmax_t steps = most_steps;
    const double k =
        boost::math::tools::newton_raphson_iterate(score, start, low, high, newton_digits, steps);
    score(k);
    const auto n = static_cast<double>(values.size());
    return {k, a * std::exp(largest + std::log(weights / n) / k)};
}

std::array<double, 2> likeliest(Family family, std::span<const double> values) {
    switch (family) {
        case Family::normal:
            return normal_parameters(values);
        case Family::lognormal:
            return lognormal_parameters(values);
        case Family::gamma:
            return gamma_parameters(values);
        case Family::weibull:
            return weibull_parameters(values);
    }
    throw InputError("a fit of an unknown family");
}

Fit fit_with(Family family, std::array<double, 2> parameters, std::span<const double> values) {
    Fit fit{.family = family, .parameters = parameters, .fitted = 2, .count = values.size()};
    for (const double x : values) fit.log_likelihood += fit.log_pdf(x);
    return fit;
}

}  // namespace

Fit fit(Family family, std::span<const double> values) {
    require_fittable(family, values);
    return fit_with(family, likeliest(family, values), values);
}

std::vector<Fit> fits(std::span<const double> values) {
    require_finite(values);
    const bool positive = std::ranges::all_of(values, [](double x) { return x > 0; });
    std::vector<Fit> all;
    for (const Family family : all_families)
        if (positive || !is_positive(family)) all.push_back(fit(family, values));
    std::ranges::stable_sort(all, {}, &Fit::aic);
    return all;
}

Fit lognormal_of(double mean, double deviation) {
    if (!(mean > 0 && deviation > 0 && std::isfinite(mean) && std::isfinite(deviation)))
        throw InputError(fmt::format(
            "a lognormal of mean {} and deviation {}: both must be above zero", mean, deviation));
    const double ratio = deviation / mean;
    const double variance = std::log1p(ratio * ratio);
    return {.family = Family::lognormal,
            .parameters = {std::log(mean) - 0.5 * variance, std::sqrt(variance)}};
}

Fit lognormal_by_moments(std::span<const double> values) {
    require_fittable(Family::lognormal, values);
    const Fit of_moments = lognormal_of(average(values), *standard_deviation(values));
    return fit_with(Family::lognormal, of_moments.parameters, values);
}

}  // namespace grainfield::triaxial::statistics
