// Diameters drawn by number from a sieve curve by mass.
#include "packing/grading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/larger.hpp"
#include "tests/packing/small_samples.hpp"

namespace grainfield::packing {
namespace {

using testing::narrow_grading;
using testing::sphere_volume;

/// Solid volume of Tran et al.'s block [m3].
constexpr double paper_volume = 0.6 * 0.25 * 0.25 * 0.25;

/// Integral of f(D) D^power from the finest sieve to `diameter`, f the slope of the curve as a
/// share of the mass: Simpson's rule with n intervals a segment, straight from the table.
double integral(const Grading& grading, double diameter, int power, int n = 2000) {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < grading.sieve_diameter.size(); ++k) {
        const double d0 = grading.sieve_diameter[k], d1 = grading.sieve_diameter[k + 1];
        const double f = (grading.passing[k + 1] - grading.passing[k]) / 100 / (d1 - d0);
        const double end = std::clamp(diameter, d0, d1);
        const double h = (end - d0) / n;
        for (int i = 0; i <= n; ++i) {
            const double weight = i == 0 || i == n ? 1 : (i % 2 ? 4 : 2);
            sum += weight * h / 3 * f * std::pow(d0 + i * h, power);
        }
    }
    return sum;
}

double largest_deviation(const GradingDraw& draw, const Grading& grading) {
    const std::vector<double> achieved = achieved_passing(draw.diameter, grading.sieve_diameter);
    double worst = 0;
    for (std::size_t k = 0; k < achieved.size(); ++k)
        worst = larger(worst, std::abs(achieved[k] - grading.passing[k]));
    return worst;
}

double volume(const GradingDraw& draw) {
    double sum = 0;
    for (double d : draw.diameter) sum += sphere_volume(d);
    return sum;
}

TEST(NumberDistribution, FollowsTheNumericalIntegralOfTheCurveOverTheCube) {
    const Grading grading;
    const NumberDistribution distribution(grading);
    const double all = integral(grading, 0.2, -3);
    for (double u = 0.005; u < 1; u += 0.005)
        EXPECT_NEAR(integral(grading, distribution.quantile(u), -3) / all, u, 1e-9) << u;
    // The large grains are few: their tail is not lost in the sum.
    for (double tail : {1e-3, 1e-4, 1e-5})
        EXPECT_NEAR(1 - integral(grading, distribution.quantile(1 - tail), -3) / all, tail, 1e-9);
    // The coarsest segment holds 1e-5 of the grains: round-off grows by as much.
    EXPECT_NEAR(distribution.quantile(0), 0.02, 1e-12);
    EXPECT_NEAR(distribution.quantile(1), 0.2, 1e-11);
}

TEST(NumberDistribution, MeanCubeIsTheMassOfTheShareOverItsNumber) {
    const Grading grading;
    const NumberDistribution distribution(grading);
    const double all = integral(grading, 0.2, -3);
    EXPECT_NEAR(distribution.mean_cube(0, 1), 1 / all, 1e-9 / all);
    for (const auto& [u0, u1] : {std::pair(0.0, 0.3), std::pair(0.3, 0.31), std::pair(0.5, 1.0),
                                 std::pair(0.99, 1.0), std::pair(0.999, 0.9999)}) {
        const double mass = integral(grading, distribution.quantile(u1), 0) -
                            integral(grading, distribution.quantile(u0), 0);
        const double expected = mass / (all * (u1 - u0));
        EXPECT_NEAR(distribution.mean_cube(u0, u1), expected, 1e-9 * expected) << u0;
    }
}

TEST(NumberDistribution, PaperBlockIsExpectedToHoldThreeHundredAndTwelve) {
    const NumberDistribution distribution{Grading{}};
    EXPECT_NEAR(paper_volume / (std::numbers::pi / 6 * distribution.mean_cube(0, 1)), 311.5, 0.1);
}

TEST(NumberDistribution, SingleSegmentInClosedForm) {
    // f constant on [a, b]: P(D < d) = (1/a^2 - 1/d^2)/(1/a^2 - 1/b^2), <D^3> = 2 a^2 b^2/(a + b).
    const NumberDistribution distribution(narrow_grading());
    const double a = 0.04, b = 0.06;
    for (double u : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        const double d = 1 / std::sqrt((1 - u) / (a * a) + u / (b * b));
        EXPECT_NEAR(distribution.quantile(u), d, 1e-14 * d);
    }
    const double cube = 2 * a * a * b * b / (a + b);
    EXPECT_NEAR(distribution.mean_cube(0, 1), cube, 1e-13 * cube);
}

TEST(NumberDistribution, FlatPiecesOfTheCurveHaveNoGrains) {
    Grading grading;
    grading.sieve_diameter = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06};
    grading.passing = {0, 0, 40, 40, 100, 100};
    const NumberDistribution distribution(grading);
    for (double u = 0; u <= 1; u += 1.0 / 4096) {
        const double d = distribution.quantile(u);
        EXPECT_TRUE((d >= 0.02 && d <= 0.03) || (d >= 0.04 && d <= 0.05)) << u << ' ' << d;
    }
    // The gap is jumped where the number of the finer grains ends: 40 % of mass on [20, 30] mm
    // against 60 % on [40, 50] mm.
    const double fine = 0.4 * (1 / 0.0004 - 1 / 0.0009), coarse = 0.6 * (1 / 0.0016 - 1 / 0.0025);
    const double jump = fine / (fine + coarse);
    EXPECT_LE(distribution.quantile(jump - 1e-9), 0.03);
    EXPECT_GE(distribution.quantile(jump + 1e-9), 0.04);
}

