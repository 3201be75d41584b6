// Moments and classical intervals: against SciPy, by coverage, and at the edges.

#include "triaxial/statistics/moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"
#include "triaxial/statistics/convergence.hpp"

namespace grainfield::triaxial::statistics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Moments, AgreeWithSciPy) {
    for (const Reference* r : {&strengths, &stiffnesses}) {
        EXPECT_NEAR(*mean(r->values), r->mean, 1e-14 * r->mean);
        EXPECT_NEAR(*standard_deviation(r->values), r->deviation, 1e-13 * r->deviation);
        EXPECT_NEAR(*coefficient_of_variation(r->values), r->variation, 1e-13 * r->variation);
        EXPECT_NEAR(*skewness(r->values), r->skewness, 1e-12);
        const Interval t = *interval_of_mean(r->values);
        EXPECT_NEAR(t.lower, r->mean_interval.lower, 1e-12 * r->mean);
        EXPECT_NEAR(t.upper, r->mean_interval.upper, 1e-12 * r->mean);
        const Interval chi2 = *chi_square_interval_of_deviation(r->values);
        EXPECT_NEAR(chi2.lower, r->chi_square_interval.lower, 1e-12 * r->deviation);
        EXPECT_NEAR(chi2.upper, r->chi_square_interval.upper, 1e-12 * r->deviation);
    }
}

TEST(Moments, OfTwoValuesByHand) {
    const std::vector<double> two = {3, 1};
    EXPECT_DOUBLE_EQ(*mean(two), 2);
    EXPECT_DOUBLE_EQ(*standard_deviation(two), std::sqrt(2));
    EXPECT_DOUBLE_EQ(*coefficient_of_variation(two), std::sqrt(0.5));
    EXPECT_FALSE(skewness(two));
    // Student's t of one degree is Cauchy's: tan(pi (0.95 - 0.5)) at 90 %; s/sqrt(n) = 1.
    const double half = std::tan(0.45 * std::acos(-1.0));
    EXPECT_NEAR(interval_of_mean(two, 0.9)->lower, 2 - half, 1e-13 * half);
    EXPECT_NEAR(interval_of_mean(two, 0.9)->upper, 2 + half, 1e-13 * half);
}

TEST(Moments, KeepTheirDigitsFarFromZero) {
    std::vector<double> values(1000, 1e9);
    for (std::size_t i = 1; i < values.size(); i += 2) values[i] += 0.125;
    EXPECT_NEAR(*standard_deviation(values), 0.0625 * std::sqrt(1000.0 / 999), 1e-15);
    EXPECT_EQ(*mean(values), 1e9 + 0.0625);
}

TEST(Moments, OfEqualValues) {
    const std::vector<double> equal(7, 0.1);
    EXPECT_EQ(*mean(equal), 0.1);
    EXPECT_EQ(*standard_deviation(equal), 0);
    EXPECT_EQ(*coefficient_of_variation(equal), 0);
    EXPECT_FALSE(skewness(equal));
    EXPECT_EQ(*interval_of_mean(equal), (Interval{0.1, 0.1}));
    EXPECT_EQ(*chi_square_interval_of_deviation(equal), (Interval{0, 0}));
}

TEST(Moments, AreEmptyForTooFewAndRefuseWhatIsNoNumber) {
    const std::vector<double> one = {2.0};
    EXPECT_FALSE(mean({}));
    EXPECT_EQ(mean(one), 2.0);
    EXPECT_FALSE(standard_deviation(one));
    EXPECT_FALSE(coefficient_of_variation(one));
    EXPECT_FALSE(interval_of_mean(one));
    EXPECT_FALSE(chi_square_interval_of_deviation(one));
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
        const std::vector<double> values = {1.0, bad, 2.0};
        EXPECT_THROW(mean(values), InputError);
        EXPECT_THROW(standard_deviation(values), InputError);
        EXPECT_THROW(coefficient_of_variation(values), InputError);
        EXPECT_THROW(skewness(values), InputError);
        EXPECT_THROW(interval_of_mean(values), InputError);
        EXPECT_THROW(chi_square_interval_of_deviation(values), InputError);
        EXPECT_THROW(convergence(values), InputError);
    }
    EXPECT_THROW(coefficient_of_variation(std::vector{-1.0, 1.0}), InputError);
    for (const double confidence : {0.0, 1.0, -0.5, nan})
        EXPECT_THROW(interval_of_mean(strengths.values, confidence), InputError);
}

