#include "randomfield/marginals/marginal_families.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.hpp"

namespace grainfield::randomfield {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The score of probability p below and q = 1 - p above, by the smaller of the two: the other has
/// lost its digits.
double score_of(double p, double q) {
    if (!(p > 0.0)) return -infinity;
    if (!(q > 0.0)) return infinity;
    return p <= q ? core::normal_quantile(p) : -core::normal_quantile(q);
}

/// Shape of the Weibull distribution of a coefficient of variation:
///   1 + COV^2 = Gamma(1 + 2/k) / Gamma(1 + 1/k)^2, falling in k.
double weibull_shape(double cov) {
    const double target = std::log1p(cov * cov);
    const auto excess = [target](double k) {
        using boost::math::lgamma;
        return lgamma(1.0 + 2.0 / k) - 2.0 * lgamma(1.0 + 1.0 / k) - target;
    };
    const boost::math::tools::eps_tolerance<double> close(50);
    std::uintmax_t steps = 200;
    const auto [low, high] =
        boost::math::tools::toms748_solve(excess, 0.05, 1e4, close, steps);  // covers the COVs
    return 0.5 * (low + high);
}

/// The x below which a beta distribution has probability p, down to tiny p.
double beta_quantile(double a, double b, double p) {
    using namespace boost::math::policies;
    using InDouble = policy<promote_double<false>, evaluation_error<ignore_error>,
                            overflow_error<ignore_error>, underflow_error<ignore_error>>;
    // Boost loses the digits of small p at a = 1, where p = 1 - (1 - x)^b.
    if (std::abs(a - 1.0) < 1e-12) return -std::expm1(std::log1p(-p) / b);
    // Near 0 the distribution is x^a / (a B(a, b)) (1 - ...x); Boost finds no root there.
    const double x = std::pow(p * a * boost::math::beta(a, b), 1.0 / a);
    if (x * (1.0 + a + b) < 1e-16) return x;
    return boost::math::ibeta_inv(a, b, p, InDouble());
}

}  // namespace

double normal_cdf(double g) {
    return 0.5 * std::erfc(-g / std::numbers::sqrt2);
}

Bounded::Bounded(const MarginalOptions& options)
    : minimum(options.minimum.value()), maximum(options.maximum.value()), s(options.s) {}

double Bounded::value(double g) const {
    const double half_range = 0.5 * (maximum - minimum);
    // Eq. (7) of Tran et al.
    return minimum + half_range * (1.0 + std::tanh(s * g / (2.0 * std::numbers::pi)));
}

double Bounded::score(double value) const {
    // atanh(u) with 1 + u and 1 - u taken from the ends, where they are small.
    return std::numbers::pi / s * std::log((value - minimum) / (maximum - value));
}

Lognormal::Lognormal(const MarginalOptions& options)
    // Eqs. (9a, b) of Tran et al.: sigma_ln^2 = ln(1 + COV^2), mu_ln = ln mu - sigma_ln^2 / 2.
    : sigma_ln(std::sqrt(std::log1p(options.cov * options.cov))),
      mu_ln(std::log(options.mean) - 0.5 * sigma_ln * sigma_ln) {}

double Lognormal::value(double g) const {
    return std::exp(mu_ln + sigma_ln * g);  // Eq. (8) of Tran et al.
}

double Lognormal::score(double value) const {
    return (std::log(value) - mu_ln) / sigma_ln;
}

Interval Lognormal::range() const {
    return {0.0, infinity};
}

Normal::Normal(const MarginalOptions& options)
    : mean(options.mean), deviation(options.cov * options.mean) {}

Interval Normal::range() const {
    return {-infinity, infinity};
}

TruncatedNormal::TruncatedNormal(const MarginalOptions& options)
    : mean(options.mean),
      deviation(options.cov * options.mean),
      minimum(options.minimum.value()),
      maximum(options.maximum.value()),
      below(normal_cdf((minimum - mean) / deviation)),
      above(normal_cdf((mean - maximum) / deviation)) {
    // By the tail that the window lies in, so that no digits are lost.
    const double up = normal_cdf((maximum - mean) / deviation);
    const double down = normal_cdf((mean - minimum) / deviation);
    window = up <= down ? up - below : down - above;
}

double TruncatedNormal::value(double g) const {
    const double p = below + window * normal_cdf(g);
    const double q = above + window * normal_cdf(-g);
    return std::clamp(mean + deviation * score_of(p, q), minimum, maximum);
}

double TruncatedNormal::score(double value) const {
    const double z = (value - mean) / deviation;
    const double p = (normal_cdf(z) - below) / window;
    const double q = (normal_cdf(-z) - above) / window;
    return score_of(p, q);
}

Beta::Beta(const MarginalOptions& options)
    : minimum(options.minimum.value()), maximum(options.maximum.value()) {
    const double range = maximum - minimum;
    const double mean = (options.mean - minimum) / range;
    const double deviation = options.cov * options.mean / range;
    const double sum = mean * (1.0 - mean) / (deviation * deviation) - 1.0;  // a + b
    a = mean * sum;
    b = (1.0 - mean) * sum;
}

double Beta::value(double g) const {
    const double range = maximum - minimum;
    if (g <= 0.0) return minimum + range * beta_quantile(a, b, normal_cdf(g));
    return maximum - range * beta_quantile(b, a, normal_cdf(-g));
}

double Beta::score(double value) const {
    const double x = (value - minimum) / (maximum - minimum);
    const double y = (maximum - value) / (maximum - minimum);
    const double p = boost::math::ibeta(a, b, x);
    return score_of(p, p > 0.5 ? boost::math::ibeta(b, a, y) : 1.0 - p);
}

Weibull::Weibull(const MarginalOptions& options)
    : shape(weibull_shape(options.cov)),
      scale(options.mean / boost::math::tgamma(1.0 + 1.0 / shape)) {}

double Weibull::value(double g) const {
    const double hazard = g <= 0.0 ? -std::log1p(-normal_cdf(g)) : -std::log(normal_cdf(-g));
    return scale * std::pow(hazard, 1.0 / shape);
}

double Weibull::score(double value) const {
    const double hazard = std::pow(value / scale, shape);
    return score_of(-std::expm1(-hazard), std::exp(-hazard));
}

Interval Weibull::range() const {
    return {0.0, infinity};
}

}  // namespace grainfield::randomfield
