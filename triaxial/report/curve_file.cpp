#include "triaxial/report/curve_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial::report {
namespace {

constexpr std::string_view header =
    "axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,lateral_stress_z_Pa,"
    "volumetric_strain,unbalanced_force_ratio,time_s,contacts";
constexpr std::array columns{&Curve::axial_strain,
                             &Curve::deviator_stress,
                             &Curve::axial_stress,
                             &Curve::lateral_stress_x,
                             &Curve::lateral_stress_z,
                             &Curve::volumetric_strain,
                             &Curve::unbalanced_force_ratio,
                             &Curve::time,
                             &Curve::contacts};

void parse_row(std::string_view line, const std::string& where, Curve& curve) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
        if (line.empty())
            throw FileError(fmt::format("{}: {} cells, must be {}", where, column, columns.size()));
        const std::string_view cell = core::next_field(line, ',');
        double value = 0;
        if (!core::parse_number(core::trim(cell), value))
            throw FileError(
                fmt::format("{}: '{}' is not a finite number", where, core::shortened(cell)));
        (curve.*columns[column]).push_back(value);
    }
    if (!line.empty())
        throw FileError(fmt::format("{}: more than {} cells", where, columns.size()));
}

}  // namespace

Curve read_curve(const std::filesystem::path& path) {
    const std::string text = core::read_whole_file(path);
    core::LineReader reader(text);
    const auto where = [&] { return fmt::format("{}:{}", path.string(), reader.number()); };
    std::string_view line;
    if (!reader.next(line) || line != header)
        throw FileError(fmt::format("{}:1: the header must be '{}'", path.string(), header));
    Curve curve;
    while (reader.next_content(line)) parse_row(line, where(), curve);
    if (curve.size() < 2)
        throw FileError(
            fmt::format("{}: {} rows, must be two at least", path.string(), curve.size()));
    return curve;
}

ServoError servo_error(const Curve& curve, double confining_stress) {
    ServoError error;
    double sum = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        for (const double lateral : {curve.lateral_stress_x[i], curve.lateral_stress_z[i]}) {
            const double off = lateral / confining_stress - 1.0;
            sum += off * off;
            if (curve.axial_strain[i] > 0.001) error.max = std::max(error.max, std::abs(off));
        }
    }
    error.rms = std::sqrt(sum / (2.0 * static_cast<double>(curve.size())));
    return error;
}

}  // namespace grainfield::triaxial::report
