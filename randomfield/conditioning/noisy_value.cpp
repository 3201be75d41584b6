#include "randomfield/conditioning/noisy_value.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

namespace grainfield::randomfield {
namespace {

constexpr double least_log = -700.0;  // exp of it is next to the least double
constexpr double prior_reach = 38.0;  // deviations of the prior; beyond it is below exp(least_log)
constexpr int scan_points = 191;      // one in 0.4 deviations
constexpr double fall = 40.0;         // where the density has fallen by exp(-fall) it ends

/// Logarithm of prior times likelihood, 0 where both are at their largest.
class LogDensity {
  public:
    LogDensity(const NoisyValue& measured, const GaussianMoments& before)
        : measured_(measured), before_(before) {}

    double operator()(double g) const {
        const double off = g - before_.mean;
        const double miss = (measured_.value - (*measured_.marginal)(g)) / measured_.error;
        const double sum = -0.5 * (off * off / before_.variance + miss * miss);
        return sum > -std::numeric_limits<double>::max() ? sum : -1e300;  // nor inf or NaN
    }

  private:
    const NoisyValue& measured_;
    const GaussianMoments& before_;
};

/// Where on the way from `inside` to `outside` the density falls below a level.
double crossing(const LogDensity& density, double level, double inside, double outside) {
    for (int step = 0; step < 40; ++step) {  // the ends need not be sharp
        const double middle = 0.5 * (inside + outside);
        (density(middle) > level ? inside : outside) = middle;
    }
    return outside;
}

/// Where the density is largest, and the interval outside of which it is nothing.
struct Support {
    double low = 0.0, mode = 0.0, high = 0.0, top = 0.0;
};

Support support_of(const LogDensity& density, const NoisyValue& measured,
                   const GaussianMoments& before) {
    const double spread = std::sqrt(before.variance);
    std::vector<double> scan;
    scan.reserve(scan_points + 1);
    for (int i = 0; i < scan_points; ++i)
        scan.push_back(before.mean + spread * prior_reach * (2.0 * i / (scan_points - 1) - 1.0));
    // A narrow likelihood may lie between two points of the scan: it is where the value is met.
    const Interval range = measured.marginal->range();
    if (measured.value > range.low && measured.value < range.high) {
        const double met = measured.marginal->score(measured.value);
        if (met > scan.front() && met < scan.back())
            scan.insert(std::upper_bound(scan.begin(), scan.end(), met), met);
    }
    std::vector<double> logs;
    logs.reserve(scan.size());
    for (const double g : scan) logs.push_back(density(g));
    const auto best =
        static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) - logs.begin());
    const double left = scan[best == 0 ? 0 : best - 1];
    const double right = scan[std::min(best + 1, scan.size() - 1)];
    Support support{scan.front(), scan[best], scan.back(), logs[best]};
    std::uintmax_t steps = 100;
    const auto [mode, negative] = boost::math::tools::brent_find_minima(
        [&](double g) { return -density(g); }, left, right, 30, steps);
    if (-negative > support.top) {
        support.mode = mode;
        support.top = -negative;
    }
    // The outermost points that count, where there are several peaks.
    const double level = support.top - fall;
    double low = support.mode, high = support.mode;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (logs[i] <= level) continue;
        low = std::min(low, scan[i]);
        high = std::max(high, scan[i]);
    }
    const auto beyond = std::upper_bound(scan.begin(), scan.end(), high);
    if (beyond != scan.end()) support.high = crossing(density, level, high, *beyond);
    const auto before_low = std::lower_bound(scan.begin(), scan.end(), low);
    if (before_low != scan.begin())
        support.low = crossing(density, level, low, *std::prev(before_low));
    return support;
}

}  // namespace

std::optional<GaussianMoments> moments_given(const NoisyValue& measured,
                                             const GaussianMoments& before) {
    const LogDensity density(measured, before);
    const Support support = support_of(density, measured, before);
    if (!(support.top > least_log)) return std::nullopt;
    // The trapezoid rule: smooth integrands that vanish at both ends converge faster than any power
    // of the step. Distances from the mode in units of the width, so that no digits are lost.
    const double width = support.high - support.low;
    double mean = 0.0, variance = 0.0;
    for (int n = 64; n <= 8192; n *= 2) {
        double sum = 0.0, first = 0.0, second = 0.0;
        for (int i = 0; i <= n; ++i) {
            const double g = support.low + width * i / n;
            const double weight = std::exp(density(g) - support.top);
            const double x = (g - support.mode) / width;
            sum += weight;
            first += weight * x;
            second += weight * x * x;
        }
        const double last_mean = mean, last_variance = variance;
        mean = first / sum;
        variance = second / sum - mean * mean;
        if (n > 64 && std::abs(mean - last_mean) < 1e-14 &&
            std::abs(variance - last_variance) < 1e-13 * variance)
            break;
    }
    return GaussianMoments{support.mode + width * mean, width * width * variance};
}

double least_error(const Marginal& marginal, double value) {
    const double rounding = 1e-12 * std::abs(value);
    const Interval range = marginal.range();
    if (!(value > range.low && value < range.high)) return rounding;
    const double g = marginal.score(value);
    if (!std::isfinite(g)) return rounding;
    return std::max(rounding, 1e-9 * std::max(1.0, std::abs(g)) * marginal.slope(g));
}

GaussianSite site_between(const GaussianMoments& before, const GaussianMoments& after) {
    const double known = 1.0 / before.variance;
    const double precision = std::max(1.0 / after.variance - known, 1e-10 * known);
    return {precision, after.mean * (known + precision) - before.mean * known};
}

}  // namespace grainfield::randomfield
