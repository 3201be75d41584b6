#include "core/files/lammps_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/files/sphere_file.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

// length, density, mass, velocity, spin
constexpr std::array<LammpsUnits, 8> systems{{
    {"si"},
    {"cgs", 1e-2, 1e3, 1e-3, 1e-2, 1},    // cm, g/cm3, g, cm/s
    {"micro", 1e-6, 1e3, 1e-15, 1, 1e6},  // um, pg/um3, pg, um/us
    {"nano", 1e-9, 1e6, 1e-21, 1, 1e9},   // nm, ag/nm3, ag, nm/ns
    {.name = "lj", .scaled = false},
    {.name = "real", .scaled = false},
    {.name = "metal", .scaled = false},
    {.name = "electron", .scaled = false},
}};

// Grains: from foam to metal, and those whose density was scaled for a larger step; dust to
// boulder.
constexpr double least_density = 10, largest_density = 1e7;  // [kg/m3]
constexpr double least_radius = 1e-7, largest_radius = 10;   // [m]

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::optional<LammpsUnits> lammps_units(std::string_view name) {
    for (const LammpsUnits& system : systems)
        if (system.name == name) return system;
    return std::nullopt;
}

std::string_view named_units(std::string_view title) {
    for (std::size_t at = title.find("units"); at != std::string_view::npos;
         at = title.find("units", at + 1)) {
        std::string_view rest = trim(title.substr(at + 5));
        const bool equals = rest.starts_with('=');
        if (equals) rest = trim(rest.substr(1));
        const std::string_view name = rest.substr(0, rest.find_first_of(" \t,;.)\r"));
        // "units = x" names a system even if it is none; "units x" may be prose.
        if (!name.empty() && (equals || lammps_units(name))) return name;
    }
    return {};
}

std::string unusable_units(std::string_view name) {
    const auto units = lammps_units(name);
    return fmt::format("units {}: {}; must be si, cgs, micro or nano", shortened(name),
                       !units         ? "unknown"
                       : name == "lj" ? "without dimensions, they have no metre"
                                      : "those of molecules, not of grains");
}

std::string implausible_in_si(const SphereFile& file) {
    const ParticleStore& s = file.spheres;
    if (s.size() == 0) return {};
    std::vector<double> densities;
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.mass[i] > 0) densities.push_back(s.mass[i] / sphere_volume(s.radius[i]));
    const double density = densities.empty() ? 1e3 : median(std::move(densities));
    const char* allowed = "if other units are meant, name them";
    if (!(density >= least_density && density <= largest_density))
        return fmt::format(
            "the median density is {:.3g} kg/m3 in SI, {:g} to {:g} are plausible: {}", density,
            least_density, largest_density, allowed);
    const std::string why = implausible_radius(file);
    return why.empty() ? why : fmt::format("{}: {}", why, allowed);
}

std::string implausible_radius(const SphereFile& file) {
    const auto& radius = file.spheres.radius;
    if (radius.empty()) return {};
    const double middle = median({radius.begin(), radius.end()});
    if (middle >= least_radius && middle <= largest_radius) return {};
    return fmt::format("the median radius is {:.3g} m in SI, {:g} to {:g} are plausible", middle,
                       least_radius, largest_radius);
}

}  // namespace grainfield::core
