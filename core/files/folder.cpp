#include "core/files/folder.hpp"

#include <fmt/format.h>

#include <system_error>

#include "core/base/errors.hpp"

namespace grainfield::core {

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        throw FileError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                    error ? error.message() : "a file of that name is in the way"));
}

}  // namespace grainfield::core
