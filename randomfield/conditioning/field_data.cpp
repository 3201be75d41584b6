#include "randomfield/conditioning/field_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/files/text_file.hpp"
#include "randomfield/marginals/property_limits.hpp"

namespace grainfield::randomfield {
namespace {

constexpr std::string_view full_header = "x,y,z,property,value,error";
constexpr std::string_view short_header = "x,y,z,value,error";

/// One file's lines, each to a measurement.
class Reader {
  public:
    Reader(const std::filesystem::path& path, const GridSpec& grid) : path_(path), grid_(grid) {}

    Measurement read(std::string_view line, std::int32_t number, std::optional<Property> only) {
        line_ = number;
        rest_ = line;
        const auto commas = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
        const std::size_t columns = only ? 5 : 6;
        if (commas + 1 != columns)
            fail(fmt::format("{} columns are expected, here are {}", columns, commas + 1));
        Measurement m;
        m.line = number;
        for (std::size_t d = 0; d < 3; ++d) coordinate(m.position, d);
        m.property = only ? *only : property();
        const PropertyLimits limits = limits_of(m.property);
        m.value = number_of("value");
        if (!limits.contains(m.value))
            fail(fmt::format("value = {}: a {} must be {} ({})", m.value, limits.name, limits.text,
                             limits.unit));
        m.error = number_of("error");
        if (m.error < 0.0)
            fail(fmt::format("error = {}: must be a standard deviation ({}), 0 for an exact value",
                             m.error, limits.unit));
        return m;
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        core::throw_at_line(path_, line_, message);
    }

    double number_of(std::string_view name) {
        const std::string_view field = core::trim(core::next_field(rest_, ','));
        double value = 0.0;
        if (!core::parse_number(field, value))
            fail(fmt::format("{} = \"{}\": a finite number is expected", name,
                             core::shortened(field)));
        return value;
    }

    void coordinate(Vec3& position, std::size_t d) {
        const auto axis = static_cast<Eigen::Index>(d);
        const std::string_view name = std::string_view("xyz").substr(d, 1);
        position[axis] = number_of(name);
        const double edge = grid_.cells[d] * grid_.cell_size[axis];
        // Where a file gives the far face in decimals, its last bit may lie outside.
        if (!(position[axis] >= 0.0 && position[axis] <= edge * (1.0 + 1e-12)))
            fail(fmt::format("{} = {}: outside the sample, which lies in [0, {:.6g}] m", name,
                             position[axis], edge));
    }

    Property property() {
        const std::string_view field = core::trim(core::next_field(rest_, ','));
        for (const Property one : {Property::friction_angle, Property::normal_stiffness})
            if (field == limits_of(one).name) return one;
        fail(fmt::format("property = \"{}\": friction_angle or normal_stiffness is expected",
                         core::shortened(field)));
    }

    const std::filesystem::path& path_;
    const GridSpec& grid_;
    std::string_view rest_;
    std::int32_t line_ = 0;
};

std::string without_spaces(std::string_view text) {
    std::string kept;
    for (const char c : text)
        if (c != ' ' && c != '\t') kept += c;
    return kept;
}

}  // namespace

std::vector<Measurement> read_measurements(const std::filesystem::path& path, const GridSpec& grid,
                                           std::optional<Property> only) {
    const std::string text = core::read_whole_file(path);
    core::LineReader lines(text);
    std::string_view line;
    const bool any = lines.next_content(line);
    const std::string header = any ? without_spaces(line) : "";
    const bool full = header == full_header;
    if (!full && (header != short_header || !only))
        core::throw_at_line(
            path, any ? lines.number() : 1,
            fmt::format("header \"{}\": {} is expected", core::shortened(header),
                        only ? fmt::format("{} or {}", full_header, short_header)
                             : fmt::format("{} (field.variable makes two properties random)",
                                           full_header)));
    std::vector<Measurement> measurements;
    Reader reader(path, grid);
    while (lines.next_content(line))
        measurements.push_back(reader.read(line, lines.number(), full ? std::nullopt : only));
    if (measurements.empty())
        core::throw_at_line(path, lines.number(), "no values follow the header");
    return measurements;
}

}  // namespace grainfield::randomfield
