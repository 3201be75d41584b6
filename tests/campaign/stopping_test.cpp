// A case stops once its intervals are as narrow as asked, and always at the same realization.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.hpp"
#include "triaxial/campaign/stopping.hpp"
#include "triaxial/statistics/bootstrap.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial {
namespace {

std::vector<CampaignCase> one_case(const MonteCarloOptions& options) {
    std::vector<CampaignCase> cases(1);
    cases[0].config.montecarlo = options;
    return cases;
}

Row row(std::size_t k) {
    const core::RandomStream stream(3, core::Stream::perturbation);
    Row r;
    r.peak_deviator_stress = 120e3 * (1 + 0.02 * stream.normal(0, k));
    r.E50 = 30e6 * std::exp(0.2 * stream.normal(1, k));
    return r;
}

std::int64_t needed(const MonteCarloOptions& options, const std::vector<std::size_t>& order) {
    Stopping stopping(one_case(options));
    for (const std::size_t k : order) stopping.add({0, static_cast<std::int64_t>(k)}, row(k));
    return stopping.needed(0);
}

std::vector<std::size_t> in_order(std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
}

TEST(Stopping, WithoutTargetsAllAreNeeded) {
    EXPECT_EQ(needed({.realizations = 250}, in_order(250)), 250);
}

TEST(Stopping, IntervalsAreAsNarrowAsAskedAndWereNotBefore) {
    for (const double mean_error : {0.03, 0.05, 0.08}) {
        const auto n =
            needed({.realizations = 400, .target_mean_error = mean_error}, in_order(400));
        ASSERT_LT(n, 400) << mean_error;
        EXPECT_EQ(n % 10, 0);
        const auto error = [](std::int64_t count) {
            std::vector<double> E50;
            for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
                E50.push_back(row(k).E50);
            const auto interval = statistics::interval_of_mean(E50);
            return 0.5 * (interval->upper - interval->lower) / *statistics::mean(E50);
        };
        EXPECT_LE(error(n), mean_error);
        if (n > 20) {
            EXPECT_GT(error(n - 10), mean_error);
        }
    }
}

TEST(Stopping, TheDeviationTakesLonger) {
    const auto n = needed(
        {.realizations = 1000, .target_mean_error = 0.05, .target_sd_error = 0.15}, in_order(1000));
    EXPECT_LT(n, 1000);
    EXPECT_GT(n, needed({.realizations = 1000, .target_mean_error = 0.05}, in_order(1000)));
    std::vector<double> E50;
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) E50.push_back(row(k).E50);
    const auto interval = statistics::bootstrap_interval_of_deviation(E50);
    EXPECT_LT(interval->upper / *statistics::standard_deviation(E50), 1.16);
}

TEST(Stopping, TheOrderInWhichRowsCameDoesNotMatter) {
    const MonteCarloOptions options{.realizations = 300, .target_mean_error = 0.04};
    const auto n = needed(options, in_order(300));
    ASSERT_LT(n, 300);
    std::vector<std::size_t> order = in_order(300);
    std::ranges::reverse(order);
    EXPECT_EQ(needed(options, order), n);
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k * 7 % 300;
    EXPECT_EQ(needed(options, order), n);
    // A gap in front: nothing is known of what comes behind it.
    EXPECT_EQ(needed(options, {order.begin() + 1, order.end()}), 300);
}

TEST(Stopping, FailedRowsDoNotCountButDoNotHoldItUp) {
    Stopping stopping(one_case({.realizations = 300, .target_mean_error = 0.05}));
    for (std::size_t k = 0; k < 300; ++k) {
        Row r = row(k);
        r.failed = k % 5 == 0;
        stopping.add({0, static_cast<std::int64_t>(k)}, r);
    }
    EXPECT_LT(stopping.needed(0), 300);
    EXPECT_TRUE(stopping.wants({0, deterministic_run}));
    EXPECT_FALSE(stopping.wants({0, stopping.needed(0)}));
}

}  // namespace
}  // namespace grainfield::triaxial
