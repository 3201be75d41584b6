#include <fmt/format.h>

#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/text.hpp"
#include "triaxial/statistics/probability_plot.hpp"

namespace grainfield::triaxial::report {

Figure probability_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                          std::span<const double> values, const statistics::Fit& fit) {
    const statistics::ProbabilityPlot plot = statistics::probability_plot(values, fit);
    DataBlock points;
    for (const statistics::ProbabilityPoint& p : plot.points)
        points.row(p.empirical, p.fitted, p.lower, p.upper);
    return {gnuplot.svg("figure_probability", id, "Probability-probability plot", {520, 420},
                        {{"points", points},
                         {"band", plot.simultaneous_half_width},
                         {"family", name(fit.family)}}),
            fmt::format("P–P plot of the {} against the fitted {} distribution, with the band of "
                        "each point and that of all together.",
                        quantity.name, name(fit.family))};
}

}  // namespace grainfield::triaxial::report
