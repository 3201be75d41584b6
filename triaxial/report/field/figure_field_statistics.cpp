// Curves: correlation, histogram, variance of the cells.

#include <fmt/format.h>

#include <algorithm>
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
    // Above the correlations, below how far the estimates are off, which shows the bands.
    std::string above =
        "set multiplot layout 2,3\nset tmargin 2.6\nset bmargin 2\nset yrange [*<-0.1:1.12]\n"
        "set key at screen 0.5,0.99 center top horizontal samplen 1.2 width -1 font ',11'\n";
    std::string below = "set yrange [*:*]\nset tmargin 0.6\nset bmargin 3.4\nunset key\n";
    for (std::size_t d = 0; d < 3; ++d) {
        const char axis = "xyz"[d];
        const double edge = cell_size[static_cast<Eigen::Index>(d)];
        std::string rows;
        double lag = 0;
        for (const Estimate& one : check.correlation[d]) {
            rows +=
                fmt::format("{} {} {} {} {}\n", lag, one.estimate, one.exact, one.low, one.high);
            lag += edge;
        }
        gnuplot.data(fmt::format("{}-{}.dat", id, axis), rows);
        const auto panel = [&](std::string_view format) {
            return fmt::format(
                fmt::runtime(format), fmt::arg("axis", axis), fmt::arg("id", id),
                fmt::arg("low", -0.4 * edge), fmt::arg("high", lag - 0.6 * edge),
                fmt::arg("soft", colour::soft), fmt::arg("main", colour::main),
                fmt::arg("contrast", colour::contrast),
                fmt::arg("correlation", d == 0 ? "Correlation (-)" : ""),
                fmt::arg("off", d == 0 ? "Estimated - exact (-)" : ""),
                fmt::arg("band", d == 0 ? fmt::format("title '{} % band'", level) : "notitle"),
                fmt::arg("exact", d == 0 ? "title 'exact'" : "notitle"),
                fmt::arg("estimated", d == 0 ? "title 'estimated'" : "notitle"));
        };
        above += panel(R"(set xrange [{low}:{high}]
set ylabel '{correlation}' offset 1,0
plot '{id}-{axis}.dat' using 1:4:5 with filledcurves lc rgb '{soft}' fs transparent solid 0.45 {band}, \
 '' using 1:3 with lines lw 1.6 lc rgb '{main}' {exact}, \
 '' using 1:2 with points pt 7 ps 0.45 lc rgb '{contrast}' {estimated}
)");
        below += panel(R"(set xrange [{low}:{high}]
set xlabel 'Lag in {{/:Italic {axis}}} (m)' offset 0,0.3
set ylabel '{off}' offset 1,0
plot '{id}-{axis}.dat' using 1:($4-$3):($5-$3) with filledcurves lc rgb '{soft}' fs transparent solid 0.45 notitle, \
 0 with lines lw 1.6 lc rgb '{main}' notitle, \
 '' using 1:($2-$3) with points pt 7 ps 0.45 lc rgb '{contrast}' notitle
)");
    }
    return {
        gnuplot.svg(id, "Correlation of the cells along x, y and z", {1040, 580},
                    above + below + "unset multiplot\n"),
        fmt::format("Correlation of the blocks’ <i>G</i> along <i>x</i>, <i>y</i> and <i>z</i>: "
                    "estimated from the realizations, exact (local averages), and the band in "
                    "which all estimates of this figure together lie with {} %.",
                    level)};
}

