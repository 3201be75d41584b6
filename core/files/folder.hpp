#pragma once
// Folders that results go to.

#include <filesystem>

namespace grainfield::core {

/// Makes a folder, and those above it, unless it exists. Throws FileError naming folder and reason.
void create_folder(const std::filesystem::path& folder);

}  // namespace grainfield::core
