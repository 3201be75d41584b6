#pragma once
// A sample of spheres in a file: what is in it, and reading and writing it by suffix.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/particle_store.hpp"

namespace grainfield::core {

/// Further numbers that travel with the spheres (contacts of a checkpoint, ...), row by row.
struct ExtraArray {
    std::vector<std::size_t> shape;  ///< its product is the number of values [-]
    std::vector<double> values;      ///< in the unit its owner gives them

    bool operator==(const ExtraArray&) const = default;
};

/// Spheres with what a file may say about them. A column that no flag announces holds zeros (or
/// no block) after reading a text; masses are zero unless the format carries them (.h5, .data).
struct SphereFile {
    ParticleStore spheres;
    std::optional<Box> box;             ///< the sample's box, where the file knows one [m]
    bool has_normal_stiffness = false;  ///< every sphere brings its own stiffness
    bool has_friction_angle = false;    ///< every sphere brings its own friction angle
    bool has_velocity = false;          ///< velocities or spins, or both, were given
    bool has_block = false;             ///< every sphere knows its block

    // Only .h5 keeps the following.
    std::string kind;        ///< what made it: "packing", "state", ...
    std::string attributes;  ///< a JSON object as text (json_text.hpp); empty: none
    std::map<std::string, ExtraArray> extra;
    std::string producer;  ///< program and version; empty: this one

    /// Line of each sphere in the text it was read from; empty for .h5 [-].
    std::vector<std::int32_t> lines;
    /// What the reader made of the file that its owner should hear: units converted, columns left
    /// out. A sentence each.
    std::vector<std::string> notes;
};

/// Suffixes that read_spheres and write_spheres know, for messages.
inline constexpr const char* sphere_file_suffixes =
    ".h5, .csv, .data (LAMMPS), .txt (YADE), .dump and .lammpstrj (LAMMPS, only read), "
    ".vtkhdf (only read)";

/// InputError unless the file's suffix is one of these.
void require_sphere_suffix(const std::filesystem::path& path);

/// Reads by suffix. InputError: unknown suffix, or a text with wrong content (file, line, column,
/// value, what is allowed). FileError: cannot be read, or an .h5 that is damaged or not ours.
SphereFile read_spheres(const std::filesystem::path& path);
/// The same from the content of such a file.
SphereFile parse_spheres(std::string_view content, const std::filesystem::path& path);
/// True for the suffixes of other programs' files.
bool is_foreign_sphere_suffix(std::string_view suffix);

/// Writes by suffix, atomically. .h5 keeps everything bit for bit; .csv the columns announced by
/// the flags, bit for bit; .data adds densities and a box; .txt keeps positions and radii only.
/// InputError: unknown suffix, or one that is only read. FileError: cannot be written; the old file
/// is then untouched.
void write_spheres(const std::filesystem::path& path, const SphereFile& file);

}  // namespace grainfield::core