Figure point_correlation_figure(const Gnuplot& gnuplot,
                                const randomfield::CorrelationModel& correlation, double longest) {
    constexpr double multiples[]{0.01, 0.1, 0.5, 1, 10};  // the paper's five, from theta_y = 1 m
    constexpr int points = 240;
    std::string rows, lines;
    for (int i = 0; i <= points; ++i) {
        const double tau = longest * std::pow(10.0, 1.0 - 5.0 * i / points);
        rows += fmt::format("{}", tau);
        for (const double multiple : multiples) {
            randomfield::CorrelationModel model = correlation;
            model.length *= multiple;
            rows += fmt::format(" {}", model(Vec3::Constant(tau)));
        }
        rows += '\n';
    }
    gnuplot.data("points.dat", rows);
    int column = 2;
    for (const double multiple : multiples) {
        lines += fmt::format(
            "{}'points.dat' using 1:{} with lines lw {} dt {} lc rgb '{}' title 'θ_y = {} m{}'",
            column == 2 ? "" : ", ", column, multiple == 1 ? 2.6 : 1.5, multiple == 1 ? 1 : column,
            multiple == 1 ? colour::contrast : colour::main,
            fmt::format("{:.3g}", multiple * correlation.length.y()),
            multiple == 1 ? ", this field" : "");
        ++column;
    }
    const std::string script = fmt::format(
        "set xlabel 'Lag τ_x = τ_y = τ_z (m)' offset 0,0.3\nset ylabel 'Correlation (-)' offset "
        "1,0\n"
        "set logscale x\nset format x '%g'\nset xrange [{}:{}]\nset yrange [*<0:1.02]\n"
        "set key outside right center Left reverse\nplot {}\n",
        1e-4 * longest, 10 * longest, lines);
    const Vec3& theta = correlation.length;
    return {gnuplot.svg("points", "Correlation function", {760, 420}, script),
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
    std::string rows, curve;
    for (std::size_t b = 0; b < check.shares.size(); ++b) {
        const Estimate& one = check.shares[b];
        // The two outer bins go on beyond the picture, where a share of 0.001 lies.
        const double beyond = b == 0 || b + 1 == check.shares.size() ? 1e-3 : 0.0;
        const double width = (edges[b + 1] - edges[b]) / unit.size;
        rows += fmt::format("{} {} {} {} {} {}\n", 0.5 * (edges[b] + edges[b + 1]) / unit.size,
                            (one.estimate - beyond) / width, width, (one.exact - beyond) / width,
                            (one.low - beyond) / width, (one.high - beyond) / width);
    }
    constexpr int points = 400;
    const double step = (check.last - check.first) / points;
    for (int i = 0; i <= points; ++i) {
        const double x = check.first + i * step;
        const double density =
            (marginals.cell_cdf(x + 0.5 * step) - marginals.cell_cdf(x - 0.5 * step)) / step;
        curve += fmt::format("{} {}\n", x / unit.size, density * unit.size);
    }
    gnuplot.data(id + "-bins.dat", rows);
    gnuplot.data(id + "-curve.dat", curve);
    const std::string script = fmt::format(
        R"(set xrange [{low}:{high}]
set yrange [0:*]
set xlabel '{label}' offset 0,0.3
set ylabel 'Probability density (1/{unit})' offset 0.5,0
set style fill solid 0.5 border lc rgb '#ffffff'
set key above right maxrows 1
plot '{id}-bins.dat' using 1:2:3 with boxes lc rgb '{soft}' title 'cells', \
 '{id}-curve.dat' using 1:2 with lines lw 1.8 lc rgb '{contrast}' title 'predicted', \
 '{id}-bins.dat' using 1:4:($1-0.22*$3):($1+0.22*$3):5:6 with boxxyerror fs transparent solid 0.4 noborder lc rgb '{ink}' title '{level} % band'
)",
        fmt::arg("low", check.first / unit.size), fmt::arg("high", check.last / unit.size),
        fmt::arg("label", unit.label), fmt::arg("unit", unit.name), fmt::arg("id", id),
        fmt::arg("soft", colour::soft), fmt::arg("contrast", colour::contrast),
        fmt::arg("ink", colour::ink), fmt::arg("level", level));
    return {
        gnuplot.svg(id, "Histogram of the cells' " + property_name(property), {640, 420}, script),
        fmt::format(
            "The {} of all blocks in bins of mostly 5 % each, the predicted distribution of a "
            "block’s value, and the band in which all bins together lie with {} %.",
            property_name(property), level)};
}

Figure variance_figure(const Gnuplot& gnuplot, const std::string& id,
                       const randomfield::VarianceMap& map) {
    constexpr std::size_t most = 4000;  // points in a picture
    const std::size_t stride = (map.ratio.size() + most - 1) / most;
    std::string rows;
    for (std::size_t c = 0; c < map.ratio.size(); ++c) {
        const double r = map.ratio[c];
        const bool outside = r < map.low || r > map.high;
        if (!std::isnan(r) && (outside || c % stride == 0))
            rows += fmt::format("{} {} {}\n", c, r, outside ? 1 : 0);
    }
    gnuplot.data(id + ".dat", rows);
    const std::string script = fmt::format(
        R"(set xlabel 'Cell' offset 0,0.3
set ylabel 'Variance over exact (-)' offset 1,0
set xrange [0:{cells}]
set key above right maxrows 1
plot {low} with lines lw 1.6 lc rgb '{ink}' title '{level} % band of all', {high} with lines lw 1.6 lc rgb '{ink}' notitle, \
 {slow} with lines dt 2 lc rgb '{muted}' title '95 % of one', {shigh} with lines dt 2 lc rgb '{muted}' notitle, \
 '{id}.dat' using 1:($3 == 0 ? $2 : 1/0) with points pt 7 ps 0.35 lc rgb '{main}' title 'cells', \
 '{id}.dat' using 1:($3 == 1 ? $2 : 1/0) with points pt 7 ps 0.6 lc rgb '{contrast}' notitle
)",
        fmt::arg("cells", std::max<std::size_t>(map.ratio.size(), 2) - 1), fmt::arg("low", map.low),
        fmt::arg("high", map.high), fmt::arg("slow", map.single_low),
        fmt::arg("shigh", map.single_high), fmt::arg("id", id), fmt::arg("main", colour::main),
        fmt::arg("contrast", colour::contrast), fmt::arg("ink", colour::ink),
        fmt::arg("muted", colour::muted), fmt::arg("level", level));
    return {gnuplot.svg(id, "Variance of every cell", {640, 420}, script),
            fmt::format("Variance of <i>G</i> of every block over the realizations, divided by the "
                        "exact one, with the chi-squared bands of one block (95 %) and of all "
                        "blocks together ({} %).",
                        level)};
}

}  // namespace grainfield::triaxial::report
