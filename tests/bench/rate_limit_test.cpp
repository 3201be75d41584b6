// The limit of endlessly slow tests, from values made by known laws.

#include "bench/rate_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/base/random.hpp"

namespace grainfield::bench {
namespace {

const std::vector<double> rates{0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002};

/// Two dampings with the limit 100: one whose values rise with the root of the rate, one whose
/// values fall with it; disturbed by normal numbers.
std::vector<RatePoint> made_points(double deviation, std::uint64_t seed) {
    const core::RandomStream random(seed, core::Stream::perturbation);
    std::vector<RatePoint> points;
    for (const double rate : rates) {
        const auto k = static_cast<std::uint64_t>(points.size());
        points.push_back(
            {0, rate, 100 + 60 * std::sqrt(rate) + deviation * random.normal(0, k), 1});
        points.push_back({1, rate, 100 - 20 * rate + deviation * random.normal(1, k), 1});
    }
    return points;
}

TEST(RateLimit, IsThatOfTheLawsThatMadeThePoints) {
    const RateLimit limit = rate_limit(made_points(0, 1), 2, 1.0);
    EXPECT_NEAR(limit.value, 100, 0.1);  // the grid's steps are 0.08
    EXPECT_NEAR(limit.laws[0].exponent, 0.5, 0.02);
    EXPECT_NEAR(limit.laws[0].slope, 60, 1);
    EXPECT_NEAR(limit.laws[1].slope, -20, 1);
    EXPECT_LT(limit.low, 100);
    EXPECT_GT(limit.high, 100);
    EXPECT_NEAR(limit.rate_within(0, 0.05), std::pow(5.0 / 60, 2), 5e-4);
}

// At 95 %, of 60 intervals fewer than 50 hold the truth once in 5,000 times.
TEST(RateLimit, IntervalsHoldTheTruthAsOftenAsTheySay) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const RateLimit limit = rate_limit(made_points(1.5, seed), 2, 1.5);
        held += limit.low <= 100 && 100 <= limit.high ? 1 : 0;
    }
    EXPECT_GE(held, 50);
}

// Misfit beyond the scatter of single runs widens the interval.
TEST(RateLimit, IsLessSureWhereTheLawsDoNotFit) {
    std::vector<RatePoint> points = made_points(1.5, 3);
    const RateLimit even = rate_limit(points, 2, 1.5);
    for (std::size_t k = 0; k < points.size(); ++k) points[k].value += k % 3 == 0 ? 12 : -6;
    const RateLimit rough = rate_limit(points, 2, 1.5);
    EXPECT_GT(rough.misfit, 5);
    EXPECT_GT(rough.high - rough.low, 2 * (even.high - even.low));
}

}  // namespace
}  // namespace grainfield::bench
