// YADE's plain text, one line `x y z r` a sphere. Its export.text writes a first line
// "#format x_y_z_r", which ymport.text understands and everybody else takes for a comment.

#include <fmt/format.h>

#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

constexpr std::string_view only_format = "x_y_z_r";

/// Other column sets of export.text mean something else by the fifth column; better to say so.
void check_format_line(std::string_view line, const std::filesystem::path& path,
                       std::int32_t number) {
    if (next_word(line) != "#format") return;
    const std::string_view format = next_word(line);
    if (format != only_format)
        throw_at_line(path, number,
                      fmt::format("#format {}: must be {}", shortened(format), only_format));
}

}  // namespace

SphereFile parse_yade_text(std::string_view text, const std::filesystem::path& path) {
    SphereFile file;
    ParticleStore& s = file.spheres;
    s.resize(count_lines(text));
    LineReader lines(text);
    std::string_view line;
    std::size_t n = 0;
    while (lines.next(line)) {
        check_format_line(line, path, lines.number());
        std::string_view rest = line.substr(0, line.find('#'));
        std::string_view words[5];
        std::size_t count = 0;
        for (std::string_view w = next_word(rest); !w.empty() && count < 5; w = next_word(rest))
            words[count++] = w;
        if (count == 0) continue;
        if (count != 4)
            throw_at_line(path, lines.number(),
                          fmt::format("{} numbers; must be four: x y z r",
                                      count < 4 ? std::to_string(count) : "more than four"));
        double* const values[] = {&s.position.x[n], &s.position.y[n], &s.position.z[n],
                                  &s.radius[n]};
        constexpr std::string_view names[] = {"x", "y", "z", "r"};
        for (std::size_t c = 0; c < 4; ++c) {
            const bool good = parse_number(words[c], *values[c]) && (c < 3 || *values[c] > 0);
            if (!good)
                throw_at_line(path, lines.number(),
                              fmt::format("column {} = {}: {}", names[c], shortened(words[c]),
                                          c < 3 ? "must be a finite number [m]" : "must be > 0 m"));
        }
        file.lines.push_back(lines.number());
        ++n;
    }
    s.resize(n);
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
