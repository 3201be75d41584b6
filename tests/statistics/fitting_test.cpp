// Fits: by what a maximum is, by closed forms, and at the edges. Numbers of SciPy's are in
// distributions_test.cpp.

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/digamma.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"
#include "triaxial/statistics/distributions.hpp"

namespace grainfield::triaxial::statistics {
namespace {

double likelihood(Fit fit, double factor0, double factor1, std::span<const double> values) {
    fit.parameters[0] *= factor0;
    fit.parameters[1] *= factor1;
    double sum = 0;
    for (const double x : values) sum += fit.log_pdf(x);
    return sum;
}

TEST(Fitting, FitsAreMaximaOfTheLikelihood) {
    // A step h off a maximum costs of the order n h^2, a slope would gain as much in one of the
    // directions; round-off of the sums is 1e-13 of some hundreds.
    for (const Reference* sample : {&strengths, &stiffnesses})
        for (const Family family : all_families) {
            const Fit f = fit(family, sample->values);
            const double best = likelihood(f, 1, 1, sample->values);
            EXPECT_DOUBLE_EQ(best, f.log_likelihood);
            for (const double h : {-1e-4, 1e-4}) {
                EXPECT_LT(likelihood(f, 1 + h, 1, sample->values), best) << name(family);
                EXPECT_LT(likelihood(f, 1, 1 + h, sample->values), best) << name(family);
                EXPECT_LT(likelihood(f, 1 + h, 1 - h, sample->values), best) << name(family);
            }
        }
}

TEST(Fitting, GammaShapeIsExactFromWideToNarrow) {
    // Of two values A (1 +- d), s = ln(A) - mean(ln x) is -ln(1 - d^2)/2 exactly. Where the shape
    // is large, k = 1/(2s) + 1/6 - s/18 + O(s^2) by inversion of the series of ln(k) - psi(k).
    for (const double d : {1e-3, 1e-5, 3e-7, 1e-8}) {
        const std::vector values = {3.1e5, 3.1e5 * (1 + 2 * d)};
        const Fit f = fit(Family::gamma, values);
        const double exact_d = (values[1] - values[0]) / (values[1] + values[0]);
        const double s = -0.5 * std::log1p(-exact_d * exact_d);
        const double k = 0.5 / s + 1.0 / 6 - s / 18;
        EXPECT_NEAR(f.parameters[0], k, 2e-15 * k + s * s) << d;
        EXPECT_NEAR(f.mean(), 3.1e5 * (1 + d), 1e-15 * 3.1e5);
    }
    // Elsewhere by the equation itself; 0.031 gives 1040, just beyond where the series begins.
    for (const double d : {0.031, 0.032, 0.25, 0.5, 0.9375, 1 - 0x1p-30}) {
        const long double k = fit(Family::gamma, std::vector{1 - d, 1 + d}).parameters[0];
        const long double s = -0.5L * std::log1p(-static_cast<long double>(d) * d);
        const long double left = std::log(k) - boost::math::digamma(k);
        EXPECT_NEAR(static_cast<double>(left / s), 1, 1e-14) << d;
    }
}

TEST(Fitting, WeibullSolvesItsEquation) {
    for (const double sigma : {1e-6, 0.1, 3.0}) {
        const std::vector<double> values = lognormal_sample(1, 50, sigma);
        const Fit f = fit(Family::weibull, values);
        const auto [k, lambda] = f.parameters;
        double weights = 0;
        double weighted = 0;
        double log_mean = 0;
        for (const double x : values) {
            const double log_t = std::log(x / lambda);
            weights += std::exp(k * log_t) / 50;
            weighted += std::exp(k * log_t) * log_t / 50;
            log_mean += log_t / 50;
        }
        EXPECT_NEAR(weights, 1, 1e-9 * (sigma < 1e-3 ? 1 : 1e-3)) << sigma;
        EXPECT_NEAR(k * (weighted / weights - log_mean), 1, 1e-9 * (sigma < 1e-3 ? 1 : 1e-3));
    }
}

TEST(Fitting, FitsFollowTheUnit) {
    std::vector<double> kilo = strengths.values;
    for (double& x : kilo) x /= 1000;
    for (const Family family : {Family::gamma, Family::weibull}) {
        const Fit in_pa = fit(family, strengths.values);
        const Fit in_kpa = fit(family, kilo);
        EXPECT_NEAR(in_kpa.parameters[0], in_pa.parameters[0], 1e-13 * in_pa.parameters[0]);
        EXPECT_NEAR(in_kpa.parameters[1], in_pa.parameters[1] / 1000, 1e-16 * in_pa.parameters[1]);
    }
}

TEST(Fitting, AicFindsTheFamilyOfALargeSample) {
    const auto drawn_from = [](Fit f, std::size_t n) {
        std::vector<double> values = uniform_sample(5, n);
        for (double& x : values) x = f.quantile(x);
        return values;
    };
    const std::array<Fit, 4> truths = {Fit{Family::normal, {10, 2}}, Fit{Family::lognormal, {1, 1}},
                                       Fit{Family::gamma, {2, 3}}, Fit{Family::weibull, {3, 2}}};
    for (const Fit& truth : truths) {
        const std::vector<Fit> all = fits(drawn_from(truth, 4000));
        ASSERT_EQ(all.size(), 4);
        EXPECT_EQ(all.front().family, truth.family) << name(truth.family);
        for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k - 1].aic(), all[k].aic());
        // Deviations of these estimates are at most 1.5/sqrt(n) of the parameter; 4.9 of them.
        for (int p = 0; p < 2; ++p)
            EXPECT_NEAR(all.front().parameters[p], truth.parameters[p],
                        4.9 * 1.5 / std::sqrt(4000) * truth.parameters[p]);
    }
}

