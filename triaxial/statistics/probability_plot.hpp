#pragma once
// The P-P plot of a fit: what share of the values lies below each of them, and what share the
// distribution expects there. On the diagonal all is well; the bands say how far off is chance.

#include <span>
#include <vector>

#include "triaxial/statistics/distributions.hpp"

namespace grainfield::triaxial::statistics {

/// The i-th smallest of n values.
struct ProbabilityPoint {
    double value = 0;      ///< [as the values]
    double empirical = 0;  ///< plotting position (i - 0.5)/n [-]
    double fitted = 0;     ///< the fit's cdf at the value [-]
    double lower = 0;      ///< pointwise band of `fitted` [-]
    double upper = 0;      ///< pointwise band of `fitted` [-]
};

struct ProbabilityPlot {
    std::vector<ProbabilityPoint> points;  ///< in the order of the values

    /// With the stated confidence all points lie within this distance of the diagonal: of
    /// `fitted` from `empirical` [-].
    double simultaneous_half_width = 0;
};

/// The points of a P-P plot and its bands, true for a distribution known beforehand and on the
/// safe side for one fitted to these values (a fit follows them). Pointwise: the i-th of n uniform
/// values has the beta distribution (i, n + 1 - i). Simultaneous: Kolmogorov's, by the inequality
/// of Dvoretzky, Kiefer & Wolfowitz with Massart's constant (1990, Annals of Probability 18), which
/// holds for any n: |F_n - F| <= sqrt(ln(2/alpha)/(2n)), less the 1/(2n) from a step of F_n to its
/// middle. Throws InputError without values or where one is not finite.
ProbabilityPlot probability_plot(std::span<const double> values, const Fit& fit,
                                 double confidence = 0.95);

}  // namespace grainfield::triaxial::statistics
