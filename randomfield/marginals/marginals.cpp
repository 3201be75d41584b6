#include "randomfield/marginals/marginals.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"

namespace grainfield::randomfield {
namespace {

using Family = std::variant<Bounded, Lognormal, Normal, TruncatedNormal, Beta, Weibull>;

Family family_of(const MarginalOptions& options) {
    switch (options.kind) {
        case MarginalKind::bounded:
            return Bounded(options);
        case MarginalKind::lognormal:
            return Lognormal(options);
        case MarginalKind::normal:
            return Normal(options);
        case MarginalKind::truncated_normal:
            return TruncatedNormal(options);
        case MarginalKind::beta:
            return Beta(options);
        case MarginalKind::weibull:
            return Weibull(options);
    }
    throw InputError("no such marginal distribution");
}

/// E[f(x)] of a standard normal x, where f grows at most like a power of x.
template <class F>
double expectation(const F& f) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
    constexpr double end = 14.0;  // the density there is 1e-43
    constexpr unsigned depth = 8;
    const double density = 1.0 / std::sqrt(2.0 * std::numbers::pi);
    const auto weighted = [&](double x) { return density * std::exp(-0.5 * x * x) * f(x); };
    return Rule::integrate(weighted, -end, 0.0, depth, 1e-12) +
           Rule::integrate(weighted, 0.0, end, depth, 1e-12);
}

template <class Any>
Moments moments_of(const Any& family, double gamma) {
    const double spread = std::sqrt(gamma);
    const double middle = family.value(0.0);
    // From the middle, so that a narrow distribution keeps its digits.
    const double shift = expectation([&](double x) { return family.value(spread * x) - middle; });
    const double square = expectation([&](double x) {
        const double off = family.value(spread * x) - middle;
        return off * off;
    });
    return {middle + shift, std::sqrt(std::max(0.0, square - shift * shift))};
}

Moments moments_of(const Normal& normal, double gamma) {
    return {normal.mean, normal.deviation * std::sqrt(gamma)};
}

Moments moments_of(const Lognormal& lognormal, double gamma) {
    const double variance = lognormal.sigma_ln * lognormal.sigma_ln * gamma;
    const double mean = std::exp(lognormal.mu_ln + 0.5 * variance);
    return {mean, mean * std::sqrt(std::expm1(variance))};
}

}  // namespace

Marginal::Marginal(const MarginalOptions& options, double gamma)
    : family_(family_of(options)), gamma_(gamma) {
    if (!options.preserve_mean) return;
    if (const auto* lognormal = std::get_if<Lognormal>(&family_)) {
        const double sigma = lognormal->sigma_ln;
        factor_ = std::exp(0.5 * sigma * sigma * (1.0 - gamma));
    } else {
        factor_ = point_moments().mean / moments().mean;
    }
}

double Marginal::operator()(double g) const {
    return factor_ * std::visit([g](const auto& family) { return family.value(g); }, family_);
}

void Marginal::apply(std::span<const double> g, std::span<double> values) const {
    std::visit(
        [&](const auto& family) {
            for (std::size_t i = 0; i < g.size(); ++i) values[i] = factor_ * family.value(g[i]);
        },
        family_);
}

double Marginal::score(double value) const {
    return std::visit([&](const auto& family) { return family.score(value / factor_); }, family_);
}

double Marginal::first_not_below(double value) const {
    double below = -40.0, above = 40.0;
    for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (below + above);
        ((*this)(middle) < value ? below : above) = middle;
    }
    return above;
}

double Marginal::slope(double g) const {
    constexpr double step = 1e-4;
    return ((*this)(g + step) - (*this)(g - step)) / (2.0 * step);
}

Interval Marginal::range() const {
    const Interval one = std::visit([](const auto& family) { return family.range(); }, family_);
    return {factor_ * one.low, factor_ * one.high};
}

Moments Marginal::moments() const {
    const Moments one =
        std::visit([&](const auto& family) { return moments_of(family, gamma_); }, family_);
    return {factor_ * one.mean, factor_ * one.deviation};
}

Moments Marginal::point_moments() const {
    return std::visit([](const auto& family) { return moments_of(family, 1.0); }, family_);
}

double Marginal::mean_given(double mean, double variance) const {
    const double spread = std::sqrt(variance), middle = (*this)(mean);
    return middle + expectation([&](double x) { return (*this)(mean + spread * x) - middle; });
}

double Marginal::cell_cdf(double value) const {
    const Interval ends = range();
    if (!(value > ends.low)) return 0.0;
    if (!(value < ends.high)) return 1.0;
    return normal_cdf(score(value) / std::sqrt(gamma_));
}

}  // namespace grainfield::randomfield
