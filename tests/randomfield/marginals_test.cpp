// Marginals of Eqs. (7)-(9) against quadrature over the normal density.

#include "randomfield/marginals.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/trapezoidal.hpp>
#include <cmath>
#include <numbers>

#include "randomfield/covariance.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

// E[f(G)], G normal with variance gamma. The trapezoid rule is exact to round-off here.
template <class F>
double expectation(const F& f, double gamma = 1.0) {
    const double density = 1.0 / std::sqrt(2.0 * std::numbers::pi);
    return boost::math::quadrature::trapezoidal(
        [&](double x) { return density * std::exp(-0.5 * x * x) * f(std::sqrt(gamma) * x); }, -14.0,
        14.0, 1e-13);
}

TEST(Marginals, FrictionAngleHasTheSpecifiedSpread) {
    const FrictionMarginal marginal;
    const double mean = expectation([&](double g) { return friction_angle(marginal, g); });
    const double square = expectation([&](double g) {
        const double d = friction_angle(marginal, g) - mean;
        return d * d;
    });
    EXPECT_NEAR(mean, 0.6, 1e-12);
    EXPECT_NEAR(std::sqrt(square), 0.08755, 0.5e-5);  // physics.md, to its last digit
    EXPECT_DOUBLE_EQ(friction_angle(marginal, 0.0), 0.6);
    EXPECT_DOUBLE_EQ(friction_angle(marginal, 1e3), 0.9);
    EXPECT_DOUBLE_EQ(friction_angle(marginal, -1e3), 0.3);
    EXPECT_DOUBLE_EQ(friction_angle(marginal, 1.0),
                     0.3 + 0.3 * (1.0 + std::tanh(1.0 / std::numbers::pi)));
}

TEST(Marginals, StiffnessOfAPointHasTheGivenMoments) {
    for (const double cov : {0.4, 0.8, 1.2, 1.6, 2.0}) {
        const StiffnessTransform transform({.mean = 9e8, .cov = cov}, 1.0);
        const double mean = expectation(transform);
        const double square = expectation([&](double g) { return transform(g) * transform(g); });
        EXPECT_NEAR(mean, 9e8, 1e-11 * 9e8);
        EXPECT_NEAR(std::sqrt(square / mean / mean - 1.0), cov, 1e-10 * cov);
        EXPECT_DOUBLE_EQ(transform.mean_ratio(), 1.0);
        EXPECT_NEAR(transform(0.0), std::exp(transform.mu_ln()), 1e-6);
    }
}

TEST(Marginals, MeanOverCellsFallsUnlessPreserved) {
    const double gamma =
        LocalAverageCovariance(Vec3(0.25, 0.25, 0.25), paper_theta(0.01), {1, 1, 1}).gamma();
    const StiffnessTransform paper({.mean = 9e8, .cov = 0.8, .preserve_mean = false}, gamma);
    EXPECT_NEAR(paper.mean_ratio(), 0.78, 0.5e-2);  // physics.md
    EXPECT_NEAR(expectation(paper, gamma) / 9e8, paper.mean_ratio(), 1e-11);
    const StiffnessTransform preserved({.mean = 9e8, .cov = 0.8, .preserve_mean = true}, gamma);
    EXPECT_NEAR(expectation(preserved, gamma) / 9e8, 1.0, 1e-11);
    EXPECT_DOUBLE_EQ(preserved.mean_ratio(), 1.0);
}

}  // namespace
}  // namespace grainfield::randomfield
