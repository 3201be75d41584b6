// Distributions: against SciPy, among themselves and at the edges.

#include "triaxial/statistics/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial::statistics {
namespace {

TEST(Distributions, FitsAgreeWithSciPy) {
    for (const Reference* sample : {&strengths, &stiffnesses})
        for (const FamilyReference& r : sample->families) {
            SCOPED_TRACE(name(r.family));
            const Fit f = fit(r.family, sample->values);
            const double x = sample->values.front();
            const auto expect_near = [](double value, double expected, double tolerance) {
                EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
            };
            EXPECT_EQ(f.count, sample->values.size());
            EXPECT_EQ(f.fitted, 2);
            // SciPy's equation for the gamma's shape loses three digits by cancellation.
            expect_near(f.parameters[0], r.parameters[0], 1e-12);
            expect_near(f.parameters[1], r.parameters[1], 1e-12);
            expect_near(f.log_likelihood, r.log_likelihood, 1e-13);
            expect_near(f.aic(), r.aic, 1e-13);
            expect_near(f.pdf(x), r.pdf, 1e-11);
            expect_near(f.cdf(x), r.cdf, 1e-11);
            expect_near(f.exceedance(3 * x), r.exceedance, 1e-10);
            expect_near(f.quantile(0.05), r.quantile, 1e-11);
            expect_near(f.mean(), r.mean, 1e-12);
            expect_near(f.deviation(), r.deviation, 1e-11);
        }
}

TEST(Distributions, FunctionsOfOneFitAgree) {
    for (const Family family : all_families) {
        SCOPED_TRACE(name(family));
        const Fit f = fit(family, strengths.values);
        for (const double p : {1e-12, 0.01, 0.3, 0.5, 0.9, 0.999}) {
            const double x = f.quantile(p);
            EXPECT_NEAR(f.cdf(x), p, 1e-11 * p);
            EXPECT_NEAR(f.exceedance(x), 1 - p, 1e-13);
            EXPECT_NEAR(f.log_pdf(x), std::log(f.pdf(x)), 1e-11);
            const double h = 1e-4 * std::abs(x);
            // Error of the central difference: h^2/6 of the density's curvature.
            EXPECT_NEAR((f.cdf(x + h) - f.cdf(x - h)) / (2 * h), f.pdf(x), 1e-5 * f.pdf(x));
        }
        // Far in the upper tail 1 - cdf would be zero, and further the density itself.
        EXPECT_GT(f.exceedance(f.mean() + 12 * f.deviation()), 0);
        EXPECT_TRUE(std::isfinite(f.log_pdf(f.mean() + 50 * f.deviation())));
    }
}

TEST(Distributions, PositiveFamiliesHaveNothingAtAndBelowZero) {
    for (const double x : {0.0, -1.0})
        for (const Family family : {Family::lognormal, Family::gamma, Family::weibull}) {
            const Fit f{.family = family, .parameters = {0.5, 2}};
            EXPECT_EQ(f.pdf(x), 0);
            EXPECT_EQ(f.cdf(x), 0);
            EXPECT_EQ(f.exceedance(x), 1);
            EXPECT_EQ(f.log_pdf(x), -std::numeric_limits<double>::infinity());
        }
    EXPECT_DOUBLE_EQ((Fit{.family = Family::normal, .parameters = {0, 2}}.cdf(0)), 0.5);
}

TEST(Distributions, RefuseWhatIsNoNumber) {
    const double nan = std::nan("");
    for (const Family family : all_families) {
        const Fit f{.family = family, .parameters = {0.5, 2}};
        for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
            EXPECT_THROW(f.pdf(bad), InputError);
            EXPECT_THROW(f.log_pdf(bad), InputError);
            EXPECT_THROW(f.cdf(bad), InputError);
            EXPECT_THROW(f.exceedance(bad), InputError);
        }
        for (const double p : {0.0, 1.0, nan}) EXPECT_THROW(f.quantile(p), InputError);
    }
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
