#include "core/files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/descriptor.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& target, int error) {
    throw FileError(fmt::format("{}: cannot be written: {}", target.string(), error_text(error)));
}

constexpr const char* temporary_begin = ".grainfield-";
constexpr const char* temporary_end = ".tmp";
constexpr auto abandoned_after = std::chrono::minutes(1);  // a writer may not hold it yet

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The file that `target` really is. A rename would replace a link instead of the file behind it,
/// and would happily turn /dev/null into an ordinary file; the one is followed, the other refused.
fs::path real_target(const fs::path& target) {
    std::error_code error;
    fs::path real = target;
    if (fs::is_symlink(fs::symlink_status(target, error))) {
        real = fs::weakly_canonical(target, error);
        if (error) fail(target, error.value());
    }
    struct stat info {};
    if (::stat(real.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) {
        if (S_ISDIR(info.st_mode)) fail(target, EISDIR);
        throw FileError(fmt::format("{}: cannot be written: not a regular file", target.string()));
    }
    return real;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : target_(real_target(target)) {
    static std::atomic<unsigned> counter{0};
    while (true) {
        // Short, so that the longest allowed target name still works.
        temporary_ = folder_of(target_) / fmt::format("{}{}-{}{}", temporary_begin, ::getpid(),
                                                      counter.fetch_add(1), temporary_end);
        held_.fd = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (held_.fd >= 0) {
            (void)::flock(held_.fd, LOCK_SH | LOCK_NB);  // not everywhere; then age must do
            return;
        }
        if (errno != EEXIST) fail(target, errno);  // EEXIST: left by a killed run of our own id
    }
}

AtomicFile::AtomicFile(const fs::path& target, fs::path temporary, bool keep_content)
    : target_(real_target(target)), temporary_(std::move(temporary)), left_(keep_content) {
    const Descriptor file(
        ::open(temporary_.c_str(), O_WRONLY | (keep_content ? 0 : O_CREAT | O_TRUNC), 0666));
    if (file.fd < 0) fail(target_, errno);
}

AtomicFile::~AtomicFile() {
    if (!temporary_.empty() && !left_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    rename_and_flush(nullptr);
}

void AtomicFile::commit_keeping(const fs::path& before) {
    rename_and_flush(&before);
}

void AtomicFile::rename_and_flush(const fs::path* before) {
    const Descriptor file(::open(temporary_.c_str(), O_RDONLY));
    if (file.fd < 0 || ::fsync(file.fd) != 0) fail(target_, errno);
    const Descriptor folder(::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY));
    if (folder.fd < 0) fail(target_, errno);
    if (before && ::rename(target_.c_str(), before->c_str()) != 0 && errno != ENOENT)
        fail(target_, errno);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    temporary_.clear();
    // The new name must outlive a power cut, too. Not every file system knows how (EINVAL).
    if (::fsync(folder.fd) != 0 && errno != EINVAL && errno != ENOTSUP) fail(target_, errno);
}

void remove_abandoned_files(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (!name.starts_with(temporary_begin) || !name.ends_with(temporary_end)) continue;
        std::error_code ignored;
        const auto changed = fs::last_write_time(at->path(), ignored);
        if (ignored || fs::file_time_type::clock::now() - changed < abandoned_after) continue;
        const Descriptor file(::open(at->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
        if (file.fd >= 0 && ::flock(file.fd, LOCK_EX | LOCK_NB) == 0)
            fs::remove(at->path(), ignored);
    }
}

void write_file_atomically(const fs::path& path, std::string_view content) {
    AtomicFile file(path);
    Descriptor out(::open(file.path().c_str(), O_WRONLY));
    if (out.fd < 0) fail(path, errno);
    if (!out.write_at(0, content) || !out.close()) fail(path, errno);
    file.commit();
}

}  // namespace grainfield::core
