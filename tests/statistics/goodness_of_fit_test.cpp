// Tests of fit: against SciPy and published tables, p values under the null, and power.

#include "triaxial/statistics/goodness_of_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"

namespace grainfield::triaxial::statistics {
namespace {

/// 4.9 standard errors (significance 1e-6) of the difference of two simulated p values; at least
/// three samples' worth, for a share of none.
double simulation_error(double p, double samples) {
    return 4.9 * std::sqrt(p * (1 - p) * (1 / samples + 1 / simulated_p_samples)) + 3 / samples;
}

/// Two heaps five deviations apart.
std::vector<double> bimodal_sample(std::uint64_t which, std::size_t n) {
    std::vector<double> values = lognormal_sample(which, n, 0.1);
    for (std::size_t i = 0; i < n; i += 2) values[i] *= std::exp(0.5);
    return values;
}

TEST(DistanceTests, AgreeWithSciPy) {
    for (const Reference* sample : {&strengths, &stiffnesses})
        for (const FamilyReference& r : sample->families) {
            SCOPED_TRACE(name(r.family));
            const auto d = kolmogorov_smirnov_test(r.family, sample->values);
            const auto a = anderson_darling_test(r.family, sample->values);
            ASSERT_TRUE(d && a);
            EXPECT_NEAR(d->statistic, r.kolmogorov_smirnov, 1e-11 * r.kolmogorov_smirnov);
            EXPECT_NEAR(a->statistic, r.anderson_darling, 1e-10 * r.anderson_darling);
            EXPECT_NEAR(d->p_value, r.kolmogorov_smirnov_p,
                        simulation_error(r.kolmogorov_smirnov_p, 2000));
            if (std::isnan(r.anderson_darling_p)) continue;
            EXPECT_NEAR(a->p_value, r.anderson_darling_p,
                        simulation_error(r.anderson_darling_p, 2000));
        }
}

TEST(KolmogorovSmirnov, AgreesWithTheFormulaOfDallalAndWilkinson) {
    // Dallal & Wilkinson 1986 (American Statistician 40): p of Lilliefors' D for p < 0.1, fitted to
    // simulations to within some 0.003.
    int compared = 0;
    for (std::size_t k = 0; k < 400 && compared < 8; ++k) {
        const std::size_t n = 15 + k % 40;
        const std::vector<double> values = lognormal_sample(k, n, 0.4);
        const auto quick =
            *kolmogorov_smirnov_test(Family::lognormal, values, {.resamples = 100, .seed = 9});
        if (quick.p_value > 0.08) continue;
        const double d = quick.statistic;
        const auto count = static_cast<double>(n);
        const double shifted = count + 2.78019;
        const double formula =
            std::exp(-7.01256 * d * d * shifted + 2.99587 * d * std::sqrt(shifted) - 0.122119 +
                     0.974598 / std::sqrt(count) + 1.67997 / count);
        const auto test = *kolmogorov_smirnov_test(Family::lognormal, values);
        EXPECT_EQ(test.statistic, d);
        EXPECT_NEAR(test.p_value, formula, 0.003 + simulation_error(formula, 2000)) << n;
        ++compared;
    }
    EXPECT_EQ(compared, 8);
}

TEST(AndersonDarling, AgreesWithThePublishedCriticalValues) {
    // D'Agostino & Stephens 1986, Table 4.7, mean and deviation estimated: A* at its upper tail's
    // probability. The formula's p is good to two digits.
    constexpr std::array<std::pair<double, double>, 8> table = {{{0.341, 0.5},
                                                                 {0.470, 0.25},
                                                                 {0.561, 0.15},
                                                                 {0.631, 0.10},
                                                                 {0.752, 0.05},
                                                                 {0.873, 0.025},
                                                                 {1.035, 0.01},
                                                                 {1.159, 0.005}}};
    for (const auto& [modified, p] : table) {
        EXPECT_NEAR(anderson_darling_p(modified / (1 + 0.75 / 10 + 0.0225), 10), p, 0.02 * p);
        EXPECT_NEAR(anderson_darling_p(modified, 1'000'000'000), p, 0.02 * p);
    }
    EXPECT_LT(anderson_darling_p(100, 50), 1e-30);
    EXPECT_GT(anderson_darling_p(100, 50), 0);
    EXPECT_GT(anderson_darling_p(0.05, 50), 0.999);
    EXPECT_THROW(anderson_darling_p(0.5, 7), InputError);
}

TEST(AndersonDarling, RowsOfTheFormulaMeet) {
    // The published rows differ by up to 0.0033 where they meet, at 0.34; p's slope is below 4.
    double previous = anderson_darling_p(0.1, 1'000'000'000);
    for (double a = 0.1; a < 2; a += 1e-4) {
        const double p = anderson_darling_p(a, 1'000'000'000);
        EXPECT_NEAR(p, previous, 0.004) << a;
        previous = p;
    }
}

TEST(AndersonDarling, UnderTheNullIsUniform) {
    constexpr std::size_t trials = 2000;
    std::vector<double> p;
    for (std::size_t k = 0; k < trials; ++k)
        p.push_back(
            anderson_darling_test(Family::lognormal, lognormal_sample(k, 30, 0.5))->p_value);
    EXPECT_LT(excess_above_uniform(p), largest_excess(trials) + 0.01);  // the formula's own error
    EXPECT_LT(excess_below_uniform(p), largest_excess(trials) + 0.01);
}

TEST(KolmogorovSmirnov, UnderTheNullIsUniform) {
    constexpr std::size_t trials = 600;
    std::vector<double> p;
    for (std::size_t k = 0; k < trials; ++k)
        p.push_back(kolmogorov_smirnov_test(Family::lognormal, lognormal_sample(k, 20, 0.5),
                                            {.resamples = 199, .seed = k})
                        ->p_value);
    EXPECT_LT(excess_above_uniform(p), largest_excess(trials));
    EXPECT_LT(excess_below_uniform(p), largest_excess(trials) + 0.005);  // p in steps of 1/200
}

TEST(DistanceTests, OfWeibullDoNotDependOnItsParameters) {
    // The logarithm of a Weibull value has location and scale alone: so does a power of it.
    std::vector<double> powers = stiffnesses.values;
    for (double& x : powers) x = 5 * std::pow(x, 0.7);
    const Resampling few = {.resamples = 200};
    const auto d = *kolmogorov_smirnov_test(Family::weibull, stiffnesses.values, few);
    const auto d_powers = *kolmogorov_smirnov_test(Family::weibull, powers, few);
    const auto a = *anderson_darling_test(Family::weibull, stiffnesses.values, few);
    const auto a_powers = *anderson_darling_test(Family::weibull, powers, few);
    EXPECT_NEAR(d.statistic, d_powers.statistic, 1e-12);
    EXPECT_NEAR(a.statistic, a_powers.statistic, 1e-11);
    EXPECT_EQ(d.p_value, d_powers.p_value);
    EXPECT_EQ(a.p_value, a_powers.p_value);
}

TEST(DistanceTests, RejectWhatIsNotLognormal) {
    // Of a hundred exponential values the logarithm is skew; two heaps are no lognormal either.
    constexpr std::size_t trials = 20;
    constexpr Resampling few = {.resamples = 200};
    std::array<std::array<int, 3>, 2> rejected{};
    for (std::size_t k = 0; k < trials; ++k) {
        std::vector<double> exponential = uniform_sample(k, 100);
        for (double& x : exponential) x = -std::log(x);
        const std::array<std::vector<double>, 2> samples = {exponential, bimodal_sample(k, 100)};
        for (std::size_t s = 0; s < 2; ++s) {
            const auto& x = samples[s];
            rejected[s][0] += chi_square_test(x, fit(Family::lognormal, x))->p_value < 0.05;
            rejected[s][1] += kolmogorov_smirnov_test(Family::lognormal, x, few)->p_value < 0.05;
            rejected[s][2] += anderson_darling_test(Family::lognormal, x)->p_value < 0.05;
        }
    }
    EXPECT_GE(rejected[0][0], 10);  // chi-square is the weakest
    EXPECT_GE(rejected[0][1], 14);
    EXPECT_GE(rejected[0][2], 17);
    for (const int count : rejected[1]) EXPECT_EQ(count, 20);
}

TEST(DistanceTests, AreTheSameOnEveryRun) {
    const auto p = [](std::uint64_t seed) {
        return kolmogorov_smirnov_test(Family::gamma, strengths.values,
                                       {.resamples = 300, .seed = seed})
            ->p_value;
    };
    EXPECT_EQ(p(1), p(1));
    EXPECT_NE(p(1), p(2));
}

TEST(DistanceTests, TakeTies) {
    const std::vector<double> values = {1, 1, 1, 2, 2, 3, 3, 3, 4, 4};
    const auto d = kolmogorov_smirnov_test(Family::normal, values, {.resamples = 200});
    const auto a = anderson_darling_test(Family::normal, values);
    ASSERT_TRUE(d && a);
    // Just below 3, the mean being 2.4 and half of the values lower: Phi(0.6/s) - 0.5, s^2 =
    // 12.4/9.
    EXPECT_NEAR(d->statistic, 0.5 * std::erf(0.6 / std::sqrt(2 * 12.4 / 9)), 1e-14);
    EXPECT_TRUE(std::isfinite(a->statistic));
    EXPECT_TRUE(chi_square_test(values, fit(Family::normal, values), 4));
}

TEST(DistanceTests, SurviveAFarOutlier) {
    // 57 deviations off, where Phi(-z) is too small for a double.
    std::vector<double> values = normal_sample(1, 3300);
    values.back() = 1e9;
    const auto a = anderson_darling_test(Family::normal, values);
    ASSERT_TRUE(a);
    EXPECT_TRUE(std::isfinite(a->statistic));
    EXPECT_LT(a->p_value, 1e-30);
}

TEST(DistanceTests, IsEmptyForTooFew) {
    const std::vector<double> seven = {1, 2, 3, 4, 5, 6, 7};
    EXPECT_FALSE(kolmogorov_smirnov_test(Family::normal, seven));
    EXPECT_FALSE(anderson_darling_test(Family::normal, std::vector{1.0, 2.0}));
}

TEST(DistanceTests, RefusesBadInput) {
    std::vector<double> values = strengths.values;
    EXPECT_THROW(kolmogorov_smirnov_test(Family::gamma, values, {.resamples = 9}), InputError);
    const std::vector<double> equal(20, 3.0);
    EXPECT_THROW(kolmogorov_smirnov_test(Family::lognormal, equal), InputError);
    EXPECT_THROW(anderson_darling_test(Family::normal, equal), InputError);
    values[3] = -values[3];
    EXPECT_THROW(kolmogorov_smirnov_test(Family::lognormal, values), InputError);
    EXPECT_THROW(anderson_darling_test(Family::weibull, values), InputError);
    EXPECT_NO_THROW(anderson_darling_test(Family::normal, values));
    values[3] = std::nan("");
    EXPECT_THROW(anderson_darling_test(Family::normal, values), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