TEST(Fitting, LeaveOutPositiveFamiliesBelowZero) {
    const std::vector<Fit> all = fits(std::vector{-1.0, 2.0, 3.0});
    ASSERT_EQ(all.size(), 1);
    EXPECT_EQ(all.front().family, Family::normal);
}

TEST(Fitting, LognormalByMomentsHasTheMoments) {
    const Fit f = lognormal_by_moments(strengths.values);
    EXPECT_NEAR(f.mean(), strengths.mean, 1e-13 * strengths.mean);
    EXPECT_NEAR(f.deviation(), strengths.deviation, 1e-12 * strengths.deviation);
    EXPECT_EQ(f.fitted, 2);
    EXPECT_EQ(f.count, strengths.values.size());
    const Fit likeliest = fit(Family::lognormal, strengths.values);
    EXPECT_LT(f.log_likelihood, likeliest.log_likelihood);
    EXPECT_GT(f.log_likelihood, likeliest.log_likelihood - 1);

    const Fit given = lognormal_of(250e3, 25e3);
    EXPECT_NEAR(given.mean(), 250e3, 1e-13 * 250e3);
    EXPECT_NEAR(given.deviation(), 25e3, 1e-12 * 25e3);
    EXPECT_EQ(given.fitted, 0);
    EXPECT_EQ(given.aic(), 0);
}

TEST(Fitting, RefuseBadInput) {
    const double nan = std::nan("");
    for (const Family family : all_families) {
        EXPECT_THROW(fit(family, {}), InputError);
        EXPECT_THROW(fit(family, std::vector{1.0}), InputError);
        EXPECT_THROW(fit(family, std::vector<double>(9, 0.3)), InputError);
        EXPECT_THROW(fit(family, std::vector{1.0, 1.0 + 1e-10}), InputError);
        EXPECT_THROW(fit(family, std::vector{1.0, nan, 2.0}), InputError);
        const bool negative_is_bad = family != Family::normal;
        for (const double bad : {-1.0, 0.0}) {
            const std::vector values = {1.0, bad, 2.0};
            if (negative_is_bad)
                EXPECT_THROW(fit(family, values), InputError);
            else
                EXPECT_NO_THROW(fit(family, values));
        }
        const Fit two = fit(family, std::vector{1.0, 2.0});
        EXPECT_TRUE(std::isfinite(two.log_likelihood));
    }
    EXPECT_THROW(fits(std::vector{1.0, nan}), InputError);
    EXPECT_THROW(lognormal_by_moments(std::vector{-1.0, 2.0}), InputError);
    EXPECT_THROW(lognormal_by_moments(std::vector{2.0, 2.0}), InputError);
    EXPECT_THROW(lognormal_of(1, 0), InputError);
    EXPECT_THROW(lognormal_of(-1, 1), InputError);
    EXPECT_THROW(lognormal_of(nan, 1), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
