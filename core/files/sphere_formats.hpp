#pragma once
// The formats of a sphere file, one source file each. Readers get the content and the path for
// their messages; writers give the content back. sphere_file.cpp does the rest.

#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/sphere_file.hpp"

namespace grainfield::core {

/// `.csv` of the interface contract: a header of column names, one line a sphere, SI units.
SphereFile parse_sphere_csv(std::string_view text, const std::filesystem::path& path);
std::string format_sphere_csv(const SphereFile& file);

/// True if this header line is one of a sphere `.csv` (its columns may still be wrong).
bool is_sphere_csv_header(std::string_view header);

/// LAMMPS data file, atom_style sphere, granular, bpm/sphere or hybrid with sphere
/// (lammps_style.hpp): https://docs.lammps.org/read_data.html. Spheres come in the order of their
/// atom ids. Units other than SI are converted where the first line names them
/// (lammps_units.hpp), and refused where they have no metre.
SphereFile parse_lammps_data(std::string_view text, const std::filesystem::path& path);
std::string format_lammps_data(const SphereFile& file);

/// LAMMPS dump file (`dump custom`) with x, y, z (or xu, xs, ...) and radius or diameter; of
/// several snapshots the last: https://docs.lammps.org/dump.html.
SphereFile parse_lammps_dump(std::string_view text, const std::filesystem::path& path);

/// YADE's `x y z r` or `x y z r matId`, as ymport.text and export.text have it.
SphereFile parse_yade_text(std::string_view text, const std::filesystem::path& path);
std::string format_yade_text(const SphereFile& file);

/// VTKHDF (UnstructuredGrid, one vertex a sphere) plus our group /grainfield. Of other programs'
/// VTKHDF: Points and PointData/radius (or diameter).
SphereFile parse_sphere_h5(std::string_view image, const std::filesystem::path& path);
std::string format_sphere_h5(const SphereFile& file);

}  // namespace grainfield::core
