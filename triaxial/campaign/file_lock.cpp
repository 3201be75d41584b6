#include "triaxial/campaign/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <thread>
#include <tuple>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial {

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& path, Kind kind) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
        throw FileError(
            fmt::format("{}: cannot be opened: {}", path.string(), core::error_text(errno)));
    FileLock lock(file);
    if (::flock(file, (kind == Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return std::nullopt;
        throw FileError(
            fmt::format("{}: cannot be locked: {}", path.string(), core::error_text(errno)));
    }
    if (kind == Kind::alone) {
        std::array<char, 256> host{};
        ::gethostname(host.data(), host.size() - 1);
        const std::string holder = fmt::format("process {} on {}", ::getpid(), host.data());
        // Only for messages: if it fails, they say less.
        std::ignore = ::ftruncate(file, 0);
        std::ignore = ::pwrite(file, holder.data(), holder.size(), 0);
    }
    return lock;
}

FileLock::FileLock(FileLock&& other) noexcept : file_(other.file_) {
    other.file_ = -1;
}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
}

bool FileLock::is_at(const std::filesystem::path& path) const {
    struct stat locked {
    }, found{};
    return ::fstat(file_, &locked) == 0 && ::stat(path.c_str(), &found) == 0 &&
           locked.st_dev == found.st_dev && locked.st_ino == found.st_ino;
}

FileLock::~FileLock() {
    if (file_ >= 0) ::close(file_);
}

void FileLock::pause() {
    std::this_thread::sleep_for(std::chrono::seconds(1));
}

std::string lock_holder(const std::filesystem::path& path) {
    try {
        return core::read_whole_file(path);
    } catch (const FileError&) {
        return {};
    }
}

}  // namespace grainfield::triaxial
