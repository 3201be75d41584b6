#pragma once
// Files that are either the old ones or the new ones, never a part of either: the content goes to
// a temporary name in the same folder, reaches the disk, and only then takes the target's name.

#include <filesystem>
#include <string_view>

#include "core/files/descriptor.hpp"

namespace grainfield::core {

/// A temporary file beside `target`, for libraries that write by path. Gone again unless
/// committed; the target stays as it was until then. FileError names file and reason.
class AtomicFile {
  public:
    /// Creates the temporary, empty. The target's folder must exist; a link is followed.
    explicit AtomicFile(const std::filesystem::path& target);
    /// The same with a temporary of this name, in the target's folder. What has that name is lost,
    /// unless `keep_content`: then it is the content so far, and stays where it is unless
    /// committed.
    AtomicFile(const std::filesystem::path& target, std::filesystem::path temporary,
               bool keep_content = false);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Where to write.
    const std::filesystem::path& path() const { return temporary_; }

    /// Leaves the temporary where it is, for whoever goes on with it.
    void leave() { left_ = true; }

    /// Flushes the temporary to the disk and gives it the target's name. Whoever wrote it must
    /// have closed it. Call once.
    void commit();
    /// The same; what the target was until now takes the name `before`, in the same folder. Between
    /// the two moments there is no target, but there is `before`.
    void commit_keeping(const std::filesystem::path& before);

  private:
    void rename_and_flush(const std::filesystem::path* before);

    std::filesystem::path target_;
    std::filesystem::path temporary_;  ///< empty once committed
    Descriptor held_{-1};              ///< locked: whoever cleans up leaves the temporary alone
    bool left_ = false;                ///< not to be removed
};

/// Removes the temporaries that killed processes left in a folder: those that are a minute old and
/// that nobody holds. What cannot be removed stays.
void remove_abandoned_files(const std::filesystem::path& folder);

/// Replaces (or makes) the file by these bytes. On any failure FileError names file and reason,
/// and what was there before is still there.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace grainfield::core
