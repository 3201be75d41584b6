// Measurements with errors: the moments they give G, against sums over a fixed grid that know
// nothing of modes, scores or slopes, and what several of them make of a field together.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "randomfield/conditioning/conditioning.hpp"
#include "randomfield/conditioning/noisy_value.hpp"
#include "tests/larger.hpp"
#include "tests/randomfield/field_support.hpp"
#include "tests/randomfield/marginal_support.hpp"

namespace grainfield::randomfield {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Likelihood of a measurement, up to a factor.
double log_likelihood(const NoisyValue& measured, double g) {
    const double miss = (measured.value - (*measured.marginal)(g)) / measured.error;
    return -0.5 * miss * miss;
}

double likelihood(const NoisyValue& measured, double g) {
    return std::exp(log_likelihood(measured, g));
}

/// Moments of G by the trapezoid rule on 200,001 points over 37 deviations either side.
GaussianMoments by_sums(const NoisyValue& measured, double prior) {
    constexpr int half = 100000;
    const auto g = [&](int i) { return std::sqrt(prior) * 37.0 * i / half; };
    std::vector<double> logs;
    for (int i = -half; i <= half; ++i)
        logs.push_back(-0.5 * g(i) * g(i) / prior + log_likelihood(measured, g(i)));
    const auto best = std::max_element(logs.begin(), logs.end());
    const double about = g(static_cast<int>(best - logs.begin()) - half);
    double sum = 0.0, first = 0.0, second = 0.0;
    for (int i = -half; i <= half; ++i) {
        const double weight =
            std::exp(logs[static_cast<std::size_t>(std::ptrdiff_t{i} + half)] - *best);
        const double off = g(i) - about;
        sum += weight;
        first += weight * off;
        second += weight * off * off;
    }
    const double mean = first / sum;
    return {about + mean, second / sum - mean * mean};
}

/// All values are well inside, at the bounds, or outside of what the marginal gives.
TEST(NoisyValue, MomentsAreThoseOfABruteForceSum) {
    struct Case {
        const char* marginal;
        double value, error;
    };
    for (const Case& one :
         {Case{"bounded", 0.31, 0.05}, Case{"bounded", 0.305, 0.01}, Case{"bounded", 0.27, 0.04},
          Case{"bounded", 0.95, 0.02}, Case{"bounded", 0.6, 0.3}, Case{"lognormal", 1e7, 1e8},
          Case{"lognormal", 5e7, 3e7}, Case{"lognormal", 9e9, 3e9}, Case{"lognormal", 1e9, 1e6},
          Case{"beta", 1.05e8, 1e8}, Case{"beta", 2e7, 1e8}, Case{"beta", 4.9e9, 5e8},
          Case{"truncated_normal", 0.3, 0.02}, Case{"weibull", 1e6, 2e8},
          Case{"normal", 0.9, 0.05}}) {
        for (const double gamma : {0.0099, 0.294, 1.0}) {
            const Marginal marginal(example(one.marginal), gamma);
            const NoisyValue measured{&marginal, one.value, one.error};
            const auto moments = moments_given(measured, {0.0, gamma});
            const GaussianMoments sums = by_sums(measured, gamma);
            ASSERT_TRUE(moments);
            // Round-off of the value over the error, some 1e-13 at the smallest one, in each term.
            const double deviation = std::sqrt(sums.variance);
            EXPECT_NEAR(moments->mean, sums.mean, 1e-10 * deviation) << one.marginal << one.value;
            EXPECT_NEAR(moments->variance, sums.variance, 1e-10 * sums.variance)
                << one.marginal << one.value;
        }
    }
}

// A normal marginal is linear in G: the score and its precision are those of algebra, wherever the
// prior stands.
TEST(NoisyValue, NormalMarginalsGiveTheLinearResult) {
    const Marginal marginal(example("normal"), 0.5);  // 0.6 + 0.09 G
    for (const double error : {1e-5, 0.01, 0.09, 1.0}) {
        for (const GaussianMoments& before : {GaussianMoments{0.0, 0.5}, {1.3, 0.02}}) {
            const NoisyValue measured{&marginal, 0.7, error};
            const GaussianSite site = site_between(before, moments_given(measured, before).value());
            const double precision = (0.09 / error) * (0.09 / error);
            const double all = precision + 1.0 / before.variance;
            EXPECT_NEAR(site.precision, precision, 1e-10 * all) << error;
            EXPECT_NEAR(site.weighted, precision / 0.9, 1e-10 * all) << error;
        }
    }
}

TEST(NoisyValue, ErrorsOfAnySizeGiveNumbers) {
    const Marginal marginal(example("bounded"), 0.8);
    const GaussianMoments before{0.0, 0.8};
    // Says nothing.
    for (const double error : {1e3, 1e200, 1e308}) {
        const NoisyValue nothing{&marginal, 0.4, error};
        const GaussianSite site = site_between(before, moments_given(nothing, before).value());
        EXPECT_GT(site.precision, 0.0);
        EXPECT_LT(site.precision, 1e-6);
        EXPECT_NEAR(site.weighted, 0.0, 1e-6);
    }
    // Nearly exact: at the score, as sharp as the slope says (2e-3: round-off of value over error).
    const double least = least_error(marginal, 0.4);
    const NoisyValue sharp{&marginal, 0.4, least};
    const auto moments = moments_given(sharp, before).value();
    const double score = marginal.score(0.4);
    EXPECT_NEAR(moments.mean, score, 1e-9);
    EXPECT_NEAR(std::sqrt(moments.variance) * marginal.slope(score) / least, 1.0, 2e-3);
    // Twenty and two hundred errors outside the marginal.
    EXPECT_TRUE(moments_given({&marginal, 1.0, 0.005}, before));
    EXPECT_FALSE(moments_given({&marginal, 1.0, 0.0005}, before));
}

// Where the likelihood makes G wider than it was, the mean is kept and the variance stays.
TEST(NoisyValue, SitesOfWiderMomentsKeepTheMean) {
    const GaussianMoments before{0.2, 0.5};
    const GaussianSite site = site_between(before, {1.1, 0.9});
    const double precision = 1.0 / before.variance + site.precision;
    EXPECT_NEAR((before.mean / before.variance + site.weighted) / precision, 1.1, 1e-12);
    EXPECT_NEAR(1.0 / precision, before.variance, 1e-9);
}

/// The mean and the variance of both cells of a grid of two, by sums over the plane.
struct Pair {
    double mean[2]{}, variance[2]{};
    Pair(double gamma, double covariance, const NoisyValue& a, const NoisyValue& b) {
        // G_2 = rho G_1 + sqrt(1 - rho^2) G'.
        const double rho = covariance / gamma, rest = std::sqrt(1.0 - rho * rho);
        double sum = 0.0, first[2]{}, second[2]{};
        for (int i = -400; i <= 400; ++i) {
            for (int j = -400; j <= 400; ++j) {
                const double x = 0.02 * i, y = 0.02 * j;
                const double g[2] = {std::sqrt(gamma) * x, std::sqrt(gamma) * (rho * x + rest * y)};
                const double weight =
                    std::exp(-0.5 * (x * x + y * y)) * likelihood(a, g[0]) * likelihood(b, g[1]);
                sum += weight;
                for (int c = 0; c < 2; ++c) {
                    first[c] += weight * g[c];
                    second[c] += weight * g[c] * g[c];
                }
            }
        }
        for (int c = 0; c < 2; ++c) {
            mean[c] = first[c] / sum;
            variance[c] = second[c] / sum - mean[c] * mean[c];
        }
    }
};

// From the file's lines to the conditioned field. One measurement: exact. Two in neighbours that
// are much alike: what is left is that the joint density is not normal, some hundredths of the
// deviation; each matched alone would be off by several tenths (the last line).
TEST(NoisyData, FieldsHaveTheMomentsOfTheTrueDensity) {
    const GridSpec grid{{1, 2, 1}, Vec3(0.25, 0.25, 0.25)};
    const LocalAverageCovariance covariance(grid.cell_size, paper_theta(2.0), grid.cells);
    const double gamma = covariance.gamma();
    double worst = 0.0, worst_alone = 0.0;
    for (const char* name : {"bounded", "lognormal", "beta", "truncated_normal"}) {
        MarginalOptions options = example(name);
        const Property property =
            options.mean > 1e6 ? Property::normal_stiffness : Property::friction_angle;
        const RowMarginals rows(options, property, grid, gamma);
        const Marginal& marginal = rows.row(0);
        const double low = marginal(-3.0), high = marginal(3.0);
        for (const double at : {0.02, 0.3, 0.98}) {
            const double value = low + at * (high - low), error = 0.08 * (high - low);
            const auto known = [&](const std::vector<Measurement>& data) {
                return Conditioning(
                    grid, covariance, 0.0,
                    cell_data("f", data, grid, covariance, 0.0, [&](Property) { return &rows; }));
            };
            const Measurement a{property, Vec3(0.1, 0.1, 0.1), value, error, 2};
            const Measurement b{property, Vec3(0.1, 0.3, 0.1), value, error, 3};
            const NoisyValue noisy{&marginal, value, error};

            const Conditioning one = known({a});
            const GaussianMoments sums = by_sums(noisy, gamma);
            const double deviation = std::sqrt(sums.variance);
            const bool wider = sums.variance > gamma;  // site_between()
            EXPECT_NEAR(one.mean(property)[0], sums.mean, 1e-9 * deviation) << name << at;
            EXPECT_NEAR(one.variance(property)[0], wider ? gamma : sums.variance, 1e-9) << name;

            const Conditioning two = known({a, b});
            const Pair pair(gamma, covariance(0, 1, 0), noisy, noisy);
            for (std::size_t c = 0; c < 2; ++c) {
                const double spread = std::sqrt(pair.variance[c]);
                worst = larger(worst, std::abs(two.mean(property)[c] - pair.mean[c]) / spread);
                EXPECT_NEAR(two.variance(property)[c] / pair.variance[c], 1.0, 0.05) << name << at;
            }
            const GaussianSite alone = site_between({0.0, gamma}, sums);
            const Conditioning apart(
                grid, covariance, 0.0,
                {{property, 0, alone.weighted / alone.precision, 1.0 / alone.precision},
                 {property, 1, alone.weighted / alone.precision, 1.0 / alone.precision}});
            worst_alone = larger(worst_alone, std::abs(apart.mean(property)[0] - pair.mean[0]) /
                                                  std::sqrt(pair.variance[0]));
        }
    }
    EXPECT_LT(worst, 0.02);
    EXPECT_GT(worst_alone, 3.0 * worst);
}

// By draws, not by moments: the field's cell against unconditional draws taken with the probability
// of the measurement (rejection sampling), at the setting where linearising at the value did
// nothing.
TEST(NoisyData, DrawsAgreeWithRejectionSampling) {
    const GridSpec grid{{1, 2, 1}, Vec3(0.25, 0.25, 0.25)};
    FieldOptions options;
    options.variable = Variable::friction;
    options.correlation_length = paper_theta(1.0);
    const FieldGenerator plain(grid, options);
    const RowMarginals& rows = plain.marginals(friction);
    const NoisyValue measured{&rows.row(0), 0.31, 0.05};
    const LocalAverageCovariance covariance(grid.cell_size, paper_theta(1.0), grid.cells);
    const Conditioning known(grid, covariance, 0.0,
                             cell_data("f", {{friction, Vec3(0.1, 0.1, 0.1), 0.31, 0.05, 2}}, grid,
                                       covariance, 0.0, [&](Property) { return &rows; }));
    double sum[2]{}, square[2]{};
    int taken = 0;
    std::uint64_t k = 0;
    for (; taken < 4000; ++k) {
        const BlockField field = plain.draw(k);
        // A uniform number of its own: the digits of another realization's G.
        const double uniform =
            normal_cdf(plain.draw(k + (1u << 30)).G[0] / std::sqrt(plain.gamma()));
        if (uniform > likelihood(measured, field.G[0])) continue;
        ++taken;
        for (int c = 0; c < 2; ++c) {
            sum[c] += field.G[c];
            square[c] += field.G[c] * field.G[c];
        }
    }
    for (std::size_t c = 0; c < 2; ++c) {
        const double mean = sum[c] / taken, variance = square[c] / taken - mean * mean;
        // Four standard errors, 6e-5 each; the variance's for a normal distribution.
        EXPECT_NEAR(known.mean(friction)[c], mean, 4.0 * std::sqrt(variance / taken)) << c;
        EXPECT_NEAR(known.variance(friction)[c], variance, 4.0 * variance * std::sqrt(2.0 / taken));
    }
    EXPECT_LT(known.mean(friction)[0], -1.0);  // far from 0, what the field has without data
}

TEST(NoisyData, RefusesWithFileAndLine) {
    const GridSpec grid;
    const LocalAverageCovariance covariance(grid.cell_size, paper_theta(1.0), grid.cells);
    const RowMarginals rows(example("bounded"), friction, grid, covariance.gamma());
    const auto refusal = [&](const std::vector<Measurement>& data) {
        return input_error([&] {
            (void)Conditioning(
                grid, covariance, 0.0,
                cell_data("f.csv", data, grid, covariance, 0.0, [&](Property) { return &rows; }),
                "f.csv");
        });
    };
    const Vec3 here(0.1, 0.1, 0.1), above(0.1, 0.3, 0.1);
    EXPECT_EQ(refusal({{friction, here, 0.31, 0.05, 2}}), "");
    EXPECT_EQ(refusal({{friction, here, 0.95, 0.05, 2}}), "");  // outside, but with an error
    EXPECT_EQ(refusal({{friction, here, 0.4, 1e200, 2}, {friction, here, 0.5, 1e-3, 3}}), "");
    EXPECT_THAT(refusal({{friction, here, 0.4, 1e-200, 7}}),
                testing::AllOf(StartsWith("f.csv:7: error = 1e-200: too small"),
                               HasSubstr("0 for an exact value, or at least ")));
    EXPECT_THAT(refusal({{friction, here, 1.2, 1e-3, 4}}),
                testing::AllOf(StartsWith("f.csv:4: value = 1.2 with an error of 0.001: so far"),
                               HasSubstr("between 0.3 and 0.9 rad")));
    EXPECT_THAT(refusal({{friction, here, 0.9, 0.0, 4}}),
                StartsWith("f.csv:4: value = 0.9: exact"));
    // Exact values of neighbours through a correlation length that lets nothing change between.
    const LocalAverageCovariance rigid(grid.cell_size, paper_theta(1e12), grid.cells);
    EXPECT_THAT(input_error([&] {
                    (void)Conditioning(grid, rigid, 0.0,
                                       {{friction, 0, -1.0, 0.0, 0.4, 2},
                                        {friction, 6, 1.0, 0.0, 0.7, 3},
                                        {friction, 12, 0.0, 0.0, 0.6, 4}},
                                       "f.csv");
                }),
                StartsWith("f.csv:"));
}

}  // namespace
}  // namespace grainfield::randomfield