TEST(Draw, ManyGrainsRecoverTheMassCurve) {
    const Grading grading;
    // 100 blocks' volume, and their number so that the search for it is spared: one of the largest
    // grains is 0.4 % of the mass.
    const GradingDraw draw = draw_diameters(grading, 100 * paper_volume, 5, 31150);
    EXPECT_NEAR(draw.scale, 1, 2e-3);
    EXPECT_LT(largest_deviation(draw, grading), 0.5);
    EXPECT_TRUE(std::is_sorted(draw.diameter.begin(), draw.diameter.end()));
}

TEST(Draw, BlockMeetsVolumeAndCurve) {
    const Grading grading;
    double spheres = 0;
    for (std::uint64_t seed : {1, 2, 3, 4, 5}) {
        SCOPED_TRACE(seed);
        const GradingDraw draw = draw_diameters(grading, paper_volume, seed, std::nullopt);
        EXPECT_NEAR(volume(draw), paper_volume, 1e-12 * paper_volume);
        EXPECT_LE(largest_deviation(draw, grading), 3.0);
        EXPECT_NEAR(draw.scale, 1, 0.02);
        EXPECT_GE(draw.diameter.front(), 0.02 * draw.scale);
        spheres += static_cast<double>(draw.diameter.size()) / 5;
    }
    EXPECT_NEAR(spheres, 315, 30);
}

TEST(Draw, CountIsKeptByScalingTheDiameters) {
    const Grading grading;
    const GradingDraw draw = draw_diameters(grading, paper_volume, 1, 351);
    EXPECT_EQ(draw.diameter.size(), 351U);
    EXPECT_NEAR(volume(draw), paper_volume, 1e-12 * paper_volume);
    // (311.5/351)^(1/3) = 0.961, less or more by what the largest of few grains weighs.
    EXPECT_NEAR(draw.scale, 0.95, 0.02);
    EXPECT_EQ(draw_diameters(grading, paper_volume, 1, 1).diameter.size(), 1U);
}

TEST(Draw, IsAFunctionOfTheSeed) {
    const Grading grading;
    const auto diameters = [&](std::uint64_t seed) {
        return draw_diameters(grading, paper_volume, seed, std::nullopt).diameter;
    };
    EXPECT_EQ(diameters(1), diameters(1));
    EXPECT_NE(diameters(1), diameters(2));
}

TEST(AchievedPassing, CountsMassUpToAndWithTheSieve) {
    const std::vector<double> passing = achieved_passing({1, 2, 3}, {0.5, 1, 2.5, 3});
    EXPECT_EQ(passing, (std::vector<double>{0, 100.0 / 36, 25, 100}));
}

TEST(Options, BadOnesAreNamed) {
    Grading grading;
    grading.passing[2] = 95;
    EXPECT_NE(message_of<InputError>([&] { grading.validate(); }).find("grading.passing"),
              std::string::npos);
    PackingOptions options;
    options.porosity = 1.2;
    const std::string message = message_of<InputError>([&] { options.validate(); });
    EXPECT_NE(message.find("packing.porosity = 1.2"), std::string::npos) << message;
}

}  // namespace
}  // namespace grainfield::packing
