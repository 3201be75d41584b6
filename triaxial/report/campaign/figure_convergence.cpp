#include <fmt/format.h>

#include <algorithm>

#include "triaxial/report/axis_ticks.hpp"
#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/text.hpp"
#include "triaxial/statistics/convergence.hpp"

namespace grainfield::triaxial::report {

Figure convergence_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                          std::span<const double> values, std::optional<double> deterministic) {
    const statistics::Convergence run = statistics::convergence(values);
    DataBlock runs;
    for (std::size_t k = 0; k < run.count.size(); ++k)
        runs.row(run.count[k], run.mean[k], run.mean_interval[k].lower, run.mean_interval[k].upper,
                 run.deviation[k], run.deviation_interval[k].lower,
                 run.deviation_interval[k].upper);
    // The first few intervals are wider than anything worth seeing.
    const std::size_t look = std::min<std::size_t>(run.count.size() - 1, 8);
    const double mean = run.mean.back(), deviation = run.deviation.back();
    const double reach =
        1.1 * std::max(run.mean_interval[look].upper - mean, mean - run.mean_interval[look].lower);
    double low = std::min(mean - reach, deterministic.value_or(mean) - 0.1 * reach);
    if (std::ranges::min(values) >= 0) low = std::max(low, 0.0);
    const double high = std::max(mean + reach, deterministic.value_or(mean) + 0.1 * reach);
    return {gnuplot.svg(
                "figure_convergence", id, "Mean and deviation over realizations", {1000, 340},
                {{"runs", runs},
                 {"last", run.count.back()},
                 {"step", std::max(1.0, round_step(double(run.count.back()), 8))},
                 {"dots", run.count.size() <= 20 ? 0.45 : 0.0},
                 {"low", low},
                 {"high", high},
                 {"most",
                  std::max({2.2 * deviation, 1.1 * run.deviation_interval[look].upper, 1e-300})},
                 {"symbol", quantity.symbol},
                 {"unit", quantity.unit},
                 {"has_deterministic", deterministic.has_value()},
                 {"deterministic", deterministic.value_or(mean)}}),
            fmt::format("Mean and standard deviation of the {} over the number of realizations, "
                        "with 95 % intervals (Student’s t; χ²).",
                        quantity.name)};
}

}  // namespace grainfield::triaxial::report
