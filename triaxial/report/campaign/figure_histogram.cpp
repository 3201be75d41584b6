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
    DataBlock bins, curves;
    for (std::size_t k = 0; k < histogram->counts.size(); ++k)
        bins.row(0.5 * (histogram->edges[k] + histogram->edges[k + 1]), histogram->densities[k],
                 histogram->edges[k + 1] - histogram->edges[k]);
    const double from = histogram->edges.front(), to = histogram->edges.back();
    // What has no value below zero has no axis there.
    const double room = 0.15 * (to - from);
    const double low = from >= 0 ? std::max(from - room, 0.0) : from - room, high = to + room;
    constexpr int points = 200;
    for (int k = 0; k <= points; ++k) {
        const double x = low + (high - low) * k / points;
        curves.add(x);
        for (const statistics::Fit& fit : fits) curves.add(fit.pdf(x));
        curves.end_row();
    }
    std::vector<std::string> family;
    std::vector<double> aic;
    for (const statistics::Fit& fit : fits) {
        family.emplace_back(name(fit.family));
        aic.push_back(fit.aic() - fits.front().aic());
    }
    return {gnuplot.svg("figure_histogram", id, "Histogram with fitted distributions", {520, 420},
                        {{"bins", bins},
                         {"fits", curves},
                         {"family", family},
                         {"aic", aic},
                         {"low", low},
                         {"high", high},
                         {"symbol", quantity.symbol},
                         {"unit", quantity.unit}}),
            fmt::format("Histogram of the {} over {} realizations, with maximum-likelihood fits; "
                        "AIC counts from the best.",
                        quantity.name, values.size())};
}

}  // namespace grainfield::triaxial::report
