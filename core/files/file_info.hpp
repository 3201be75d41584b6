#pragma once
// What is in a file, in a few lines for people.

#include <filesystem>
#include <string>

namespace grainfield::core {

/// Describes sphere files (.h5, .csv, .data, .txt), tables (.csv: field, curve, results, ...),
/// other .h5 files, .json and .toml; lines end with a line feed. FileError: cannot be read or
/// damaged. InputError: another suffix, or a text with wrong content.
std::string describe_file(const std::filesystem::path& path);

}  // namespace grainfield::core
