#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/text.hpp"
#include "triaxial/statistics/histogram.hpp"

namespace grainfield::triaxial::report {

Figure histogram_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                        std::span<const double> values, std::span<const statistics::Fit> fits) {
    const auto histogram = statistics::histogram(values);
    if (!histogram) throw InputError("a histogram needs values that differ");
    std::string rows;
    for (std::size_t k = 0; k < histogram->counts.size(); ++k)
        rows += fmt::format("{} {} {}\n", 0.5 * (histogram->edges[k] + histogram->edges[k + 1]),
                            histogram->densities[k], histogram->edges[k + 1] - histogram->edges[k]);
    gnuplot.data(id + "-bins.dat", rows);
    const double from = histogram->edges.front(), to = histogram->edges.back();
    const double low = from - 0.15 * (to - from), high = to + 0.15 * (to - from);
    std::string curves, lines;
    constexpr int points = 200;
    for (int k = 0; k <= points; ++k) {
        const double x = low + (high - low) * k / points;
        curves += fmt::format("{}", x);
        for (const statistics::Fit& fit : fits) curves += fmt::format(" {}", fit.pdf(x));
        curves += '\n';
    }
    gnuplot.data(id + "-fits.dat", curves);
    for (std::size_t f = 0; f < fits.size(); ++f) {
        const bool lognormal = fits[f].family == statistics::Family::lognormal;
        lines += fmt::format(
            ", \\\n '{}-fits.dat' using 1:{} with lines lw {} dt {} lc rgb '{}' title '{}, AIC "
            "{:+.1f}'",
            id, f + 2, lognormal ? 2.4 : 1.3, lognormal ? 1 : static_cast<int>(f) + 2,
            lognormal ? colour::contrast : colour::muted, name(fits[f].family),
            fits[f].aic() - fits.front().aic());
    }
    const std::string script = fmt::format(
        R"(set xrange [{low}:{high}]
set yrange [0:*]
set xlabel '{symbol} ({unit})' offset 0,0.3
set ylabel 'Probability density (1/{unit})' offset 0.5,0
set style fill solid 0.5 border lc rgb '#ffffff'
set key above right maxrows 2
plot '{id}-bins.dat' using 1:2:3 with boxes lc rgb '{soft}' notitle{lines}
)",
        fmt::arg("low", low), fmt::arg("high", high), fmt::arg("symbol", quantity.symbol),
        fmt::arg("unit", quantity.unit), fmt::arg("id", id), fmt::arg("soft", colour::soft),
        fmt::arg("lines", lines));
    return {gnuplot.svg(id, "Histogram with fitted distributions", {640, 420}, script),
            fmt::format("Histogram of the {} over {} realizations, with maximum-likelihood fits; "
                        "AIC counts from the best.",
                        quantity.name, values.size())};
}

}  // namespace grainfield::triaxial::report
