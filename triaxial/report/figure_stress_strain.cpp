#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

constexpr std::size_t most_points = 3000;  // more cannot be told apart in the figure

std::string curve_data(const Curve& curve) {
    const std::size_t stride = curve.size() / most_points + 1;
    std::string rows;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (i % stride != 0 && i + 1 != curve.size()) continue;
        rows += fmt::format("{} {} {}\n", 100 * curve.axial_strain[i],
                            1e-3 * curve.deviator_stress[i], 100 * curve.volumetric_strain[i]);
    }
    return rows;
}

/// From the least to the greatest value [%].
double curve_span(const std::vector<double>& strain) {
    const auto [low, high] = std::ranges::minmax(strain);
    return 100 * std::max(high - low, 1e-6);
}

/// A third of `span` or less, rounded to 1, 2 or 5 of its decade.
double round_step(double span) {
    const double step = span / 3, decade = std::pow(10, std::floor(std::log10(step)));
    return decade * (step >= 5 * decade ? 5 : step >= 2 * decade ? 2 : 1);
}

}  // namespace

Figure stress_strain_figure(const Gnuplot& gnuplot, const RunFolder& run) {
    gnuplot.data("curve.dat", curve_data(run.curve));
    const KeyResults& r = run.results;
    const double peak = 1e-3 * r.peak_deviator_stress;
    const double peak_strain = 100 * r.axial_strain_at_peak;
    const double half_strain = 100 * 0.5 * r.peak_deviator_stress / r.E50;
    const double last = 100 * std::max(std::ranges::max(run.curve.axial_strain), 1e-6);
    const bool label_left = peak_strain > 0.6 * last;
    const std::string script = fmt::format(
        R"(set multiplot
set lmargin at screen 0.135
set rmargin at screen 0.975
set xrange [0:{last}]
set tmargin at screen 0.97
set bmargin at screen 0.42
set yrange [{floor}:{ceiling}]
set format x ''
set ylabel 'Deviator stress {{/:Italic q}} (kPa)' offset 0.5,0
set key bottom right
set label 1 'peak {peak_text} kPa at {strain_text} %' at {peak_strain},{peak} {side} offset {shift},1.0 tc rgb '{ink}'
set label 2 '{{/:Italic E}}_{{50}} = {e50_text} MPa' at {half_strain},{half} left offset 1.5,-0.4 tc rgb '{contrast}'
$secant << EOD
0 0
{secant_strain} {peak}
EOD
$half << EOD
{half_strain} {half}
EOD
$peak << EOD
{peak_strain} {peak}
EOD
plot 'curve.dat' using 1:2 with lines lw 2 lc rgb '{main}' title 'measured at the walls', \
     $secant with lines lw 1.4 dt (6,4) lc rgb '{contrast}' title 'secant {{/:Italic E}}_{{50}}', \
     $half with points pt 7 ps 0.7 lc rgb '{contrast}' notitle, \
     $peak with points pt 7 ps 0.8 lc rgb '{main}' notitle
unset label
unset key
set tmargin at screen 0.38
set bmargin at screen 0.115
set yrange [*:*]
set offsets 0,0,graph 0.08,graph 0.08
set ytics {volumetric_step}
set format x '%g'
set xlabel 'Axial strain ε_1 (%)' offset 0,0.3
set ylabel 'Volumetric strain (%)' offset 0.5,0
set xzeroaxis lc rgb '{muted}' lw 1 dt (2,3)
plot 'curve.dat' using 1:3 with lines lw 2 lc rgb '{soft}' notitle
unset multiplot
)",
        fmt::arg("last", last), fmt::arg("peak", peak), fmt::arg("peak_strain", peak_strain),
        fmt::arg("floor", std::min(0.0, 1.1e-3 * std::ranges::min(run.curve.deviator_stress))),
        fmt::arg("ceiling", 1.16 * peak), fmt::arg("peak_text", significant(peak)),
        fmt::arg("strain_text", significant(peak_strain, 3)),
        fmt::arg("side", label_left ? "right" : "left"),
        fmt::arg("shift", label_left ? "-0.5" : "0.5"),
        fmt::arg("volumetric_step", round_step(curve_span(run.curve.volumetric_strain))),
        fmt::arg("half_strain", half_strain), fmt::arg("half", 0.5 * peak),
        fmt::arg("secant_strain", 2 * half_strain), fmt::arg("e50_text", significant(1e-6 * r.E50)),
        fmt::arg("ink", colour::ink), fmt::arg("muted", colour::muted),
        fmt::arg("main", colour::main), fmt::arg("soft", colour::soft),
        fmt::arg("contrast", colour::contrast));
    return {gnuplot.svg("stress_strain", "Deviator stress and volumetric strain over axial strain",
                        {520, 500}, script),
            fmt::format("Deviator stress and volumetric strain (contraction positive) over axial "
                        "strain. <i>E</i><sub>50</sub> is the secant to half the {}.",
                        r.peak_found ? "peak"
                                     : "largest deviator stress, no peak having been "
                                       "reached")};
}

}  // namespace grainfield::triaxial::report
