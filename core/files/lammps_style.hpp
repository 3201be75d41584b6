#pragma once
// Where the columns of a sphere stand in the section Atoms of a LAMMPS data file: that depends on
// the atom style (https://docs.lammps.org/read_data.html).

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace grainfield::core {

struct LammpsStyle {
    std::string layout;            ///< names of the columns, for messages
    std::size_t columns = 7;       ///< without image flags [-]
    std::size_t diameter = 2;      ///< column from 0 [-]
    std::size_t density = 3;       ///< [-]
    std::size_t first_of_xyz = 4;  ///< x, y and z follow one another [-]
    bool hybrid = false;
};

/// The columns of a style, "sphere", "hybrid sphere charge", ...; nothing where the style is
/// unknown or has no diameter.
std::optional<LammpsStyle> lammps_style(std::string_view style);

/// The style that a title line names as ours do, "..., atom_style sphere, ..."; empty: none.
std::string_view named_style(std::string_view title);

/// Styles that can be read, for messages.
inline constexpr const char* lammps_sphere_styles =
    "sphere, granular, bpm/sphere or a hybrid with sphere";

}  // namespace grainfield::core
