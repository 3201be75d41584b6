#include <fmt/format.h>

#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/text.hpp"
#include "triaxial/statistics/convergence.hpp"

namespace grainfield::triaxial::report {

Figure convergence_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                          std::span<const double> values, std::optional<double> deterministic) {
    const statistics::Convergence run = statistics::convergence(values);
    std::string rows;
    for (std::size_t k = 0; k < run.count.size(); ++k)
        rows +=
            fmt::format("{} {} {} {} {} {} {}\n", run.count[k], run.mean[k],
                        run.mean_interval[k].lower, run.mean_interval[k].upper, run.deviation[k],
                        run.deviation_interval[k].lower, run.deviation_interval[k].upper);
    const std::string data = id + ".dat";
    gnuplot.data(data, rows);
    // The first few intervals are wider than anything worth seeing.
    const std::size_t look = std::min<std::size_t>(run.count.size() - 1, 8);
    const double mean = run.mean.back(), deviation = run.deviation.back();
    const double reach =
        std::max(run.mean_interval[look].upper - mean, mean - run.mean_interval[look].lower);
    const double low = std::min(mean - reach, deterministic.value_or(mean) - 0.1 * reach);
    const double high = std::max(mean + reach, deterministic.value_or(mean) + 0.1 * reach);
    const std::string script = fmt::format(
        R"(set multiplot layout 1,2
set xrange [0:{last}]
set xlabel 'Number of realizations' offset 0,0.3
set style fill solid 0.25 noborder
set key above right horizontal
set yrange [{low}:{high}]
set ylabel 'Mean of {symbol} ({unit})' offset 0.5,0
plot '{data}' using 1:3:4 with filledcurves lc rgb '{soft}' title '95 % interval', \
     '{data}' using 1:2 with lines lw 1.8 lc rgb '{main}' title 'mean'{deterministic}
set yrange [0:{most}]
set ylabel 'Standard deviation of {symbol} ({unit})' offset 0.5,0
plot '{data}' using 1:6:7 with filledcurves lc rgb '{soft}' title '95 % interval', \
     '{data}' using 1:5 with lines lw 1.8 lc rgb '{main}' title 'standard deviation'
unset multiplot
)",
        fmt::arg("last", run.count.back()), fmt::arg("low", low), fmt::arg("high", high),
        fmt::arg("most", 2.2 * std::max(deviation, 1e-300)), fmt::arg("symbol", quantity.symbol),
        fmt::arg("unit", quantity.unit), fmt::arg("data", data), fmt::arg("soft", colour::soft),
        fmt::arg("main", colour::main),
        fmt::arg("deterministic", deterministic
                                      ? fmt::format(", {} with lines lw 1.2 dt 2 lc rgb '{}' title "
                                                    "'deterministic'",
                                                    *deterministic, colour::contrast)
                                      : std::string()));
    return {
        gnuplot.svg(id, fmt::format("Mean and deviation over realizations"), {1000, 340}, script),
        fmt::format("Mean and standard deviation of the {} over the number of realizations, "
                    "with 95 % intervals (Student’s t; χ²).",
                    quantity.name)};
}

}  // namespace grainfield::triaxial::report
