// Sphere files as CSV. Strict on purpose: a value that is read wrongly costs a run of hours.

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"
#include "core/files/text_form.hpp"

namespace grainfield::core {
namespace {

/// Columns that only make sense together.
enum class Group { required, stiffness, friction, velocity, spin, block };

struct CsvColumn {
    std::string_view name;
    Group group;
    std::string_view allowed;                     ///< for messages
    Column<double>* (*column)(ParticleStore& s);  ///< null: a component of the block
    std::size_t component = 0;
};

constexpr std::string_view metres = "must be a finite number [m]";
constexpr std::string_view speeds = "must be a finite number [m/s]";
constexpr std::string_view spins = "must be a finite number [rad/s]";
constexpr std::string_view indices = "must be an integer >= 0, or -1 for none";

/// In the order of the interface contract, which is also the order of writing.
constexpr CsvColumn columns[] = {
    {"x", Group::required, metres, [](ParticleStore& s) { return &s.position.x; }},
    {"y", Group::required, metres, [](ParticleStore& s) { return &s.position.y; }},
    {"z", Group::required, metres, [](ParticleStore& s) { return &s.position.z; }},
    {"radius", Group::required, "must be > 0 m", [](ParticleStore& s) { return &s.radius; }},
    {"normal_stiffness", Group::stiffness, "must be > 0 Pa",
     [](ParticleStore& s) { return &s.normal_stiffness; }},
    {"friction_angle", Group::friction, "must be >= 0 and < pi/2 rad",
     [](ParticleStore& s) { return &s.friction_angle; }},
    {"vx", Group::velocity, speeds, [](ParticleStore& s) { return &s.velocity.x; }},
    {"vy", Group::velocity, speeds, [](ParticleStore& s) { return &s.velocity.y; }},
    {"vz", Group::velocity, speeds, [](ParticleStore& s) { return &s.velocity.z; }},
    {"wx", Group::spin, spins, [](ParticleStore& s) { return &s.spin.x; }},
    {"wy", Group::spin, spins, [](ParticleStore& s) { return &s.spin.y; }},
    {"wz", Group::spin, spins, [](ParticleStore& s) { return &s.spin.z; }},
    {"block_i", Group::block, indices, nullptr, 0},
    {"block_j", Group::block, indices, nullptr, 1},
    {"block_k", Group::block, indices, nullptr, 2},
};

std::string names_of(bool (*wanted)(const CsvColumn&)) {
    std::string names;
    for (const CsvColumn& c : columns) {
        if (!wanted(c)) continue;
        if (!names.empty()) names += ',';
        names += c.name;
    }
    return names;
}

std::string required_names() {
    return names_of([](const CsvColumn& c) { return c.group == Group::required; });
}

std::string optional_names() {
    return names_of([](const CsvColumn& c) { return c.group != Group::required; });
}

bool in_range(const CsvColumn& c, double value) {
    if (c.name == "radius" || c.group == Group::stiffness) return value > 0;
    if (c.group == Group::friction) return value >= 0 && value < std::numbers::pi / 2;
    return true;
}

using Header = std::vector<const CsvColumn*>;

bool has(const Header& header, Group group) {
    return std::any_of(header.begin(), header.end(),
                       [&](const CsvColumn* c) { return c->group == group; });
}

/// Every group that the header touches must be there as a whole.
void check_complete(const Header& header, const std::filesystem::path& path, std::int32_t line) {
    for (const CsvColumn& c : columns) {
        if (std::find(header.begin(), header.end(), &c) != header.end()) continue;
        if (c.group == Group::required)
            throw_at_line(
                path, line,
                fmt::format("column {} is missing; required: {}", c.name, required_names()));
        if (has(header, c.group))
            throw_at_line(
                path, line,
                fmt::format("column {} is missing; its sister columns are there", c.name));
    }
}

Header parse_header(std::string_view text, std::string_view line, const std::filesystem::path& path,
                    std::int32_t number) {
    const std::string form = foreign_form(text, line);
    const std::string because = form.empty() ? "" : "; " + form;
    Header header;
    const auto separators = std::count(line.begin(), line.end(), ',');
    for (auto i = 0 * separators; i <= separators; ++i) {
        const std::string_view name = trim(next_field(line, ','));
        const auto* found = std::find_if(std::begin(columns), std::end(columns),
                                         [&](const CsvColumn& c) { return c.name == name; });
        if (found == std::end(columns))
            throw_at_line(path, number,
                          fmt::format("column '{}' is unknown{}; required: {}; optional: {}",
                                      shortened(name.substr(0, name.find('\r'))), because,
                                      required_names(), optional_names()));
        if (std::find(header.begin(), header.end(), found) != header.end())
            throw_at_line(path, number, fmt::format("column {} stands twice", name));
        header.push_back(found);
    }
    check_complete(header, path, number);
    return header;
}

bool store_value(const CsvColumn& c, std::string_view text, ParticleStore& s, std::size_t i) {
    if (c.group == Group::block) {
        std::int64_t index = 0;
        if (!parse_number(text, index) || index < -1 || index > INT32_MAX) return false;
        s.block[i][c.component] = static_cast<std::int32_t>(index);
        return true;
    }
    double& value = (*c.column(s))[i];
    return parse_number(text, value) && in_range(c, value);
}

bool is_written(const SphereFile& file, Group group) {
    switch (group) {
        case Group::required:
            return true;
        case Group::stiffness:
            return file.has_normal_stiffness;
        case Group::friction:
            return file.has_friction_angle;
        case Group::velocity:
        case Group::spin:
            return file.has_velocity;
        case Group::block:
            return file.has_block;
    }
    return false;
}

}  // namespace

bool is_sphere_csv_header(std::string_view header) {
    // Names in foreign forms, too: what is wrong with them is said where they are read.
    std::string line(header.substr(0, header.find('\r')));
    if (line.starts_with("\xff\xfe")) line.erase(0, 2);
    std::erase(line, '\0');
    const auto names = [&](std::string_view name) { return names_column(line, name); };
    // Measured values and trajectories have positions as well.
    const bool positions = names("x") && names("y") && names("z");
    return names("radius") || (positions && !names("value") && !names("time_s"));
}

SphereFile parse_sphere_csv(std::string_view text, const std::filesystem::path& path) {
    LineReader lines(text);
    std::string_view line;
    if (!lines.next_content(line))
        throw_at_line(path, 1,
                      fmt::format("no header; required: {}; optional: {}", required_names(),
                                  optional_names()));
    const Header header = parse_header(text, line, path, lines.number());

    SphereFile file;
    file.has_normal_stiffness = has(header, Group::stiffness);
    file.has_friction_angle = has(header, Group::friction);
    file.has_velocity = has(header, Group::velocity) || has(header, Group::spin);
    file.has_block = has(header, Group::block);
    ParticleStore& s = file.spheres;
    s.resize(count_lines(text));
    file.lines.reserve(s.size());
    std::size_t n = 0;
    for (; lines.next_content(line); ++n) {
        const auto fields = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
        if (fields != header.size())
            throw_at_line(path, lines.number(),
                          fmt::format("{} fields, but the header has {}{}", fields, header.size(),
                                      foreign_row(line, header.size())));
        for (const CsvColumn* c : header) {
            const std::string_view field = trim(next_field(line, ','));
            if (!store_value(*c, field, s, n))
                throw_at_line(path, lines.number(),
                              "column " + bad_value(c->name, field, c->allowed));
        }
        file.lines.push_back(lines.number());
    }
    s.resize(n);
    return file;
}

std::string format_sphere_csv(const SphereFile& file) {
    // The table's accessors serve reading and writing alike, so they want a mutable store.
    auto& s = const_cast<ParticleStore&>(file.spheres);
    Header header;
    std::string text;
    for (const CsvColumn& c : columns) {
        if (!is_written(file, c.group)) continue;
        if (!header.empty()) text += ',';
        text += c.name;
        header.push_back(&c);
    }
    text += '\n';
    text.reserve(s.size() * header.size() * 20);
    for (std::size_t i = 0; i < s.size(); ++i) {
        for (const CsvColumn* c : header) {
            if (c->group == Group::block)
                append_number(text, std::int64_t{s.block[i][c->component]});
            else
                append_number(text, (*c->column(s))[i]);
            text += c == header.back() ? '\n' : ',';
        }
    }
    return text;
}

}  // namespace grainfield::core
