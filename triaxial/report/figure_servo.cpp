#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {

Figure servo_figure(const Gnuplot& gnuplot, const RunFolder& run) {
    const double target = run.results.confining_stress;
    const Curve& curve = run.curve;
    const std::size_t stride = curve.size() / 3000 + 1;
    std::string rows;
    double reach = 0.8;  // of the vertical axis on both sides [%]
    for (std::size_t i = 0; i < curve.size(); i += stride) {
        const double x = 100 * (curve.lateral_stress_x[i] / target - 1);
        const double z = 100 * (curve.lateral_stress_z[i] / target - 1);
        rows += fmt::format("{} {} {}\n", 100 * curve.axial_strain[i], x, z);
        reach = std::max({reach, 1.1 * std::abs(x), 1.1 * std::abs(z)});
    }
    gnuplot.data("servo.dat", rows);
    const std::string script = fmt::format(
        R"(set lmargin at screen 0.075
set rmargin at screen 0.985
set tmargin at screen 0.95
set bmargin at screen 0.19
set xrange [0:{last}]
set yrange [-{reach}:{reach}]
set xlabel 'Axial strain ε_1 (%)' offset 0,0.3
set ylabel 'Deviation from target (%)' offset 0.5,0
set key top right horizontal
set object 1 rectangle from graph 0,first -0.5 to graph 1,first 0.5 fs solid 0.35 noborder fc rgb '#dbe5ec' behind
plot 'servo.dat' using 1:2 with lines lw 1.5 lc rgb '{main}' title 'walls across x', \
     'servo.dat' using 1:3 with lines lw 1.5 lc rgb '{contrast}' title 'walls across z', \
     0 with lines lw 0.8 lc rgb '{muted}' notitle
)",
        fmt::arg("last", 100 * std::max(std::ranges::max(curve.axial_strain), 1e-6)),
        fmt::arg("reach", reach), fmt::arg("main", colour::main),
        fmt::arg("contrast", colour::contrast), fmt::arg("muted", colour::muted));
    const ServoError error = servo_error(curve, target);
    return {
        gnuplot.svg("servo", "Lateral stresses over their target during shear", {1000, 300},
                    script),
        fmt::format("Lateral stresses during shear against their target of {} kPa; the band is "
                    "± 0.5 %. Over the recorded points: RMS {} %, largest after 0.1 % of strain "
                    "{} %.",
                    significant(1e-3 * target), significant(100 * error.rms, 2),
                    significant(100 * error.max, 2))};
}

}  // namespace grainfield::triaxial::report
