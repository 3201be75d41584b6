#include "randomfield/covariance/covariance_factors.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "randomfield/covariance/gauss_rule.hpp"

namespace grainfield::randomfield {
namespace {

const double kSqrtPi = 1.0 / std::numbers::inv_sqrtpi;

// Its second derivative is the Gaussian: h'' = exp(-z^2), h -> 0 for z -> infinity.
double double_antiderivative(double z) {
    const double gaussian = 0.5 * std::exp(-z * z);
    if (z < 6.0) return gaussian - 0.5 * kSqrtPi * z * std::erfc(z);
    // There they are nearly equal. Asymptotic series (Abramowitz & Stegun 7.2.14), whose terms fall
    // below round-off long before they grow again:
    //   h = exp(-z^2) / (4 z^2) (1 - 3!/1! (2z)^-2 + 5!/2! (2z)^-4 - ...).
    const double x = 1.0 / (4.0 * z * z);
    double term = 1.0, sum = 1.0;
    for (int m = 1; m < 30 && std::abs(term) > 1e-17; ++m) {
        term *= -(2.0 * m + 1.0) * 2.0 * x;  // (2m + 1)!/m! over (2m - 1)!/(m - 1)!
        sum += term;
    }
    return 2.0 * gaussian * x * sum;
}

// F_k is a second difference of h over u^2. Its terms are nearly equal where the Gaussian varies
// little over an interval, and there it is smooth enough for a Gauss rule of 12 points.
bool varies_little(double u, double k) {
    return u < 0.5 && u * u * k < 0.5;
}

double by_gauss_rule(double u, double k) {
    double sum = 0.0;
    const GaussRule& rule = gauss_rule(12);
    for (std::size_t i = 0; i < rule.size; ++i) {
        const double v = rule.node[i];
        const double a = u * (k + v);
        const double b = u * (k - v);
        sum += rule.weight[i] * (1.0 - v) * (std::exp(-a * a) + std::exp(-b * b));
    }
    return sum;
}

}  // namespace

void gaussian_cell_averages(double u, std::span<double> values) {
    double before = 0.0, here = 0.0;  // h at k - 1 and k
    bool known = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto k = static_cast<double>(i);
        if (varies_little(u, k)) {
            values[i] = by_gauss_rule(u, k);
        } else if (i == 0) {
            // Divided twice by u instead of once by u^2, which may overflow.
            values[i] = (kSqrtPi * std::erf(u) + std::expm1(-u * u) / u) / u;
        } else {
            if (!known) {
                before = double_antiderivative(u * (k - 1.0));
                here = double_antiderivative(u * k);
                known = true;
            }
            const double after = double_antiderivative(u * (k + 1.0));
            values[i] = (before - 2.0 * here + after) / u / u;
            before = here;
            here = after;
        }
    }
}

double gaussian_cell_average(double u, std::int32_t lag) {
    const double k = std::abs(lag);
    if (varies_little(u, k)) return by_gauss_rule(u, k);
    if (lag == 0) return (kSqrtPi * std::erf(u) + std::expm1(-u * u) / u) / u;
    return (double_antiderivative(u * (k - 1.0)) - 2.0 * double_antiderivative(u * k) +
            double_antiderivative(u * (k + 1.0))) /
           u / u;
}

double exponential_cell_average(double a, std::int32_t lag) {
    if (lag != 0) {
        // Both integrals apart: the interval in front, and the one behind, (1 - exp(-a))/a each.
        const double one = -std::expm1(-a) / a;
        return one * one * std::exp(-a * (std::abs(lag) - 1.0));
    }
    if (a > 0.5) return 2.0 * (1.0 + std::expm1(-a) / a) / a;
    // 2 (a - 1 + exp(-a))/a^2 without its cancellation: 2 sum of (-a)^n / (n + 2)!.
    double term = 1.0, sum = 1.0;
    for (int n = 1; n < 16; ++n) {
        term *= -a / (n + 2.0);
        sum += term;
    }
    return sum;
}

}  // namespace grainfield::randomfield
