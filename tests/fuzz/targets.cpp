#include "tests/fuzz/targets.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/errors.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_formats.hpp"
#include "tests/fuzz/made_h5.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/scene_file.hpp"
#include "triaxial/config/write_config.hpp"

namespace grainfield::fuzz {
namespace {

void promise(bool kept, const char* what) {
    if (kept) return;
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
}

/// True if the input is taken, false if it is refused in a proper way, with a message.
template <class Read>
bool taken(const Read& read) {
    try {
        read();
        return true;
    } catch (const InputError& error) {
        promise(*error.what() != '\0', "a refusal says why");
    } catch (const FileError& error) {
        promise(*error.what() != '\0', "a refusal says why");
    }
    return false;
}

}  // namespace

bool config(std::string_view input) {
    std::string text;
    if (!taken([&] { text = triaxial::write_config(triaxial::parse_config(input, "a.toml")); }))
        return false;
    promise(triaxial::write_config(triaxial::parse_config(text, "b.toml")) == text,
            "a resolved config reads back as it was written");
    return true;
}

bool scene(std::string_view input) {
    return taken([&] { triaxial::parse_scene(input, "a/scene.toml"); });
}

bool sphere_csv(std::string_view input) {
    core::SphereFile file;
    const bool read = taken([&] {
        file = core::parse_sphere_csv(input, "a.csv");
        core::check_spheres(file.spheres, "a.csv", file.lines);
    });
    if (!read) return false;
    const std::string text = core::format_sphere_csv(file);
    promise(core::format_sphere_csv(core::parse_sphere_csv(text, "b.csv")) == text,
            "spheres read back as they were written");
    return true;
}

bool lammps_data(std::string_view input) {
    core::SphereFile file;
    const bool read = taken([&] {
        file = core::parse_lammps_data(input, "a.data");
        core::check_spheres(file.spheres, "a.data", file.lines);
    });
    if (!read) return false;
    // Masses go through densities, so not to the same bits; sizes and places do.
    const core::SphereFile back = core::parse_lammps_data(core::format_lammps_data(file), "b.data");
    promise(back.spheres.position == file.spheres.position &&
                back.spheres.radius == file.spheres.radius,
            "spheres read back as they were written");
    return true;
}

bool lammps_dump(std::string_view input) {
    return taken([&] {
        const core::SphereFile file = core::parse_lammps_dump(input, "a.dump");
        core::check_spheres(file.spheres, "a.dump", file.lines);
    });
}

bool yade_text(std::string_view input) {
    core::SphereFile file;
    const bool read = taken([&] {
        file = core::parse_yade_text(input, "a.txt");
        core::check_spheres(file.spheres, "a.txt", file.lines);
    });
    if (!read) return false;
    const std::string text = core::format_yade_text(file);
    promise(core::format_yade_text(core::parse_yade_text(text, "b.txt")) == text,
            "spheres read back as they were written");
    return true;
}

bool sphere_h5_made(std::string_view recipe) {
    return sphere_h5(made_h5(recipe));
}

bool sphere_h5(std::string_view input) {
    return taken([&] {
        const core::SphereFile file = core::parse_sphere_h5(input, "a.h5");
        core::check_spheres(file.spheres, "a.h5", file.lines);
    });
}

}  // namespace grainfield::fuzz
