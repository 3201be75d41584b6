// YADE's plain text, one line `x y z r` a sphere. Its export.text writes a first line
// "#format x_y_z_r", which ymport.text understands and everybody else takes for a comment;
// export.textExt has "#format x_y_z_r_matId" as well, with the number of the material behind.

#include <fmt/format.h>

#include <set>

#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"
#include "core/files/text_form.hpp"

namespace grainfield::core {
namespace {

constexpr std::string_view only_format = "x_y_z_r";
constexpr std::string_view with_material = "x_y_z_r_matId";

/// Columns that the format line announces, `before` where the line is none. Other column sets of
/// export.textExt mean something else by the fifth column; better to say so.
std::size_t announced_columns(std::string_view line, const std::filesystem::path& path,
                              std::int32_t number, std::size_t before) {
    line = trim(line);
    if (!line.starts_with('#')) return before;
    line.remove_prefix(1);
    if (next_word(line) != "format") return before;
    const std::string_view format = next_word(line);
    if (format == only_format) return 4;
    if (format == with_material) return 5;
    throw_at_line(
        path, number,
        fmt::format("#format {}: must be {} or {}", shortened(format), only_format, with_material));
}

/// What separates the columns instead of white space.
std::string foreign_separator(std::string_view line) {
    for (const auto& [separator, name] : {std::pair{',', "commas"}, std::pair{';', "semicolons"}})
        if (line.find(separator) != std::string_view::npos)
            return fmt::format(
                "; {} stand in it: columns must be separated by blanks or tabs, "
                "decimals by points",
                name);
    return line.find('\r') != std::string_view::npos
               ? "; its lines end with CR alone (old Mac): must end with LF or CRLF"
               : "";
}

}  // namespace

SphereFile parse_yade_text(std::string_view text, const std::filesystem::path& path) {
    SphereFile file;
    ParticleStore& s = file.spheres;
    s.resize(count_lines(text));
    LineReader lines(text);
    std::string_view line;
    std::size_t n = 0, columns = 4;
    std::set<std::int64_t> materials;
    while (lines.next(line)) {
        columns = announced_columns(line, path, lines.number(), columns);
        std::string_view rest = line.substr(0, line.find('#'));
        std::string_view words[6];
        std::size_t count = 0;
        for (std::string_view w = next_word(rest); !w.empty() && count < 6; w = next_word(rest))
            words[count++] = w;
        if (count == 0) continue;
        if (count != columns)
            throw_at_line(path, lines.number(),
                          columns == 5
                              ? fmt::format("{} numbers; must be five: x y z r matId{}", count,
                                            foreign_separator(line))
                              : fmt::format("{} numbers; must be four: x y z r{}{}",
                                            count < 4 ? std::to_string(count) : "more than four",
                                            count == 5 ? ", or five under a line '#format "
                                                         "x_y_z_r_matId'"
                                                       : "",
                                            foreign_separator(line)));
        std::int64_t material = 0;
        if (columns == 5 && (!parse_number(words[4], material) || material < 0))
            throw_at_line(
                path, lines.number(),
                fmt::format("column matId = {}: must be an integer >= 0", shortened(words[4])));
        if (columns == 5) materials.insert(material);
        double* const values[] = {&s.position.x[n], &s.position.y[n], &s.position.z[n],
                                  &s.radius[n]};
        constexpr std::string_view names[] = {"x", "y", "z", "r"};
        for (std::size_t c = 0; c < 4; ++c) {
            const bool good = parse_number(words[c], *values[c]) && (c < 3 || *values[c] > 0);
            if (!good)
                throw_at_line(
                    path, lines.number(),
                    "column " + bad_value(names[c], words[c],
                                          c < 3 ? "must be a finite number [m]" : "must be > 0 m"));
        }
        file.lines.push_back(lines.number());
        ++n;
    }
    s.resize(n);
    if (materials.size() > 1)
        file.notes.push_back(
            fmt::format("{} materials (matId) in the file, whose properties it does not say: all "
                        "spheres are taken alike",
                        materials.size()));
    return file;
}

std::string format_yade_text(const SphereFile& file) {
    const ParticleStore& s = file.spheres;
    std::string text = fmt::format("#format {}\n", only_format);
    for (std::size_t i = 0; i < s.size(); ++i) {
        for (double value : {s.position.x[i], s.position.y[i], s.position.z[i]}) {
            append_number(text, value);
            text += ' ';
        }
        append_number(text, s.radius[i]);
        text += '\n';
    }
    return text;
}

}  // namespace grainfield::core
