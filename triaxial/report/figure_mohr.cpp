#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

std::string caption_text(const Envelope& envelope, const MohrCircle& run, std::size_t circles) {
    if (circles == 1)
        return fmt::format(
            "Mohr circle at peak strength with the envelope of a cohesionless soil, sin φ = "
            "<i>q</i>/(<i>q</i> + 2σ<sub>3</sub>): φ = {}° ({} rad). Whether the intercept is zero "
            "can only be told from runs at other confining stresses.",
            significant(degrees(envelope.friction_angle), 3), significant(envelope.friction_angle));
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
    const double top = std::max(1.15 * highest, 1.02 * (c + slope * right));

    // Both axes have one scale: the picture is as high as that needs.
    const double plot_height = std::min(0.84 * 520 * (top - bottom) / (right - left), 600.0);
    const double height = plot_height + 12 + 58;
    return {gnuplot.svg("figure_mohr", "mohr",
                        "Mohr circles at peak strength with the failure envelope",
                        {520, static_cast<int>(height)},
                        {{"circles", all},
                         {"circles", circles.size()},
                         {"touch", touch},
                         {"left", left},
                         {"right", right},
                         {"bottom", bottom},
                         {"top", top},
                         {"upper", 1 - 12 / height},
                         {"lower", 58 / height},
                         {"intercept", c},
                         {"slope", slope},
                         {"minor", 1e-3 * minor},
                         {"minor_text", significant(1e-3 * minor)},
                         {"major", 1e-3 * major},
                         {"major_text", significant(1e-3 * major)},
                         {"intercept_text", companions.empty() ? "0" : fixed(c, 2)},
                         {"angle_text", significant(degrees(envelope.friction_angle), 3)}}),
            caption_text(envelope, run, circles.size())};
}

}  // namespace grainfield::triaxial::report
