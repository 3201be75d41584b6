// Curves: correlation, histogram, variance of the cells.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "triaxial/report/field/field_figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

using randomfield::Estimate;

constexpr int level = 99;  ///< of all bands but that of a single cell [%]
static_assert(randomfield::false_alarm == 0.01);

}  // namespace

std::string property_name(const std::optional<randomfield::Property>& property) {
    if (!property) return "G";
    return *property == randomfield::Property::friction_angle ? "friction angle"
                                                              : "normal stiffness";
}

DisplayUnit display_unit(const std::optional<randomfield::Property>& property) {
    if (!property) return {1, "-", "{/:Italic G} (-)"};
    if (*property == randomfield::Property::friction_angle)
        return {1, "rad", "Friction angle φ (rad)"};
    return {1e6, "MPa", "Normal stiffness {/:Italic k}_n (MPa)"};
}

Figure correlation_figure(const Gnuplot& gnuplot, const std::string& id,
                          const randomfield::FieldCheck& check, const Vec3& cell_size) {
    DataBlock rows;
    std::vector<double> low, high;
    for (std::size_t d = 0; d < 3; ++d) {
        const double edge = cell_size[static_cast<Eigen::Index>(d)];
        double lag = 0;
        for (const Estimate& one : check.correlation[d]) {
            rows.row(lag, one.estimate, one.exact, one.low, one.high);
            lag += edge;
        }
        rows.end_part();
        low.push_back(-0.4 * edge);
        high.push_back(lag - 0.6 * edge);
    }
    return {
        gnuplot.svg("figure_correlation", id, "Correlation of the cells along x, y and z",
                    {1040, 580},
                    {{"correlation", rows}, {"low", low}, {"high", high}, {"band", level}}),
        fmt::format("Correlation of the blocks’ <i>G</i> along <i>x</i>, <i>y</i> and <i>z</i>: "
                    "estimated from the realizations, exact (local averages), and the band in "
                    "which all estimates of this figure together lie with {} %.",
                    level)};
}

Figure point_correlation_figure(const Gnuplot& gnuplot,
                                const randomfield::CorrelationModel& correlation, double longest) {
    constexpr std::array multiples{0.01, 0.1, 0.5, 1.0,
                                   10.0};  // those of Tran et al., from theta_y = 1 m
    constexpr int points = 240;
    DataBlock rows;
    for (int i = 0; i <= points; ++i) {
        const double tau = longest * std::pow(10.0, 1.0 - 5.0 * i / points);
        rows.add(tau);
        for (const double multiple : multiples) {
            randomfield::CorrelationModel model = correlation;
            model.length *= multiple;
            rows.add(model(Vec3::Constant(tau)));
        }
        rows.end_row();
    }
    std::vector<double> lengths;
    for (const double multiple : multiples) lengths.push_back(multiple * correlation.length.y());
    const auto own = std::ranges::find(multiples, 1.0) - multiples.begin() + 1;
    const Vec3& theta = correlation.length;
    return {gnuplot.svg("figure_point_correlation", "points", "Correlation function", {760, 420},
                        {{"points", rows},
                         {"theta", lengths},
                         {"own", own},
                         {"shortest", 1e-4 * longest},
                         {"longest", 10 * longest}}),
            fmt::format("Correlation of two points τ<sub>x</sub> = τ<sub>y</sub> = τ<sub>z</sub> "
                        "apart ({}; θ<sub>x</sub> : θ<sub>y</sub> : θ<sub>z</sub> = {} : {} : {} "
                        "m for this field, and multiples of it).",
                        randomfield::name_of(correlation.kind), significant(theta.x(), 3),
                        significant(theta.y(), 3), significant(theta.z(), 3))};
}

Figure cell_histogram_figure(const Gnuplot& gnuplot, const std::string& id,
                             randomfield::Property property,
                             const randomfield::HistogramCheck& check,
                             const randomfield::RowMarginals& marginals) {
    const DisplayUnit unit = display_unit(property);
    std::vector<double> edges{check.first};
    edges.insert(edges.end(), check.edges.begin(), check.edges.end());
    edges.push_back(check.last);
    DataBlock bins, predicted;
    for (std::size_t b = 0; b < check.shares.size(); ++b) {
        const Estimate& one = check.shares[b];
        // The two outer bins go on beyond the picture, where a share of 0.001 lies.
        const double beyond = b == 0 || b + 1 == check.shares.size() ? 1e-3 : 0.0;
        const double width = (edges[b + 1] - edges[b]) / unit.size;
        bins.row(0.5 * (edges[b] + edges[b + 1]) / unit.size, (one.estimate - beyond) / width,
                 width, (one.exact - beyond) / width, (one.low - beyond) / width,
                 (one.high - beyond) / width);
    }
    constexpr int points = 400;
    const double step = (check.last - check.first) / points;
    for (int i = 0; i <= points; ++i) {
        const double x = check.first + i * step;
        const double density =
            (marginals.cell_cdf(x + 0.5 * step) - marginals.cell_cdf(x - 0.5 * step)) / step;
        predicted.row(x / unit.size, density * unit.size);
    }
    const std::string name = property_name(property);
    return {gnuplot.svg("figure_cell_histogram", id, "Histogram of the cells' " + name, {520, 400},
                        {{"bins", bins},
                         {"predicted", predicted},
                         {"low", check.first / unit.size},
                         {"high", check.last / unit.size},
                         {"quantity", unit.label},
                         {"unit", unit.name},
                         {"band", level}}),
            fmt::format(
                "The {} of all blocks in bins of mostly 5 % each, the predicted distribution of a "
                "block’s value, and the band in which all bins together lie with {} %.",
                name, level)};
}

Figure variance_figure(const Gnuplot& gnuplot, const std::string& id,
                       const randomfield::VarianceMap& map) {
    constexpr std::size_t most = 4000;  // points in a picture
    const std::size_t stride = (map.ratio.size() + most - 1) / most;
    DataBlock cells;
    for (std::size_t c = 0; c < map.ratio.size(); ++c) {
        const double r = map.ratio[c];
        const bool outside = r < map.low || r > map.high;
        if (!std::isnan(r) && (outside || c % stride == 0)) cells.row(c, r, outside ? 1 : 0);
    }
    return {gnuplot.svg("figure_variance", id, "Variance of every cell", {520, 400},
                        {{"cells", cells},
                         {"last", std::max<std::size_t>(map.ratio.size(), 2) - 1},
                         {"low", map.low},
                         {"high", map.high},
                         {"single_low", map.single_low},
                         {"single_high", map.single_high},
                         {"band", level}}),
            fmt::format("Variance of <i>G</i> of every block over the realizations, divided by the "
                        "exact one, with the chi-squared bands of one block (95 %) and of all "
                        "blocks together ({} %).",
                        level)};
}

}  // namespace grainfield::triaxial::report
