#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "triaxial/report/axis_ticks.hpp"
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

/// One of the two vertical axes.
struct VerticalAxis {
    double step;         ///< of its ticks
    std::size_t widest;  ///< label of a tick [-]

    VerticalAxis(double low, double high, int intervals)
        : step(round_step(high - low, intervals)),
          // gnuplot may go on to the next tick at both ends.
          widest(widest_label(low - step, high + step, step)) {}
};

}  // namespace

Figure stress_strain_figure(const Gnuplot& gnuplot, const RunFolder& run) {
    const KeyResults& r = run.results;
    const double peak = 1e-3 * r.peak_deviator_stress;
    const double peak_strain = 100 * r.axial_strain_at_peak;
    const double half_strain = 100 * 0.5 * r.peak_deviator_stress / r.E50;
    const double last = 100 * std::max(std::ranges::max(run.curve.axial_strain), 1e-6);
    const double floor_stress = std::min(0.0, 1.1e-3 * std::ranges::min(run.curve.deviator_stress));
    const VerticalAxis stress(floor_stress, 1.16 * peak, 6);
    const auto [least, most] = std::ranges::minmax(run.curve.volumetric_strain);
    const VerticalAxis volumetric(100 * least, 100 * std::max(most, least + 1e-6), 4);
    DataBlock marks;
    marks.row(0, 0);
    marks.row(2 * half_strain, peak);
    marks.end_part();
    marks.row(half_strain, 0.5 * peak);
    marks.end_part();
    marks.row(peak_strain, peak);
    const std::string picture =
        gnuplot.svg("figure_stress_strain", "stress_strain",
                    "Deviator stress and volumetric strain over axial strain", {520, 520},
                    {{"curve", curve_data(run.curve)},
                     {"marks", marks},
                     {"last", last},
                     {"floor_stress", floor_stress},
                     {"stress_step", stress.step},
                     {"peak", peak},
                     {"peak_name", r.failure == Failure::peak      ? "peak"
                                   : r.failure == Failure::plateau ? "plateau"
                                                                   : "largest"},
                     {"peak_text", significant(peak)},
                     {"peak_strain", peak_strain},
                     {"peak_strain_text", significant(peak_strain, 3)},
                     {"modulus_text", significant(1e-6 * r.E50)},
                     {"volumetric_step", volumetric.step},
                     {"widest", std::max(stress.widest, volumetric.widest)}});
    return {picture,
            fmt::format("Deviator stress and volumetric strain (contraction positive) over axial "
                        "strain. <i>E</i><sub>50</sub> is the secant to half the {}.",
                        r.failure == Failure::peak      ? "peak"
                        : r.failure == Failure::plateau ? "plateau"
                                                        : "largest deviator stress, no peak "
                                                          "having been reached")};
}

}  // namespace grainfield::triaxial::report
