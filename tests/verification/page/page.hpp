#pragma once
// tests/VERIFICATION.md from the records of the tests, and back to the names of its rows.

#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace grainfield::verify {

/// Scene (or heading) and quantity.
using RowName = std::pair<std::string, std::string>;

/// The page of all records (*.json, see tests/verification/record.hpp) in `records`. Of the kernels
/// of a precision the row shows the one that comes nearest to its tolerance. `scenes` is the folder
/// of the committed scenes. Throws std::runtime_error where there are no records or one cannot be
/// read.
std::string page_of(const std::filesystem::path& records, const std::filesystem::path& scenes);

/// The rows that a page has.
std::set<RowName> rows_of_page(const std::string& page);

}  // namespace grainfield::verify
