#include "triaxial/report/curve_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "triaxial/report/number_table.hpp"

namespace grainfield::triaxial::report {
namespace {

constexpr std::string_view header =
    "axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,lateral_stress_z_Pa,"
    "volumetric_strain,unbalanced_force_ratio,time_s,contacts";
constexpr std::array members{&Curve::axial_strain,
                             &Curve::deviator_stress,
                             &Curve::axial_stress,
                             &Curve::lateral_stress_x,
                             &Curve::lateral_stress_z,
                             &Curve::volumetric_strain,
                             &Curve::unbalanced_force_ratio,
                             &Curve::time,
                             &Curve::contacts};

}  // namespace

Curve read_curve(const std::filesystem::path& path) {
    std::vector<std::vector<double>> columns = read_number_table(path, header);
    Curve curve;
    for (std::size_t c = 0; c < members.size(); ++c) curve.*members[c] = std::move(columns[c]);
    return curve;
}

ServoError servo_error(const Curve& curve, double confining_stress) {
    ServoError error;
    double sum = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        for (const double lateral : {curve.lateral_stress_x[i], curve.lateral_stress_z[i]}) {
            const double off = lateral / confining_stress - 1.0;
            sum += off * off;
            if (curve.axial_strain[i] > 0.001)
                error.max = std::max(error.max.value_or(0.0), std::abs(off));
        }
    }
    error.rms = std::sqrt(sum / (2.0 * static_cast<double>(curve.size())));
    return error;
}

}  // namespace grainfield::triaxial::report
