#pragma once
// Tables of numbers with a known header: curve.csv, energy.csv.

#include <filesystem>
#include <string_view>
#include <vector>

namespace grainfield::triaxial::report {

/// Columns of a table, all of one length. Throws FileError naming the file and line: another
/// header, a cell that is not a finite number, too few or too many cells, fewer than two rows.
std::vector<std::vector<double>> read_number_table(const std::filesystem::path& path,
                                                   std::string_view header);

}  // namespace grainfield::triaxial::report
