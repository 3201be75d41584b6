// The bootstrap's draws, and BCa intervals against SciPy and by coverage.

#include "triaxial/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdint>
#include <future>
#include <numeric>
#include <optional>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial::statistics {
namespace {

double deviation(std::span<const double> values) {
    return *standard_deviation(values);
}

/// The replicates that reference_values.py made: Numerical Recipes' generator from 12345.
std::vector<double> scipys_replicates(const std::vector<double>& values) {
    std::uint32_t word = 12345;
    std::vector<double> sample(values.size());
    std::vector<double> replicates(999);
    for (double& replicate : replicates) {
        for (double& x : sample) {
            word = 1664525 * word + 1013904223;
            x = values[(std::uint64_t{word} * values.size()) >> 32];
        }
        replicate = deviation(sample);
    }
    return replicates;
}

TEST(Bootstrap, BcaAgreesWithSciPy) {
    for (const Reference* r : {&strengths, &stiffnesses}) {
        const auto interval = bca_interval(deviation(r->values), scipys_replicates(r->values),
                                           jackknife_replicates(r->values, deviation), 0.95);
        ASSERT_TRUE(interval);
        EXPECT_NEAR(interval->lower, r->bca_interval.lower, 1e-11 * r->deviation);
        EXPECT_NEAR(interval->upper, r->bca_interval.upper, 1e-11 * r->deviation);
    }
}

TEST(Bootstrap, DrawsEveryValueAtEveryPlaceAlike) {
    std::array<double, 7> values{};
    std::iota(values.begin(), values.end(), 0.0);
    constexpr std::size_t draws = 7000;
    const boost::math::chi_squared chi2(values.size() - 1);
    for (std::size_t place = 0; place < values.size(); ++place) {
        std::array<double, 7> observed{};
        const auto at_place = [&](std::span<const double> sample) { return sample[place]; };
        for (const double x : bootstrap_replicates(values, at_place, {.resamples = draws}))
            ++observed[static_cast<std::size_t>(x)];
        double statistic = 0;
        for (const double count : observed) statistic += std::pow(count - 1000, 2) / 1000;
        EXPECT_LT(statistic, quantile(complement(chi2, significance))) << place;
        EXPECT_GT(statistic, quantile(chi2, significance)) << place;
    }
}

TEST(Bootstrap, ReplicatesOfTheMeanSpreadAsTheyMust) {
    const auto average = [](std::span<const double> x) { return *mean(x); };
    const auto n = static_cast<double>(strengths.values.size());
    const auto replicates =
        bootstrap_replicates(strengths.values, average, {.resamples = 20'000, .seed = 3});
    const double spread = strengths.deviation * std::sqrt((n - 1) / n / n);
    // 4.9 standard errors: a significance of 1e-6.
    EXPECT_NEAR(*mean(replicates), strengths.mean, 4.9 * spread / std::sqrt(20'000));
    EXPECT_NEAR(deviation(replicates), spread, 4.9 * spread / std::sqrt(2 * 20'000));
}

TEST(Bootstrap, JackknifeLeavesOutOneAfterTheOther) {
    const std::vector<double> values = {1, 2, 4, 8};
    const auto sum = [](std::span<const double> x) {
        return std::accumulate(x.begin(), x.end(), 0.0);
    };
    EXPECT_EQ(jackknife_replicates(values, sum), (std::vector<double>{14, 13, 11, 7}));
}

TEST(Bootstrap, IsTheSameOnEveryRunAndThread) {
    const auto interval = [](std::uint64_t seed) {
        return *bootstrap_interval_of_variation(strengths.values, 0.95, {.seed = seed});
    };
    const Interval first = interval(1);
    std::array<std::future<Interval>, 4> others;
    for (auto& other : others) other = std::async(std::launch::async, interval, 1);
    for (auto& other : others) EXPECT_EQ(other.get(), first);
    EXPECT_NE(interval(2), first);
}

TEST(Bootstrap, FollowsTheUnit) {
    std::vector<double> scaled = strengths.values;
    for (double& x : scaled) x *= 4;
    const Interval s = *bootstrap_interval_of_deviation(strengths.values);
    EXPECT_EQ(*bootstrap_interval_of_deviation(scaled), (Interval{4 * s.lower, 4 * s.upper}));
    EXPECT_EQ(*bootstrap_interval_of_variation(scaled),
              *bootstrap_interval_of_variation(strengths.values));
    EXPECT_LT(s.lower, strengths.deviation);
    EXPECT_GT(s.upper, strengths.deviation);
}

/// Shares of lognormal samples of thirty values whose 95 % intervals hold the truth.
struct Coverage {
    double bca_deviation = 0;       // [-]
    double bca_variation = 0;       // [-]
    double textbook_deviation = 0;  // [-]
};

Coverage coverage(double sigma) {
    constexpr std::size_t trials = 400;
    const double variation = std::sqrt(std::expm1(sigma * sigma));
    const double deviation = variation * std::exp(0.5 * sigma * sigma);
    const auto share = [](const std::optional<Interval>& i, double truth) {
        return i && i->lower < truth && truth < i->upper ? 1.0 / trials : 0.0;
    };
    Coverage covered;
    for (std::size_t k = 0; k < trials; ++k) {
        const std::vector<double> values = lognormal_sample(k, 30, sigma);
        covered.bca_deviation +=
            share(bootstrap_interval_of_deviation(values, 0.95, {}), deviation);
        covered.bca_variation +=
            share(bootstrap_interval_of_variation(values, 0.95, {}), variation);
        covered.textbook_deviation += share(chi_square_interval_of_deviation(values), deviation);
    }
    return covered;
}

// Thirty values know little of the tail, and every nonparametric interval of a deviation falls
// short of its 95 %. The shares that must be reached are regression numbers.
TEST(Bootstrap, CoversLognormalDeviations) {
    const Coverage narrow = coverage(0.2);
    EXPECT_GE(narrow.bca_deviation, 0.86);
    EXPECT_GE(narrow.bca_variation, 0.87);
    EXPECT_LE(narrow.bca_deviation, 0.97);

    const Coverage wide = coverage(0.6);
    EXPECT_GE(wide.bca_deviation, 0.77);
    EXPECT_GE(wide.bca_variation, 0.79);
    EXPECT_GE(wide.bca_deviation, wide.textbook_deviation + 0.1);
}

TEST(Bootstrap, IsEmptyWhereItCannotTell) {
    EXPECT_FALSE(bootstrap_interval_of_deviation({}));
    EXPECT_FALSE(bootstrap_interval_of_deviation(std::vector{1.0, 2.0}));
    EXPECT_FALSE(bootstrap_interval_of_variation(std::vector{1.0, 2.0, 3.0, 4.0}));
    EXPECT_TRUE(bootstrap_interval_of_variation(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}));
    EXPECT_FALSE(bootstrap_interval_of_deviation(std::vector<double>(9, 0.1)));
    const std::vector<double> replicates = {1, 2, 3};
    EXPECT_FALSE(bca_interval(0.5, replicates, replicates, 0.95));
    EXPECT_FALSE(bca_interval(3.5, replicates, replicates, 0.95));
}

TEST(Bootstrap, RefusesBadInput) {
    EXPECT_THROW(bootstrap_interval_of_deviation(std::vector{1.0, std::nan("")}), InputError);
    EXPECT_THROW(bootstrap_interval_of_variation(std::vector{1.0, 2.0, 0.0, 3.0, 4.0}), InputError);
    EXPECT_THROW(bootstrap_interval_of_deviation(strengths.values, 1.0), InputError);
    EXPECT_THROW(bootstrap_interval_of_deviation(strengths.values, 0.95, {.resamples = 99}),
                 InputError);
    EXPECT_THROW(bootstrap_replicates({}, deviation, {}), InputError);
    EXPECT_THROW(jackknife_replicates(std::vector{1.0}, deviation), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
