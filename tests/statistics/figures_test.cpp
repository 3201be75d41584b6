// What figures of a campaign show: P-P plots with their bands, and histograms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"
#include "triaxial/statistics/goodness_of_fit.hpp"
#include "triaxial/statistics/histogram.hpp"
#include "triaxial/statistics/probability_plot.hpp"

namespace grainfield::triaxial::statistics {
namespace {

TEST(ProbabilityPlot, BandsAgreeWithSciPy) {
    for (const Reference* r : {&strengths, &stiffnesses}) {
        const Fit f = fit(Family::lognormal, r->values);
        const ProbabilityPlot plot = probability_plot(r->values, f);
        ASSERT_EQ(plot.points.size(), r->values.size());
        for (std::size_t k = 0; k < r->band_ranks.size(); ++k) {
            const ProbabilityPoint& point = plot.points[r->band_ranks[k] - 1];
            EXPECT_NEAR(point.lower, r->band_lower[k], 1e-11 * r->band_lower[k]);
            EXPECT_NEAR(point.upper, r->band_upper[k], 1e-11 * r->band_upper[k]);
        }
        double previous = 0;
        for (const ProbabilityPoint& point : plot.points) {
            EXPECT_GT(point.value, previous);
            EXPECT_EQ(point.fitted, f.cdf(point.value));
            previous = point.value;
        }
        EXPECT_DOUBLE_EQ(plot.points[4].empirical, 4.5 / static_cast<double>(r->values.size()));
    }
}

TEST(ProbabilityPlot, LargestDistanceIsKolmogorovsD) {
    const Fit f = fit(Family::gamma, strengths.values);
    const ProbabilityPlot plot = probability_plot(strengths.values, f);
    double distance = 0;
    for (const ProbabilityPoint& p : plot.points)
        distance = std::max(distance, std::abs(p.fitted - p.empirical));
    const auto n = static_cast<double>(plot.points.size());
    const auto d = *kolmogorov_smirnov_test(Family::gamma, strengths.values, {.resamples = 100});
    EXPECT_NEAR(distance + 0.5 / n, d.statistic, 1e-14);
    // By hand: sqrt(ln(2/0.05)/80) - 1/80.
    EXPECT_NEAR(plot.simultaneous_half_width, std::sqrt(std::log(40.0) / 80) - 0.0125, 1e-15);
}

TEST(ProbabilityPlot, BandsHoldWhatTheyPromise) {
    constexpr std::size_t trials = 800;
    double inside_all = 0;
    double inside_middle = 0;
    double inside_first = 0;
    const Fit standard;
    for (std::size_t k = 0; k < trials; ++k) {
        const ProbabilityPlot plot = probability_plot(normal_sample(k, 50), standard, 0.9);
        inside_all += std::ranges::all_of(plot.points, [&](const ProbabilityPoint& p) {
            return std::abs(p.fitted - p.empirical) <= plot.simultaneous_half_width;
        });
        const auto inside = [](const ProbabilityPoint& p) {
            return p.lower <= p.fitted && p.fitted <= p.upper;
        };
        inside_middle += inside(plot.points[24]);
        inside_first += inside(plot.points[0]);
    }
    const Interval allowed = share_of(0.9, trials);
    for (const double share : {inside_middle / trials, inside_first / trials}) {
        EXPECT_GE(share, allowed.lower);
        EXPECT_LE(share, allowed.upper);
    }
    // The inequality is on the safe side, by 1.6 % of probability for fifty values.
    EXPECT_GE(inside_all / trials, allowed.lower);
    EXPECT_LE(inside_all / trials, share_of(0.92, trials).upper);
}

TEST(ProbabilityPlot, TakesOneValueAndRefusesNone) {
    EXPECT_EQ(probability_plot(std::vector{0.0}, Fit{}).points.front().empirical, 0.5);
    EXPECT_THROW(probability_plot({}, Fit{}), InputError);
    EXPECT_THROW(probability_plot(std::vector{1.0, std::nan("")}, Fit{}), InputError);
    EXPECT_THROW(probability_plot(std::vector{1.0}, Fit{}, 0.0), InputError);
}

TEST(Histogram, AgreesWithNumPy) {
    for (const Reference* r : {&strengths, &stiffnesses}) {
        const auto h = histogram(r->values);
        ASSERT_TRUE(h);
        EXPECT_EQ(h->counts, r->histogram_counts);
        ASSERT_EQ(h->edges.size(), r->histogram_edges.size());
        for (std::size_t k = 0; k < h->edges.size(); ++k)
            EXPECT_NEAR(h->edges[k], r->histogram_edges[k], 1e-14 * r->histogram_edges[k]);
        double integral = 0;
        for (std::size_t k = 0; k < h->densities.size(); ++k)
            integral += h->densities[k] * (h->edges[k + 1] - h->edges[k]);
        EXPECT_NEAR(integral, 1, 1e-14);
    }
}

TEST(Histogram, CountsOnEdges) {
    const auto h = histogram(std::vector{0.0, 1.0, 2.0, 2.0, 3.0, 4.0}, 4);
    ASSERT_TRUE(h);
    EXPECT_EQ(h->edges, (std::vector<double>{0, 1, 2, 3, 4}));
    EXPECT_EQ(h->counts, (std::vector<std::size_t>{1, 1, 2, 2}));
    EXPECT_DOUBLE_EQ(h->densities[2], 2.0 / 6);
}

TEST(Histogram, FallsBackToSturgesAndStopsAtTheNumberOfValues) {
    std::vector<double> tied(16, 1.0);
    tied.front() = 0;
    tied.back() = 2;
    EXPECT_EQ(histogram(tied)->counts.size(), 5);  // log2(16) + 1
    std::vector<double> outlier = normal_sample(3, 50);
    outlier.back() = 1e9;
    EXPECT_EQ(histogram(outlier)->counts.size(), 50);
    EXPECT_EQ(histogram(outlier)->counts.back(), 1);
}

TEST(Histogram, IsEmptyBelowTwoDifferentValues) {
    EXPECT_FALSE(histogram({}));
    EXPECT_FALSE(histogram(std::vector{1.0}));
    EXPECT_FALSE(histogram(std::vector{1.0, 1.0, 1.0}));
    const auto two = histogram(std::vector{1.0, 3.0});
    ASSERT_TRUE(two);
    EXPECT_EQ(std::accumulate(two->counts.begin(), two->counts.end(), std::size_t{0}), 2);
    EXPECT_THROW(histogram(std::vector{1.0, 2.0}, 0), InputError);
    EXPECT_THROW(histogram(std::vector{1.0, std::nan("")}), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