TEST(Moments, IntervalsOfNormalValuesCoverAsStated) {
    constexpr std::size_t trials = 4000;
    for (const double confidence : {0.95, 0.5}) {
        double mean_covered = 0;
        double deviation_covered = 0;
        for (std::size_t k = 0; k < trials; ++k) {
            const std::vector<double> values = normal_sample(k, 8);
            const Interval t = *interval_of_mean(values, confidence);
            const Interval chi2 = *chi_square_interval_of_deviation(values, confidence);
            mean_covered += t.lower < 0 && 0 < t.upper ? 1.0 / trials : 0;
            deviation_covered += chi2.lower < 1 && 1 < chi2.upper ? 1.0 / trials : 0;
        }
        const Interval allowed = share_of(confidence, trials);
        for (const double share : {mean_covered, deviation_covered}) {
            EXPECT_GE(share, allowed.lower);
            EXPECT_LE(share, allowed.upper);
        }
    }
}

TEST(Moments, StudentsIntervalHoldsForLognormalValues) {
    // A coefficient of variation of 0.31, thirty values: the mean is near normal.
    constexpr std::size_t trials = 500;
    const double truth = std::exp(0.5 * 0.3 * 0.3);
    double covered = 0;
    for (std::size_t k = 0; k < trials; ++k) {
        const Interval t = *interval_of_mean(lognormal_sample(k, 30, 0.3));
        covered += t.lower < truth && truth < t.upper ? 1.0 / trials : 0;
    }
    EXPECT_GE(covered, share_of(0.95, trials).lower);
    EXPECT_LE(covered, share_of(0.95, trials).upper);
}

TEST(Convergence, IsTheMomentsOfEveryBeginning) {
    const std::span<const double> values = stiffnesses.values;
    const Convergence all = convergence(values, 0.9);
    ASSERT_EQ(all.count.size(), values.size() - 1);
    ASSERT_EQ(all.mean.size(), all.count.size());
    ASSERT_EQ(all.mean_interval.size(), all.count.size());
    ASSERT_EQ(all.deviation.size(), all.count.size());
    ASSERT_EQ(all.deviation_interval.size(), all.count.size());
    for (std::size_t k = 0; k < all.count.size(); ++k) {
        ASSERT_EQ(all.count[k], k + 2);
        const auto first = values.first(k + 2);
        const double scale = 1e-13 * *mean(first);
        EXPECT_NEAR(all.mean[k], *mean(first), scale);
        EXPECT_NEAR(all.deviation[k], *standard_deviation(first), scale);
        // Quantiles of t are up to 6.3 here, of sqrt(1/chi2) up to 16.
        EXPECT_NEAR(all.mean_interval[k].lower, interval_of_mean(first, 0.9)->lower, 20 * scale);
        EXPECT_NEAR(all.mean_interval[k].upper, interval_of_mean(first, 0.9)->upper, 20 * scale);
        const Interval chi2 = *chi_square_interval_of_deviation(first, 0.9);
        EXPECT_NEAR(all.deviation_interval[k].lower, chi2.lower, 20 * scale);
        EXPECT_NEAR(all.deviation_interval[k].upper, chi2.upper, 20 * scale);
    }
}

TEST(Convergence, IsEmptyBelowTwoValues) {
    EXPECT_TRUE(convergence({}).count.empty());
    EXPECT_TRUE(convergence(std::vector{1.0}).mean.empty());
    EXPECT_THROW(convergence({}, 1.5), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
