// `convert`: spheres from one file format to another, and what is lost on the way.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_file.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
    std::string in, out;
};

/// Formats as bits, to say who holds what.
enum Format : unsigned { h5 = 1, csv = 2, data = 4, txt = 8 };

unsigned format_of(const fs::path& path) {
    const std::string suffix = path.extension().string();
    if (suffix == ".csv") return csv;
    if (suffix == ".data") return data;
    return suffix == ".txt" ? txt : h5;
}

bool has_mass(const core::ParticleStore& spheres) {
    return std::ranges::any_of(spheres.mass, [](double mass) { return mass > 0; });
}

/// What the file says and the target's format has no place for.
std::string lost(const core::SphereFile& file, const fs::path& out) {
    struct Content {
        const char* name;
        bool there;
        unsigned held_by;
    };
    const Content contents[] = {
        {"the box", file.box.has_value(), h5 | data},
        {"masses", has_mass(file.spheres), h5 | data},
        {"normal stiffnesses", file.has_normal_stiffness, h5 | csv},
        {"friction angles", file.has_friction_angle, h5 | csv},
        {"velocities and spins", file.has_velocity, h5 | csv | data},
        {"blocks", file.has_block, h5 | csv},
        {"attributes", !file.attributes.empty(), h5},
        {"further arrays", !file.extra.empty(), h5},
    };
    std::string names;
    for (const Content& c : contents)
        if (c.there && (c.held_by & format_of(out)) == 0)
            names += (names.empty() ? "" : ", ") + std::string(c.name);
    return names;
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) ||
           fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

void run_convert(const ConvertArguments& arguments, Session& session) {
    note_unused_settings(session);
    if (same_file(arguments.in, arguments.out))
        throw InputError(
            fmt::format("{}: IN and OUT are the same file; they must differ", arguments.out));
    core::require_sphere_suffix(arguments.out);
    const core::SphereFile file = core::read_spheres(arguments.in);
    core::check_spheres(file.spheres, arguments.in, file.lines);
    core::write_spheres(arguments.out, file);
    print_row("read", arguments.in);
    for (const std::string& note : file.notes) print_row("note", note);
    print_row("written", fmt::format("{}, {} spheres", arguments.out, file.spheres.size()));
    const std::string names = lost(file, arguments.out);
    if (!names.empty())
        print_row("not written", fmt::format("{}: {} has no place for {}", names,
                                             fs::path(arguments.out).extension().string(),
                                             names.find(',') == std::string::npos ? "it" : "them"));
    if (format_of(arguments.out) == data && !has_mass(file.spheres))
        print_row("assumed", "a density of 2600 kg/m3, as the spheres bring no masses");
}

}  // namespace

void add_convert_command(CommandLine& line) {
    auto arguments = std::make_shared<ConvertArguments>();
    ArgumentParser command =
        line.add("convert",
                 fmt::format("Converts a file of spheres; the suffixes say the formats: {}.",
                             core::sphere_file_suffixes),
                 "grainfield convert packing.h5 packing.data",
                 [arguments](Session& session) { run_convert(*arguments, session); });
    command.add("in", arguments->in, "File to read").required();
    command.add("out", arguments->out, "File to write, another than IN").required();
}

}  // namespace grainfield::triaxial
