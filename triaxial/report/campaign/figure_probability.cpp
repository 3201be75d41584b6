#include <fmt/format.h>

#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/text.hpp"
#include "triaxial/statistics/probability_plot.hpp"

namespace grainfield::triaxial::report {

Figure probability_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                          std::span<const double> values, const statistics::Fit& fit) {
    const statistics::ProbabilityPlot plot = statistics::probability_plot(values, fit);
    std::string rows;
    for (const statistics::ProbabilityPoint& p : plot.points)
        rows += fmt::format("{} {} {} {}\n", p.empirical, p.fitted, p.lower, p.upper);
    gnuplot.data(id + ".dat", rows);
    const double width = plot.simultaneous_half_width;
    const std::string script = fmt::format(
        R"(set xrange [0:1]
set yrange [0:1]
set size square
set xlabel 'Share of the values below' offset 0,0.3
set ylabel 'Fitted {family}' offset 0.5,0
set style fill solid 0.25 noborder
set key bottom right
plot '{id}.dat' using 1:3:4 with filledcurves lc rgb '{soft}' title '95 % of each point', \
     x+{width} with lines lw 1 dt 3 lc rgb '{muted}' title '95 % of all points', \
     x-{width} with lines lw 1 dt 3 lc rgb '{muted}' notitle, \
     x with lines lw 1 lc rgb '{muted}' notitle, \
     '{id}.dat' using 1:2 with points pt 7 ps 0.35 lc rgb '{main}' notitle
)",
        fmt::arg("family", name(fit.family)), fmt::arg("id", id), fmt::arg("soft", colour::soft),
        fmt::arg("width", width), fmt::arg("muted", colour::muted), fmt::arg("main", colour::main));
    return {gnuplot.svg(id, "Probability-probability plot", {480, 420}, script),
            fmt::format("P–P plot of the {} against the fitted {} distribution, with the band of "
                        "each point and that of all together.",
                        quantity.name, name(fit.family))};
}

}  // namespace grainfield::triaxial::report
