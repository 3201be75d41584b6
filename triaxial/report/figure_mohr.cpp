#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "triaxial/report/axis_ticks.hpp"
#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

void add_half_circle(const MohrCircle& circle, DataBlock& rows) {
    for (int i = 0; i <= 180; ++i) {
        const double angle = i * std::numbers::pi / 180;
        rows.row(1e-3 * (circle.centre() - circle.radius() * std::cos(angle)),
                 1e-3 * circle.radius() * std::sin(angle));
    }
    rows.end_part();
}

/// Fixed decimals without a minus before zero: an intercept is small beside what it is told with.
std::string fixed(double value, int decimals) {
    const double unit = std::pow(10, decimals);
    return fmt::format("{:.{}f}", std::round(value * unit) / unit + 0.0, decimals);
}

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

/// As the legend has it, in kPa as the axes.
std::string envelope_text(const Envelope& envelope, bool through_origin) {
    const std::string slope =
        fmt::format("σ tan {}°", significant(degrees(envelope.friction_angle), 3));
    const std::string intercept = fixed(1e-3 * std::abs(envelope.intercept), 2);
    if (through_origin || intercept == fixed(0, 2)) return "τ = " + slope;
    return envelope.intercept < 0 ? fmt::format("τ = {} − {} kPa", slope, intercept)
                                  : fmt::format("τ = {} kPa + {}", intercept, slope);
}

std::string caption_text(const Envelope& envelope, const MohrCircle& run, std::size_t circles) {
    if (circles == 1)
        return fmt::format(
            "Mohr circle at peak strength with the envelope of a cohesionless soil, sin φ = "
            "<i>q</i>/(<i>q</i> + 2σ<sub>3</sub>): φ = {}° ({} rad), σ<sub>3</sub> = {} kPa, "
            "σ<sub>1</sub> = {} kPa. Whether the intercept is zero can only be told from runs at "
            "other confining stresses.",
            significant(degrees(envelope.friction_angle), 3), significant(envelope.friction_angle),
            significant(1e-3 * run.confining_stress),
            significant(1e-3 * (run.confining_stress + run.deviator_stress)));
    return fmt::format(
        "Mohr circles at peak strength of {} runs with the straight line fitted through all, "
        "<i>t</i> = <i>a</i> + <i>s</i> sin φ: φ = {}° ({} rad), intercept <i>c</i> = {} kPa, "
        "which "
        "is {} % of this run’s confining stress{}.",
        circles, significant(degrees(envelope.friction_angle), 3),
        significant(envelope.friction_angle), fixed(1e-3 * envelope.intercept, 2),
        fixed(100 * envelope.intercept / run.confining_stress, 1),
        circles == 2 ? " (two circles: the line is exact)"
                     : fmt::format("; the circles’ radii are off it by {} kPa (RMS)",
                                   fixed(1e-3 * envelope.rms_residual, 2)));
}

}  // namespace

Figure mohr_figure(const Gnuplot& gnuplot, const MohrCircle& run,
                   std::span<const MohrCircle> companions) {
    std::vector<MohrCircle> circles{run};
    circles.insert(circles.end(), companions.begin(), companions.end());
    const Envelope envelope =
        companions.empty() ? envelope_through_origin(run) : fit_envelope(circles);

    DataBlock all, touch;
    double right = 0, highest = 0;
    for (const MohrCircle& circle : circles) {
        add_half_circle(circle, all);
        right = std::max(right, 1.08e-3 * (circle.centre() + circle.radius()));
        highest = std::max(highest, 1e-3 * circle.radius());
    }

    const double slope = std::tan(envelope.friction_angle);
    const double c = 1e-3 * envelope.intercept;
    const double left = std::min(0.0, -c / slope);
    const double sine = std::sin(envelope.friction_angle);
    touch.row(1e-3 * (run.centre() - run.radius() * sine),
              1e-3 * run.radius() * std::cos(envelope.friction_angle));
    const double minor = run.confining_stress, major = minor + run.deviator_stress;

    const double bottom = std::min(0.0, 1.05 * c);
    // Both axes have one scale: the picture is as high as that needs. Flat circles get room above
    // them, for a vertical axis that can be read.
    constexpr double plot_width = 0.84 * 520, least_height = 160;  // [px]
    const double top = std::max({1.15 * highest, 1.02 * (c + slope * right),
                                 bottom + least_height / plot_width * (right - left)});
    const double plot_height = std::min(plot_width * (top - bottom) / (right - left), 600.0);
    std::vector<std::string> names;  // one circle needs none
    for (const MohrCircle& circle : circles)
        names.push_back(companions.empty()
                            ? ""
                            : fmt::format("{}, σ₃ = {} kPa", shortened(circle.name, 40),
                                          significant(1e-3 * circle.confining_stress, 3)));
    const std::size_t rows = companions.empty() ? 1 : circles.size() + 1;
    const double legend = 14 + 22.0 * static_cast<double>(rows);            // [px]
    const int intervals = std::max(2, static_cast<int>(plot_height / 40));  // of the vertical axis
    const double height = plot_height + legend + 58;
    // More circles, and narrow ones, leave no room for the stresses.
    const double diameter = 2e-3 * run.radius() * plot_width / (right - left);  // [px]
    return {gnuplot.svg("figure_mohr", "mohr",
                        "Mohr circles at peak strength with the failure envelope",
                        {520, static_cast<int>(height)},
                        {{"circles", all},
                         {"name", names},
                         {"step", round_step(top - bottom, intervals)},
                         {"labelled", companions.empty() && diameter > 220},
                         {"touch", touch},
                         {"left", left},
                         {"right", right},
                         {"bottom", bottom},
                         {"top", top},
                         {"upper", 1 - legend / height},
                         {"lower", 58 / height},
                         {"intercept", c},
                         {"slope", slope},
                         {"minor", 1e-3 * minor},
                         {"minor_text", significant(1e-3 * minor)},
                         {"major", 1e-3 * major},
                         {"major_text", significant(1e-3 * major)},
                         {"envelope", envelope_text(envelope, companions.empty())}}),
            caption_text(envelope, run, circles.size())};
}

}  // namespace grainfield::triaxial::report
