#pragma once
// One packing in the forms that users bring, and the program run on it.

#include <string>
#include <vector>

#include "core/files/sphere_file.hpp"
#include "tests/program/program.hpp"

namespace grainfield::case_tests {

/// 628 spheres in a box of 0.25 x 0.5 x 0.25 m (packing.txt), settled at a porosity of 0.40. Peak
/// deviator stress at 100 kPa: about 135 kPa at 2 % of axial strain.
const core::SphereFile& packing();

/// How a LAMMPS data file has it.
struct LammpsForm {
    std::string title = "units = si";
    std::string style = "sphere";          ///< behind "Atoms #"; sphere or hybrid sphere
    double lid = 0.5;                      ///< y of the upper side of its box [m]
    double density = 2600;                 ///< [kg/m3]
    double length_unit = 1;                ///< of the file [m]
    double density_unit = 1;               ///< of the file [kg/m3]
    std::vector<std::string> more_rows{};  ///< of spheres beyond those of the packing
};
std::string lammps_text(const LammpsForm& form);

/// How a spreadsheet writes `x,y,z,radius` and block_i,j,k: of the lower and the upper half.
struct CsvForm {
    std::string separator = ",";
    std::string line_end = "\n";
    std::string decimal = ".";
    std::string quote{};  ///< around names and numbers
};
std::string csv_text(const CsvForm& form = {});

/// Shears the packing of this file, on one thread, into "run", with `settings` of --set; to 0.2 %
/// of axial strain unless told otherwise. Notes are on stderr; figures of its page are blank, as
/// they take longer than such a test.
program_tests::Outcome shear(const program_tests::Workplace& place, const std::string& packing,
                             const std::vector<std::string>& settings = {},
                             const std::string& strain = "0.002");

/// Part of a message or a page [-].
bool has(const std::string& text, const std::string& part);

}  // namespace grainfield::case_tests
