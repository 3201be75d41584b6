#pragma once
// Locks between processes, on this machine or others that share the folder. They end with the
// process, however it ends.

#include <filesystem>
#include <optional>
#include <string>

namespace grainfield::triaxial {

class FileLock {
  public:
    enum class Kind { alone, shared };

    /// The lock if nobody holds one that excludes it, else nothing. Makes the file if need be; a
    /// lock held alone writes into it who holds it. Throws FileError.
    static std::optional<FileLock> try_lock(const std::filesystem::path& path, Kind kind);
    /// Waits for the lock. `waiting` is called about once a second meanwhile and may throw.
    template <class Waiting>
    static FileLock wait_for(const std::filesystem::path& path, const Waiting& waiting);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    ~FileLock();

    /// Whether the file of this name is the one that is locked, not one made since.
    bool is_at(const std::filesystem::path& path) const;

  private:
    explicit FileLock(int file) : file_(file) {}
    static void pause();
    int file_;
};

/// "process 123 on host", as the holder of a lock wrote it; empty if unknown.
std::string lock_holder(const std::filesystem::path& path);

template <class Waiting>
FileLock FileLock::wait_for(const std::filesystem::path& path, const Waiting& waiting) {
    while (true) {
        if (auto lock = try_lock(path, Kind::alone)) return std::move(*lock);
        waiting();
        pause();
    }
}

}  // namespace grainfield::triaxial
