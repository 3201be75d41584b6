#include "triaxial/statistics/distributions.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"

namespace grainfield::triaxial::statistics {
namespace {

namespace bm = boost::math;
namespace policies = boost::math::policies;

// In double all through, for a parametric bootstrap asks millions of times; what is too large or
// too small for a double is infinity or zero.
using Policy = policies::policy<policies::promote_double<false>,
                                policies::overflow_error<policies::ignore_error>,
                                policies::underflow_error<policies::ignore_error>>;

/// Calls `use` with Boost's distribution of the fit.
template <typename Use>
double with_distribution(const Fit& fit, const Use& use) {
    const auto [a, b] = fit.parameters;
    switch (fit.family) {
        case Family::normal:
            return use(bm::normal_distribution<double, Policy>(a, b));
        case Family::lognormal:
            return use(bm::lognormal_distribution<double, Policy>(a, b));
        case Family::gamma:
            return use(bm::gamma_distribution<double, Policy>(a, b));
        case Family::weibull:
            return use(bm::weibull_distribution<double, Policy>(a, b));
    }
    throw InputError("a distribution of an unknown family");
}

/// True where a positive family has no density; throws where x is no number.
bool is_outside(Family family, double x) {
    if (!std::isfinite(x))
        throw InputError(
            fmt::format("the {} distribution at {}: takes finite numbers", name(family), x));
    return is_positive(family) && x <= 0;
}

double log_normal_density(double z) {
    return -0.5 * (z * z + std::log(2 * std::numbers::pi));
}

}  // namespace

std::string_view name(Family family) {
    switch (family) {
        case Family::normal:
            return "normal";
        case Family::lognormal:
            return "lognormal";
        case Family::gamma:
            return "gamma";
        case Family::weibull:
            return "Weibull";
    }
    throw InputError("a distribution of an unknown family");
}

bool is_positive(Family family) {
    return family != Family::normal;
}

double Fit::aic() const {
    return 2 * static_cast<double>(fitted) - 2 * log_likelihood;
}

double Fit::pdf(double x) const {
    if (is_outside(family, x)) return 0;
    return with_distribution(*this, [x](const auto& d) { return bm::pdf(d, x); });
}

double Fit::log_pdf(double x) const {
    if (is_outside(family, x)) return -std::numeric_limits<double>::infinity();
    const auto [a, b] = parameters;
    switch (family) {
        case Family::normal:
            return log_normal_density((x - a) / b) - std::log(b);
        case Family::lognormal:
            return log_normal_density((std::log(x) - a) / b) - std::log(b) - std::log(x);
        case Family::gamma: {
            // Terms of the size k ln(k) cancel to one of order 1: in long double.
            const long double k = a;
            const long double t = static_cast<long double>(x) / b;
            return static_cast<double>((k - 1) * std::log(t) - t - bm::lgamma(k) -
                                       std::log(static_cast<long double>(b)));
        }
        case Family::weibull: {
            const double log_t = std::log(x / b);
            return std::log(a / b) + (a - 1) * log_t - std::exp(a * log_t);
        }
    }
    throw InputError("a distribution of an unknown family");
}

double Fit::cdf(double x) const {
    if (is_outside(family, x)) return 0;
    return with_distribution(*this, [x](const auto& d) { return bm::cdf(d, x); });
}

double Fit::exceedance(double x) const {
    if (is_outside(family, x)) return 1;
    return with_distribution(*this, [x](const auto& d) { return bm::cdf(bm::complement(d, x)); });
}

double Fit::quantile(double p) const {
    if (!(p > 0 && p < 1))
        throw InputError(fmt::format("quantile at p = {}, must lie between 0 and 1", p));
    return with_distribution(*this, [p](const auto& d) { return bm::quantile(d, p); });
}

double Fit::mean() const {
    return with_distribution(*this, [](const auto& d) { return bm::mean(d); });
}

double Fit::deviation() const {
    return with_distribution(*this, [](const auto& d) { return bm::standard_deviation(d); });
}

}  // namespace grainfield::triaxial::statistics
