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
    DataBlock servo;
    double low = -0.6, high = 0.6;  // ends of the vertical axis: the band at least [%]
    for (std::size_t i = 0; i < curve.size(); i += stride) {
        const double x = 100 * (curve.lateral_stress_x[i] / target - 1);
        const double z = 100 * (curve.lateral_stress_z[i] / target - 1);
        servo.row(100 * curve.axial_strain[i], x, z);
        low = std::min({low, 1.1 * x, 1.1 * z});
        high = std::max({high, 1.1 * x, 1.1 * z});
    }
    const double last = 100 * std::max(std::ranges::max(curve.axial_strain), 1e-6);
    const ServoError error = servo_error(curve, target);
    return {
        gnuplot.svg("figure_servo", "servo", "Lateral stresses over their target during shear",
                    {1000, 300}, {{"servo", servo}, {"last", last}, {"low", low}, {"high", high}}),
        fmt::format("Lateral stresses during shear against their target of {} kPa; the band is "
                    "± 0.5 %. Over the recorded points: RMS {} %{}.",
                    significant(1e-3 * target), significant(100 * error.rms, 2),
                    error.max ? fmt::format(", largest after 0.1 % of strain {} %",
                                            significant(100 * *error.max, 2))
                              : "; the run ended before 0.1 % of strain")};
}

}  // namespace grainfield::triaxial::report
