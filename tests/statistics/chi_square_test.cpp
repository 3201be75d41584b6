// Pearson's test: against SciPy, by hand, and between its two bounds under the null.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/statistics/reference_values.hpp"
#include "tests/statistics/samples.hpp"
#include "triaxial/statistics/goodness_of_fit.hpp"

namespace grainfield::triaxial::statistics {
namespace {

TEST(ChiSquare, AgreesWithSciPy) {
    for (const Reference* sample : {&strengths, &stiffnesses})
        for (const FamilyReference& r : sample->families) {
            const auto test = chi_square_test(sample->values, fit(r.family, sample->values));
            ASSERT_TRUE(test);
            EXPECT_EQ(test->bins, sample->chi_square_bins);
            EXPECT_EQ(test->degrees_of_freedom, sample->chi_square_bins - 3);
            EXPECT_NEAR(test->statistic, r.chi_square, 1e-12 * r.chi_square);
            EXPECT_NEAR(test->p_value, r.chi_square_p, 1e-12);
        }
}

TEST(ChiSquare, ExpectsFiveValuesABin) {
    for (std::size_t n = 0; n < 3000; ++n) EXPECT_GE(n, 5 * chi_square_bins(n));
    EXPECT_EQ(chi_square_bins(19), 3);
    EXPECT_EQ(chi_square_bins(20), 4);
    EXPECT_EQ(chi_square_bins(1024), 32);  // 2 * 1024^(2/5) exactly
    EXPECT_EQ(chi_square_bins(2000), 42);
}

TEST(ChiSquare, OfAPrescribedDistributionByHand) {
    // Ten values in the lower of two bins, six in the upper: (2^2 + 2^2)/8, one degree of freedom.
    std::vector<double> values(16, -1.0);
    std::fill_n(values.begin(), 6, 1.0);
    const auto test = chi_square_test(values, Fit{}, 2);
    ASSERT_TRUE(test);
    EXPECT_DOUBLE_EQ(test->statistic, 1);
    EXPECT_EQ(test->degrees_of_freedom, 1);
    EXPECT_NEAR(test->p_value, std::erfc(std::sqrt(0.5)), 1e-14);
}

TEST(ChiSquare, UnderTheNullLiesBetweenItsTwoBounds) {
    constexpr std::size_t trials = 1000;
    std::vector<double> p;
    std::vector<double> p_of_two_degrees_more;
    for (std::size_t k = 0; k < trials; ++k) {
        const std::vector<double> values = lognormal_sample(k, 200, 0.3);
        const auto test = *chi_square_test(values, fit(Family::lognormal, values));
        p.push_back(test.p_value);
        const boost::math::chi_squared chi2(static_cast<double>(test.degrees_of_freedom) + 2);
        p_of_two_degrees_more.push_back(cdf(complement(chi2, test.statistic)));
    }
    EXPECT_LT(excess_below_uniform(p), largest_excess(trials));
    EXPECT_LT(excess_above_uniform(p_of_two_degrees_more), largest_excess(trials));
}

TEST(ChiSquare, IsEmptyForTooFewAndRefusesBadInput) {
    std::vector<double> values = strengths.values;
    const std::vector<double> seven(values.begin(), values.begin() + 7);
    EXPECT_FALSE(chi_square_test(seven, fit(Family::normal, seven)));
    EXPECT_FALSE(chi_square_test({}, Fit{}));
    const std::vector<double> nineteen(values.begin(), values.begin() + 19);
    EXPECT_FALSE(chi_square_test(nineteen, fit(Family::normal, nineteen)));
    EXPECT_TRUE(chi_square_test(nineteen, fit(Family::normal, nineteen), 4));
    EXPECT_THROW(chi_square_test(values, fit(Family::normal, values), 3), InputError);
    EXPECT_THROW(chi_square_test({}, Fit{}, 4), InputError);
    values[3] = std::nan("");
    EXPECT_THROW(chi_square_test(values, Fit{}), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::statistics
