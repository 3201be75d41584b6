#pragma once
// Unit systems of LAMMPS (https://docs.lammps.org/units.html) and their factors to SI.

#include <optional>
#include <string>
#include <string_view>

namespace grainfield::core {

struct SphereFile;

/// Factors to SI.
struct LammpsUnits {
    std::string_view name;
    double length = 1;    ///< to m [-]
    double density = 1;   ///< to kg/m3 [-]
    double mass = 1;      ///< to kg [-]
    double velocity = 1;  ///< to m/s [-]
    double spin = 1;      ///< to rad/s [-]
    bool scaled = true;   ///< false: of molecules, or without a metre at all
};

/// The system of this name; nothing where LAMMPS has none of that name.
std::optional<LammpsUnits> lammps_units(std::string_view name);

/// The name that a data file's first line gives: "..., units = cgs" as write_data has it, or
/// "units si"; empty where it gives none.
std::string_view named_units(std::string_view title);

/// Why spheres of these units cannot be read: "units lj: ...".
std::string unusable_units(std::string_view name);

/// Numbers that no SI file of grains has, of a file that does not name its units: "..." for a
/// message; empty where they are plausible. Looks at the median density and the median radius.
std::string implausible_in_si(const SphereFile& file);
/// The same of the radius alone, for formats in which units cannot be named.
std::string implausible_radius(const SphereFile& file);

}  // namespace grainfield::core
