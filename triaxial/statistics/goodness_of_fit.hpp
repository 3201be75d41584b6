#pragma once
// Does a distribution fit? Three tests, whose p values allow for parameters that were estimated
// from the very values tested.
//
// A campaign is looked at while it runs: too few values for a test give none, not an error. Values
// that the family cannot be fitted to throw InputError, as fit() does.

#include <cstddef>
#include <optional>
#include <span>

#include "triaxial/statistics/distributions.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {

struct ChiSquareTest {
    double statistic = 0;                ///< sum of (observed - expected)^2/expected [-]
    double p_value = 0;                  ///< [-]
    std::size_t bins = 0;                ///< of equal probability under the fit [-]
    std::size_t degrees_of_freedom = 0;  ///< bins - 1 - fitted parameters [-]
};

struct DistanceTest {
    double statistic = 0;  ///< D or A^2 [-]
    double p_value = 0;    ///< [-]
};

/// Bins of the chi-square test for n values: 2 n^(2/5), rounded (Moore 1986 in D'Agostino &
/// Stephens, "Goodness-of-Fit Techniques", section 3.2.4), but no more than expect 5 values each.
std::size_t chi_square_bins(std::size_t n);

/// Pearson's test over bins of equal probability under `fit`, as many as given or chi_square_bins.
/// Parameters fitted to the ungrouped values take less freedom than is subtracted: the true p lies
/// between this one and that of `fitted` degrees more (Chernoff & Lehmann 1954). Empty where
/// chi_square_bins leaves no degree of freedom (n < 20 after a fit of two parameters); throws
/// InputError where the bins given leave none, however few values they expect.
std::optional<ChiSquareTest> chi_square_test(std::span<const double> values, const Fit& fit,
                                             std::optional<std::size_t> bins = {});

/// Lilliefors' test (1967, JASA 62): Kolmogorov-Smirnov's D against the family's distribution with
/// parameters estimated from the values: mean and deviation over n - 1 for normal values and for
/// the logarithms of lognormal ones, maximum likelihood for gamma and Weibull. The p is
/// (1 + r)/(1 + R) of a parametric bootstrap: r of R samples of the fit, fitted again, reach D
/// (Davison & Hinkley 1997, Eq. 4.11; Stream::parametric_bootstrap). Empty below eight values.
std::optional<DistanceTest> kolmogorov_smirnov_test(Family family, std::span<const double> values,
                                                    const Resampling& resampling = {});

/// Anderson-Darling's A^2, parameters as above. The p is anderson_darling_p's for normal and
/// lognormal, the bootstrap's as above for gamma and Weibull. Empty below eight values.
std::optional<DistanceTest> anderson_darling_test(Family family, std::span<const double> values,
                                                  const Resampling& resampling = {});

/// p of A^2 for n >= 8 normal values of estimated mean and deviation, from A* = A^2 (1 + 0.75/n +
/// 2.25/n^2): Stephens 1986 in D'Agostino & Stephens, Tables 4.7 and 4.9. The table's formula ends
/// at A* = 13, where p is 5e-31; the p there stands for all beyond.
double anderson_darling_p(double statistic, std::size_t n);

}  // namespace grainfield::triaxial::statistics
