#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

constexpr std::size_t most_points = 3000;  // more cannot be told apart in the figure

DataBlock curve_data(const Curve& curve) {
    const std::size_t stride = curve.size() / most_points + 1;
    DataBlock rows;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (i % stride != 0 && i + 1 != curve.size()) continue;
        rows.row(100 * curve.axial_strain[i], 1e-3 * curve.deviator_stress[i],
                 100 * curve.volumetric_strain[i]);
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
    const KeyResults& r = run.results;
    const double peak = 1e-3 * r.peak_deviator_stress;
    const double peak_strain = 100 * r.axial_strain_at_peak;
    const double half_strain = 100 * 0.5 * r.peak_deviator_stress / r.E50;
    const double last = 100 * std::max(std::ranges::max(run.curve.axial_strain), 1e-6);
    DataBlock marks;
    marks.row(0, 0);
    marks.row(2 * half_strain, peak);
    marks.end_part();
    marks.row(half_strain, 0.5 * peak);
    marks.end_part();
    marks.row(peak_strain, peak);
    const std::string picture = gnuplot.svg(
        "figure_stress_strain", "stress_strain",
        "Deviator stress and volumetric strain over axial strain", {520, 500},
        {{"curve", curve_data(run.curve)},
         {"marks", marks},
         {"last", last},
         {"floor_stress", std::min(0.0, 1.1e-3 * std::ranges::min(run.curve.deviator_stress))},
         {"peak", peak},
         {"peak_name", r.failure == Failure::peak      ? "peak"
                       : r.failure == Failure::plateau ? "plateau"
                                                       : "largest"},
         {"peak_text", significant(peak)},
         {"peak_strain", peak_strain},
         {"peak_strain_text", significant(peak_strain, 3)},
         {"half_strain", half_strain},
         {"modulus_text", significant(1e-6 * r.E50)},
         {"volumetric_step", round_step(curve_span(run.curve.volumetric_strain))}});
    return {picture,
            fmt::format("Deviator stress and volumetric strain (contraction positive) over axial "
                        "strain. <i>E</i><sub>50</sub> is the secant to half the {}.",
                        r.failure == Failure::peak      ? "peak"
                        : r.failure == Failure::plateau ? "plateau"
                                                        : "largest deviator stress, no peak "
                                                          "having been reached")};
}

}  // namespace grainfield::triaxial::report
