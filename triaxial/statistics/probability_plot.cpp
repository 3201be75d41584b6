#include "triaxial/statistics/probability_plot.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <cmath>

#include "core/base/errors.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {

ProbabilityPlot probability_plot(std::span<const double> values, const Fit& fit,
                                 double confidence) {
    require_finite(values);
    const double tail = tail_of(confidence);
    if (values.empty()) throw InputError("a probability plot of no values");
    const auto n = static_cast<double>(values.size());
    ProbabilityPlot plot;
    double rank = 0;
    for (const double x : sorted(values)) {
        rank += 1;
        plot.points.push_back({.value = x,
                               .empirical = (rank - 0.5) / n,
                               .fitted = fit.cdf(x),
                               .lower = boost::math::ibeta_inv(rank, n + 1 - rank, tail),
                               .upper = boost::math::ibetac_inv(rank, n + 1 - rank, tail)});
    }
    // 2/alpha = 1/tail.
    plot.simultaneous_half_width = std::sqrt(-std::log(tail) / (2 * n)) - 0.5 / n;
    return plot;
}

}  // namespace grainfield::triaxial::statistics
