// Marginal distributions: quantile functions against Boost.Math's distributions, moments of cells
// against closed forms, independent quadrature and sampling.

#include "randomfield/marginals/marginals.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <boost/math/quadrature/trapezoidal.hpp>
#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "tests/randomfield/field_support.hpp"
#include "tests/randomfield/marginal_support.hpp"

namespace grainfield::randomfield {
namespace {

using boost::math::cdf;
using boost::math::complement;

// E[f(G)], G normal with variance gamma. The trapezoid rule is exact to round-off here.
template <class F>
double expectation(const F& f, double gamma = 1.0) {
    const double density = 1.0 / std::sqrt(2.0 * std::numbers::pi);
    return boost::math::quadrature::trapezoidal(
        [&](double x) { return density * std::exp(-0.5 * x * x) * f(std::sqrt(gamma) * x); }, -14.0,
        14.0, 1e-13);
}

class EachMarginal : public testing::TestWithParam<NamedMarginal> {};
INSTANTIATE_TEST_SUITE_P(Of, EachMarginal, testing::ValuesIn(example_marginals()),
                         [](const auto& one) { return one.param.name; });

TEST_P(EachMarginal, GrowsWithTheScoreAndComesBack) {
    const Marginal marginal(GetParam().options, 0.7);
    double last = -1e300;
    for (double g = -6.0; g <= 6.0; g += 0.25) {
        const double value = marginal(g);
        EXPECT_GT(value, last);
        EXPECT_GT(value, marginal.range().low);
        EXPECT_LT(value, marginal.range().high);
        last = value;
        // A value known to 1e-15 of itself gives a score known to that over the relative slope.
        const double known = 1e-14 * value / marginal.slope(g) + 1e-13;
        EXPECT_NEAR(marginal.score(value), g, 4.0 * known) << g;
    }
    for (const double g : {-40.0, 40.0}) {  // ends, never NaN
        EXPECT_GE(marginal(g), marginal.range().low);
        EXPECT_LE(marginal(g), marginal.range().high);
    }
    std::vector<double> g{-1.0, 0.0, 2.0}, values(3);
    marginal.apply(g, values);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(values[i], marginal(g[i]));
}

// Moments of cells: quadrature in the library is adaptive Gauss-Kronrod, here the trapezoid rule.
TEST_P(EachMarginal, CellMomentsAgreeWithAnotherQuadrature) {
    for (const double gamma : {1.0, 0.847760867523, 0.294383570840, 0.009930816164}) {
        const Marginal marginal(GetParam().options, gamma);
        const double mean = expectation(marginal, gamma);
        const double square = expectation(
            [&](double g) { return (marginal(g) - mean) * (marginal(g) - mean); }, gamma);
        const Moments moments = marginal.moments();
        EXPECT_NEAR(moments.mean, mean, 1e-10 * mean) << gamma;
        EXPECT_NEAR(moments.deviation, std::sqrt(square), 1e-9 * moments.deviation) << gamma;
    }
}

// Sampled cells against the predicted moments: z of the mean and of the mean square distance from
// the predicted mean, each at a significance of 1e-6 (4.9). 40,000 draws; the heaviest tail here
// (lognormal, COV 0.8, gamma 0.73) leaves the second z within 4.9 all the same for this seed.
TEST_P(EachMarginal, CellMomentsAgreeWithSampling) {
    const double gamma = 0.727445155768;
    const Marginal marginal(GetParam().options, gamma);
    const Moments moments = marginal.moments();
    std::vector<double> g(40000), values(g.size());
    core::RandomStream(11, core::Stream::field_friction).normals(0, 0, g);
    for (double& x : g) x *= std::sqrt(gamma);
    marginal.apply(g, values);
    double sum = 0.0, square = 0.0, fourth = 0.0;
    for (const double value : values) {
        const double off = (value - moments.mean) / moments.deviation;
        sum += off;
        square += off * off - 1.0;
        fourth += (off * off - 1.0) * (off * off - 1.0);
    }
    EXPECT_LT(std::abs(sum) / std::sqrt(static_cast<double>(g.size())), 4.9);
    EXPECT_LT(std::abs(square) / std::sqrt(fourth), 4.9);
}

TEST_P(EachMarginal, PreservedMeanIsThatOfAPoint) {
    MarginalOptions options = GetParam().options;
    options.preserve_mean = true;
    const double gamma = 0.294383570840;
    const Marginal preserved(options, gamma), plain(GetParam().options, gamma);
    const double point = plain.point_moments().mean;
    EXPECT_NEAR(preserved.moments().mean, point, 1e-10 * point);
    EXPECT_NEAR(expectation(preserved, gamma), point, 1e-10 * point);
    const double factor = preserved(0.3) / plain(0.3);
    EXPECT_NEAR(preserved(-2.0) / plain(-2.0), factor, 1e-14);
    EXPECT_NEAR(preserved.score(preserved(1.1)), 1.1, 1e-12);
    EXPECT_DOUBLE_EQ(preserved.range().low, factor * plain.range().low);
}

TEST_P(EachMarginal, CellsAreDistributedByTheirVariance) {
    const double gamma = 0.5;
    const Marginal marginal(GetParam().options, gamma);
    for (const double z : {-3.0, -0.4, 0.0, 1.7})
        EXPECT_NEAR(marginal.cell_cdf(marginal(z * std::sqrt(gamma))), normal_cdf(z), 1e-12);
    EXPECT_EQ(marginal.cell_cdf(-1e300), 0.0);
    EXPECT_EQ(marginal.cell_cdf(1e300), 1.0);
}

// cdf(value(g)) = Phi(g) in both tails by Boost's distributions; parameters found independently.
template <class Distribution>
void expect_quantiles(const Marginal& marginal, const Distribution& distribution) {
    for (const double g : {-6.0, -3.0, -1.0, 0.0, 0.5, 2.0, 6.0}) {
        const double value = marginal(g);
        if (g <= 0.0) {
            EXPECT_NEAR(cdf(distribution, value) / normal_cdf(g), 1.0, 1e-10) << g;
        } else {
            EXPECT_NEAR(cdf(complement(distribution, value)) / normal_cdf(-g), 1.0, 1e-10) << g;
        }
    }
}

TEST(Marginals, QuantilesAreThoseOfTheDistributions) {
    const MarginalOptions lognormal = example("lognormal");
    const double sigma = std::sqrt(std::log(1.0 + lognormal.cov * lognormal.cov));
    expect_quantiles(Marginal(lognormal, 1.0),
                     boost::math::lognormal(std::log(lognormal.mean) - sigma * sigma / 2, sigma));
    const MarginalOptions normal = example("normal");
    expect_quantiles(Marginal(normal, 1.0),
                     boost::math::normal(normal.mean, normal.cov * normal.mean));
    // Exponential: shape 1, COV 1.
    MarginalOptions weibull = example("weibull");
    weibull.cov = 1.0;
    expect_quantiles(Marginal(weibull, 1.0), boost::math::weibull(1.0, weibull.mean));
    // Rayleigh: shape 2, mean scale sqrt(pi)/2, COV sqrt(4/pi - 1).
    weibull.cov = std::sqrt(4.0 / std::numbers::pi - 1.0);
    expect_quantiles(Marginal(weibull, 1.0),
                     boost::math::weibull(2.0, weibull.mean * 2 / std::sqrt(std::numbers::pi)));
    // Beta(2, 6) on [0.1, 0.9]: mean 1/4, variance 1/48 of the range.
    MarginalOptions beta{MarginalKind::beta, 0.1, 0.9, 2.0, 0.3, 0.8 * std::sqrt(1.0 / 48) / 0.3};
    const Marginal of_beta(beta, 1.0);
    for (const double g : {-5.0, -1.0, 0.0, 2.0, 5.0}) {
        const double x = (of_beta(g) - 0.1) / 0.8;
        const boost::math::beta_distribution<> distribution(2.0, 6.0);
        const double p = g <= 0 ? cdf(distribution, x) : cdf(complement(distribution, x));
        EXPECT_NEAR(p / normal_cdf(-std::abs(g)), 1.0, 1e-9) << g;
    }
}

TEST(Marginals, PointsHaveTheMomentsAskedFor) {
    for (const NamedMarginal& one : example_marginals()) {
        if (one.options.kind == MarginalKind::bounded ||
            one.options.kind == MarginalKind::truncated_normal)
            continue;
        const Moments moments = Marginal(one.options, 1.0).moments();
        EXPECT_NEAR(moments.mean, one.options.mean, 1e-10 * moments.mean) << one.name;
        EXPECT_NEAR(moments.deviation / moments.mean, one.options.cov, 1e-9) << one.name;
    }
    // Eq. (7) of Tran et al.; the value of docs/method.md, section 5.4, to its last digit.
    const Moments bounded = Marginal(FieldOptions().friction, 1.0).moments();
    EXPECT_NEAR(bounded.mean, 0.6, 1e-12);
    EXPECT_NEAR(bounded.deviation, 0.08755, 0.5e-5);
}

TEST(Marginals, TruncatedNormalHasItsClosedFormMoments) {
    for (const double mean : {0.35, 0.6, 0.2}) {
        const MarginalOptions options{
            MarginalKind::truncated_normal, 0.3, 0.7, 2.0, mean, 0.1 / mean};
        const boost::math::normal unit;
        const double a = (0.3 - mean) / 0.1, b = (0.7 - mean) / 0.1;
        const double z = cdf(unit, b) - cdf(unit, a);
        const double fa = pdf(unit, a), fb = pdf(unit, b);
        const double shift = (fa - fb) / z;
        const double variance = 1.0 + (a * fa - b * fb) / z - shift * shift;
        const Moments moments = Marginal(options, 1.0).moments();
        EXPECT_NEAR(moments.mean, mean + 0.1 * shift, 1e-12);
        EXPECT_NEAR(moments.deviation, 0.1 * std::sqrt(variance), 1e-11);
    }
}

// The uniform distribution is beta(1, 1): Var Phi(G) = asin(gamma / (1 + gamma)) / 2 pi.
TEST(Marginals, UniformCellsHaveTheirClosedFormVariance) {
    const MarginalOptions uniform{MarginalKind::beta,         0.2, 0.8, 2.0, 0.5,
                                  0.6 / std::sqrt(12.0) / 0.5};
    for (const double gamma : {1.0, 0.5, 0.01}) {
        const Moments moments = Marginal(uniform, gamma).moments();
        const double variance = std::asin(gamma / (1.0 + gamma)) / (2.0 * std::numbers::pi);
        EXPECT_NEAR(moments.mean, 0.5, 1e-11);
        EXPECT_NEAR(moments.deviation, 0.6 * std::sqrt(variance), 1e-10);
    }
}

TEST(Marginals, MeanOfLognormalCellsFallsUnlessPreserved) {
    const double gamma =
        LocalAverageCovariance(Vec3(0.25, 0.25, 0.25), paper_theta(0.01), {1, 1, 1}).gamma();
    MarginalOptions options = FieldOptions().stiffness;
    const RowMarginals paper(options, Property::normal_stiffness, GridSpec{}, gamma);
    EXPECT_NEAR(paper.mean_ratio(), 0.78, 0.5e-2);  // docs/method.md, Eq. (25)
    EXPECT_NEAR(paper.mean_ratio(), std::exp(-std::log(1.64) * (1.0 - gamma) / 2.0), 1e-14);
    options.preserve_mean = true;
    const RowMarginals preserved(options, Property::normal_stiffness, GridSpec{}, gamma);
    EXPECT_NEAR(preserved.mean_ratio(), 1.0, 1e-14);
}

// The mean is linear in the height of the cells' middle and what is given at mid-height; the
// coefficient of variation stays; Eq. (7) of Tran et al. moves as a whole.
TEST(RowMarginals, FollowATrendWithHeight) {
    const GridSpec grid;  // 3 m high, rows of 0.25 m
    MarginalOptions options = FieldOptions().stiffness;
    options.mean_gradient = -2e8;
    const double gamma = 0.6;
    const RowMarginals stiffness(options, Property::normal_stiffness, grid, gamma);
    options = FieldOptions().friction;
    options.mean_gradient = 0.04;
    const RowMarginals friction(options, Property::friction_angle, grid, gamma);
    double mean = 0.0, square = 0.0, below = 0.0;
    for (std::int32_t j = 0; j < 12; ++j) {
        const double y = 0.125 + 0.25 * j;
        const Moments point = stiffness.row(j).point_moments();
        EXPECT_NEAR(point.mean, 9e8 - 2e8 * (y - 1.5), 1.0);
        EXPECT_NEAR(point.deviation / point.mean, 0.8, 1e-12);
        const Interval range = friction.row(j).range();
        EXPECT_NEAR(range.low, 0.3 + 0.04 * (y - 1.5), 1e-15);
        EXPECT_NEAR(range.high, 0.9 + 0.04 * (y - 1.5), 1e-15);
        const Moments cell = stiffness.row(j).moments();
        mean += cell.mean / 12;
        square += (cell.deviation * cell.deviation + cell.mean * cell.mean) / 12;
        below += stiffness.row(j).cell_cdf(7e8) / 12;
    }
    EXPECT_NEAR(stiffness.point_mean(), 9e8, 1.0);
    EXPECT_NEAR(stiffness.moments().mean, mean, 1.0);
    EXPECT_NEAR(stiffness.moments().deviation, std::sqrt(square - mean * mean), 10.0);
    EXPECT_NEAR(stiffness.cell_cdf(7e8), below, 1e-15);

    std::vector<double> g(grid.size());
    for (std::size_t c = 0; c < g.size(); ++c) g[c] = std::sin(static_cast<double>(c));
    const std::vector<double> values = friction.values(g);
    for (const std::int32_t j : {0, 7, 11}) {
        const std::size_t cell = grid.index(3, j, 4);
        EXPECT_EQ(values[cell], friction.row(j)(g[cell]));
    }
}

TEST(RowMarginals, RefuseAPreservedMeanThatLeadsTooFar) {
    // Skewed to the right: the factor is above 1, and the maximum near to pi/2.
    MarginalOptions beta{MarginalKind::beta, 0.1, 1.55, 2.0, 0.3, 0.6};
    beta.preserve_mean = true;
    EXPECT_NE(input_error([&] {
                  RowMarginals(beta, Property::friction_angle, GridSpec{}, 0.05);
              }).find("field.friction.preserve_mean = true: scaled to a point's mean"),
              std::string::npos);
    EXPECT_NO_THROW(RowMarginals(beta, Property::normal_stiffness, GridSpec{}, 0.05));
}

// What validation leaves a probability of 1e-9 to is refused where it happens.
TEST(RowMarginals, RefuseValuesThatThePropertyCannotHave) {
    const MarginalOptions normal{MarginalKind::normal, {}, {}, 2.0, 0.6, 0.15};
    const RowMarginals rows(normal, Property::friction_angle, GridSpec{{1, 1, 2}, Vec3(1, 1, 1)},
                            1.0);
    EXPECT_NO_THROW((void)rows.values(std::vector{0.0, -6.0}));
    EXPECT_THROW((void)rows.values(std::vector{0.0, -7.0}), InputError);
    EXPECT_THROW((void)rows.values(std::vector{11.0, 0.0}), InputError);
    EXPECT_THROW((void)rows.values(std::vector{std::nan(""), 0.0}), InputError);
}

TEST(Marginals, SlopeIsTheDerivative) {
    const Marginal lognormal(example("lognormal"), 1.0);
    const double sigma = std::sqrt(std::log1p(0.8 * 0.8));
    EXPECT_NEAR(lognormal.slope(0.7), sigma * lognormal(0.7), 1e-7 * lognormal(0.7));
    const Marginal normal(example("normal"), 1.0);
    EXPECT_NEAR(normal.slope(-2.0) / (example("normal").cov * example("normal").mean), 1.0, 1e-9);
}

}  // namespace
}  // namespace grainfield::randomfield
