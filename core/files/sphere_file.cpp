#include "core/files/sphere_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/lammps_units.hpp"
#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

struct Format {
    const char* suffix;
    SphereFile (*parse)(std::string_view, const std::filesystem::path&);
    std::string (*format)(const SphereFile&);
};

constexpr Format formats[] = {
    {".h5", parse_sphere_h5, format_sphere_h5},
    {".csv", parse_sphere_csv, format_sphere_csv},
    {".data", parse_lammps_data, format_lammps_data},
    {".txt", parse_yade_text, format_yade_text},
    {".dump", parse_lammps_dump, nullptr},
    {".lammpstrj", parse_lammps_dump, nullptr},
    {".vtkhdf", parse_sphere_h5, nullptr},  // the suffix that VTK gives it
};

const Format& format_of(const std::filesystem::path& path) {
    const std::string suffix = path.extension().string();
    const auto* found = std::find_if(std::begin(formats), std::end(formats),
                                     [&](const Format& f) { return suffix == f.suffix; });
    if (found == std::end(formats))
        throw InputError(fmt::format("{}: suffix '{}' is not a format of sphere files; allowed: {}",
                                     path.string(), suffix, sphere_file_suffixes));
    return *found;
}

/// A store whose columns differ in length is a mistake in the program, not in the user's input.
void require_whole(const ParticleStore& s) {
    bool whole = s.block.size() == s.size();
    for (const Vec3Column* column : {&s.position, &s.velocity, &s.spin})
        whole = whole && column->x.size() == s.size() && column->y.size() == s.size() &&
                column->z.size() == s.size();
    for (const Column<double>* column : {&s.mass, &s.normal_stiffness, &s.friction_angle})
        whole = whole && column->size() == s.size();
    if (!whole) throw std::invalid_argument("write_spheres: columns of different length");
}

}  // namespace

void require_sphere_suffix(const std::filesystem::path& path) {
    (void)format_of(path);
}

SphereFile read_spheres(const std::filesystem::path& path) {
    (void)format_of(path);  // before a large file is read
    return parse_spheres(read_whole_file(path), path);
}

SphereFile parse_spheres(std::string_view content, const std::filesystem::path& path) {
    const Format& format = format_of(path);
    // Dump files come with any name: their first word says what they are.
    const bool dump = is_foreign_sphere_suffix(format.suffix) && content.starts_with("ITEM:");
    if (dump) return parse_lammps_dump(content, path);
    SphereFile file = format.parse(content, path);
    if (format.parse == parse_sphere_csv || format.parse == parse_yade_text)
        if (const std::string why = implausible_radius(file); !why.empty())
            file.notes.push_back(fmt::format("{}; lengths are read in metres", why));
    return file;
}

bool is_foreign_sphere_suffix(std::string_view suffix) {
    return suffix == ".data" || suffix == ".txt" || suffix == ".dump" || suffix == ".lammpstrj";
}

void write_spheres(const std::filesystem::path& path, const SphereFile& file) {
    const Format& format = format_of(path);
    if (format.format == nullptr)
        throw InputError(
            fmt::format("{}: {} is only read; to be written are .h5, .csv, .data, .txt",
                        path.string(), format.suffix));
    require_whole(file.spheres);
    write_file_atomically(path, format.format(file));
}

}  // namespace grainfield::core
