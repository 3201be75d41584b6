#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

std::string half_circle(const MohrCircle& circle) {
    std::string rows;
    for (int i = 0; i <= 180; ++i) {
        const double angle = i * std::numbers::pi / 180;
        rows += fmt::format("{} {}\n", 1e-3 * (circle.centre() - circle.radius() * std::cos(angle)),
                            1e-3 * circle.radius() * std::sin(angle));
    }
    return rows;
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

    std::string rows, plots;
    double right = 0, highest = 0;
    for (std::size_t i = 0; i < circles.size(); ++i) {
        rows += half_circle(circles[i]) + "\n\n";
        right = std::max(right, 1.08e-3 * (circles[i].centre() + circles[i].radius()));
        highest = std::max(highest, 1e-3 * circles[i].radius());
        for (const char* style :
             {"filledcurves y1=0 fs transparent solid 0.10 noborder", "lines lw 2"})
            plots += fmt::format("'mohr.dat' index {} with {} lc rgb '{}' notitle, \\\n     ", i,
                                 style, i == 0 ? colour::main : colour::soft);
    }
    gnuplot.data("mohr.dat", rows);

    const double slope = std::tan(envelope.friction_angle);
    const double c = 1e-3 * envelope.intercept;
    const double left = std::min(0.0, -c / slope);
    std::string labels;
    if (companions.empty()) {  // more circles leave no room for them
        for (const auto& [name, stress] :
             {std::pair{"σ_3", run.confining_stress},
              std::pair{"σ_1", run.confining_stress + run.deviator_stress}})
            labels += fmt::format("set label '{} = {}' at {},0 right offset -0.5,0.7 tc rgb '{}'\n",
                                  name, significant(1e-3 * stress), 1e-3 * stress, colour::ink);
    }
    const double sine = std::sin(envelope.friction_angle);
    const double touch_s = 1e-3 * (run.centre() - run.radius() * sine);
    const double touch_t = 1e-3 * run.radius() * std::cos(envelope.friction_angle);

    const double bottom = std::min(0.0, 1.05 * c);
    const double top = std::max(1.15 * highest, 1.02 * (c + slope * right));

    // Both axes have one scale: the picture is as high as that needs.
    const double plot_height = std::min(0.84 * 520 * (top - bottom) / (right - left), 600.0);
    const double height = plot_height + 12 + 58;
    const std::string script = fmt::format(
        R"(set lmargin at screen 0.135
set rmargin at screen 0.975
set tmargin at screen {upper}
set bmargin at screen {lower}
set size ratio -1
set xrange [{left}:{right}]
set yrange [{bottom}:{top}]
set xlabel 'Normal stress σ (kPa)' offset 0,0.3
set ylabel 'Shear stress τ (kPa)' offset 0.5,0
set key top left reverse Left
{labels}
$touch << EOD
{touch_s} {touch_t}
EOD
plot {plots}[{left}:{right}] {c} + {slope}*x with lines lw 1.6 lc rgb '{contrast}' title 'τ = {c_text} + σ tan {phi}°', \
     $touch with points pt 7 ps 0.6 lc rgb '{contrast}' notitle
)",
        fmt::arg("left", left), fmt::arg("right", right), fmt::arg("bottom", bottom),
        fmt::arg("top", top), fmt::arg("upper", 1 - 12 / height), fmt::arg("lower", 58 / height),
        fmt::arg("labels", labels), fmt::arg("touch_s", touch_s), fmt::arg("touch_t", touch_t),
        fmt::arg("plots", plots), fmt::arg("c", c), fmt::arg("slope", slope),
        fmt::arg("contrast", colour::contrast),
        fmt::arg("c_text", companions.empty() ? "0" : fixed(c, 2)),
        fmt::arg("phi", significant(degrees(envelope.friction_angle), 3)));
    return {gnuplot.svg("mohr", "Mohr circles at peak strength with the failure envelope",
                        {520, static_cast<int>(height)}, script),
            caption_text(envelope, run, circles.size())};
}

}  // namespace grainfield::triaxial::report
