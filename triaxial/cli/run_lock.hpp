#pragma once
// One run at a time works on a folder or a file, and what killed ones left beside it is cleared.

#include <filesystem>
#include <optional>

#include "triaxial/campaign/file_lock.hpp"

namespace grainfield::triaxial {

class RunLock {
  public:
    /// Takes a folder, made where it is missing, until the end of this object. The lock is a file
    /// in it, checkpoint.lock. InputError: another process works there; FileError.
    static RunLock of_folder(const std::filesystem::path& folder);
    /// The same for one file, whose folder must exist: the lock is beside it, P.h5 ->
    /// P.checkpoint.lock.
    static RunLock of_file(const std::filesystem::path& file);

    /// After an error the folder goes, too, if it was made here and nothing is in it.
    ~RunLock();
    RunLock(const RunLock&) = delete;
    RunLock& operator=(const RunLock&) = delete;

  private:
    RunLock(std::filesystem::path lock_file, const std::filesystem::path& what,
            std::filesystem::path made);

    std::filesystem::path file_;  // of the lock
    std::filesystem::path made_;  // folder that is new; empty: none
    std::optional<FileLock> lock_;
};

}  // namespace grainfield::triaxial
