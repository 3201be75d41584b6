#pragma once
// What is in a CSV table that is no sphere file.

#include <filesystem>
#include <string>
#include <string_view>

namespace grainfield::core {

/// Kind (recognised by the header), rows, and of each column its name and range or number of
/// different values. FileError names file and line if a row does not fit the header.
std::string describe_table(std::string_view text, const std::filesystem::path& path);

}  // namespace grainfield::core
