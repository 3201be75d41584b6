#include "triaxial/cli/run_lock.hpp"

#include <fmt/format.h>

#include <exception>
#include <system_error>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/folder.hpp"

namespace grainfield::triaxial {

namespace fs = std::filesystem;

RunLock RunLock::of_folder(const fs::path& folder) {
    const bool exists = fs::exists(folder);
    core::create_folder(folder);
    return {folder / "checkpoint.lock", folder, exists ? fs::path() : folder};
}

RunLock RunLock::of_file(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
        throw FileError(
            fmt::format("{}: cannot be written: its folder does not exist", file.string()));
    return {fs::path(file).replace_extension(".checkpoint.lock"), file, fs::path()};
}

RunLock::RunLock(fs::path lock_file, const fs::path& what, fs::path made)
    : file_(std::move(lock_file)), made_(std::move(made)) {
    do {
        lock_ = FileLock::try_lock(file_, FileLock::Kind::alone);
        if (!lock_) {
            const std::string holder = lock_holder(file_);
            throw InputError(fmt::format("{}: {} works here already; it has to end first",
                                         what.string(),
                                         holder.empty() ? "another process" : holder));
        }
        // Whoever held it before has removed its file: the one that others find is another.
    } while (!lock_->is_at(file_));
    core::remove_abandoned_files(file_.has_parent_path() ? file_.parent_path() : ".");
}

RunLock::~RunLock() {
    std::error_code ignored;
    fs::remove(file_, ignored);
    // After an error there may be nothing in the folder; else this fails.
    if (!made_.empty() && std::uncaught_exceptions() > 0) fs::remove(made_, ignored);
}

}  // namespace grainfield::triaxial
