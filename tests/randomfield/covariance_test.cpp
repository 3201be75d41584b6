// Exact covariances of local averages of the Markov field: the specification's table, the
// one-dimensional factors, and the limits of very short and very long correlation lengths.

#include "randomfield/covariance/covariance.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <numbers>

#include "randomfield/covariance/covariance_factors.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

const Vec3 kBlock(0.25, 0.25, 0.25);

TEST(Covariance, SpecificationTableToItsLastDigit) {
    struct Row {
        double theta_y, gamma, next_x, next_y;
    };
    for (const Row& row :
         {Row{0.01, 0.009930816164, 0.1909, 0.0139}, Row{0.1, 0.294383570840, 0.8553, 0.1296},
          Row{0.5, 0.727445155768, 0.9764, 0.5477}, Row{1.0, 0.847760867523, 0.9887, 0.7296},
          Row{10.0, 0.983056911321, 0.9989, 0.9677}}) {
        const LocalAverageCovariance covariance(kBlock, paper_theta(row.theta_y), {2, 2, 2});
        const double gamma = covariance.gamma();
        EXPECT_NEAR(gamma, row.gamma, 0.5001e-12) << row.theta_y;  // half a unit of the last digit
        EXPECT_NEAR(covariance(1, 0, 0) / gamma, row.next_x, 0.5001e-4) << row.theta_y;
        EXPECT_NEAR(covariance(0, 1, 0) / gamma, row.next_y, 0.5001e-4) << row.theta_y;
        EXPECT_DOUBLE_EQ(covariance(0, 0, 1), covariance(1, 0, 0));
    }
}

TEST(Covariance, OneDimensionalFactorAgreesWithQuadrature) {
    boost::math::quadrature::tanh_sinh<double> rule;
    for (const double u : {1e-9, 1e-3, 0.1, 0.4999, 0.5, 0.5001, 1.0, 2.5, 7.0}) {
        for (const std::int32_t lag : {0, 1, 2, 5}) {
            if (u * (lag - 1) > 12.0) continue;  // below 1e-60 of the others
            const auto half = [&](double sign) {
                return rule.integrate(
                    [&](double v) {
                        return (1.0 - v) * std::exp(-u * u * (lag + sign * v) * (lag + sign * v));
                    },
                    0.0, 1.0, 1e-15);
            };
            const double reference = half(1.0) + half(-1.0);
            // exp(-z^2) itself carries an error of z^2 eps, and z <= 12 here.
            EXPECT_NEAR(gaussian_cell_average(u, lag), reference, 1e-13 * reference)
                << "u = " << u << ", lag " << lag;
        }
    }
    // Asymptotes: 1 - u^2/6 - ..., and sqrt(pi)/u - 1/u^2.
    EXPECT_DOUBLE_EQ(gaussian_cell_average(0.0, 3), 1.0);
    EXPECT_NEAR(gaussian_cell_average(1e-4, 0), 1.0 - 1e-8 / 6.0, 2e-16);
    EXPECT_DOUBLE_EQ(gaussian_cell_average(1e200, 0), std::sqrt(std::numbers::pi) / 1e200);
    EXPECT_DOUBLE_EQ(gaussian_cell_average(1e6, 1), 0.5 / 1e12);
}

// theta far below the cell: gamma = int rho / V (1 - sum E|tau_d| / D + ...), with
// int exp(-2 |x| / theta) d3x = pi theta^3 and E|tau_d| = 3/4 theta under that weight.
TEST(Covariance, ShortCorrelationLengthsAreWhiteNoise) {
    const LocalAverageCovariance covariance(kBlock, Vec3(1e-3 * kBlock), {3, 3, 3});
    const double white = std::numbers::pi * 1e-9;
    EXPECT_NEAR(covariance.gamma() / white, 1.0 - 3.0 * 0.75e-3, 5e-6);  // next: (theta / D)^2
    EXPECT_LT(covariance(1, 0, 0) / covariance.gamma(), 1e-3);
    EXPECT_GT(covariance(1, 0, 0), 0.0);
    EXPECT_LT(covariance(2, 0, 0) / covariance.gamma(), 1e-15);
    EXPECT_GE(covariance(2, 2, 2), 0.0);
}

// theta of 1e4 domains: 1 - C = 2 E|tau| / theta to first order.
TEST(Covariance, LongCorrelationLengthsAreNearlyConstant) {
    const double theta = 1e4 * 3.0;
    const LocalAverageCovariance covariance(kBlock, Vec3(theta, theta, theta), {6, 12, 6});
    // Mean distance of two points of a unit cube (Robbins' constant), of two in cells n apart: n.
    const double robbins = 0.66170718226717623515;
    EXPECT_NEAR((1.0 - covariance.gamma()) / (2.0 * 0.25 * robbins / theta), 1.0, 1e-5);
    EXPECT_NEAR((1.0 - covariance(0, 11, 0)) / (2.0 * 0.25 * 11.0 / theta), 1.0, 5e-3);
    EXPECT_LT(covariance(0, 1, 0), covariance.gamma());
}

// Conservation of variance: the mean of eight children is the parent, at any theta.
TEST(Covariance, ParentsAreMeansOfTheirChildren) {
    for (const double theta_y : {2.5e-4, 0.01, 1.0, 100.0, 3e4}) {
        const LocalAverageCovariance child(kBlock, paper_theta(theta_y), {4, 4, 4});
        const LocalAverageCovariance parent(2.0 * kBlock, paper_theta(theta_y), {2, 2, 2});
        for (int shift : {0, 1}) {
            double sum = 0.0;
            for (int a = 0; a < 8; ++a) {
                for (int b = 0; b < 8; ++b) {
                    sum += child((a & 1) - (b & 1), (a >> 1 & 1) - (b >> 1 & 1) - 2 * shift,
                                 (a >> 2) - (b >> 2));
                }
            }
            // The rule's own error, 3e-15, and the round-off of 64 terms.
            EXPECT_NEAR(sum / 64.0, parent(0, shift, 0), 2e-14 * parent.gamma()) << theta_y;
        }
    }
}

}  // namespace
}  // namespace grainfield::randomfield
