#pragma once
// An open file of the system, for whoever must know when bytes are on the disk.

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string_view>

namespace grainfield::core {

/// A file descriptor that closes itself.
struct Descriptor {
    int fd = -1;
    explicit Descriptor(int opened) : fd(opened) {}
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    /// Some file systems report a full disk only here. True if all is well.
    bool close() {
        const int rc = ::close(fd);
        fd = -1;
        return rc == 0;
    }

    /// Writes all of it from `offset` [B] on. False where that fails, errno set; some of it may be
    /// written then.
    bool write_at(std::uint64_t offset, std::string_view content) const {
        while (!content.empty()) {
            const ssize_t n =
                ::pwrite(fd, content.data(), content.size(), static_cast<off_t>(offset));
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) return false;
            content.remove_prefix(static_cast<std::size_t>(n));
            offset += static_cast<std::uint64_t>(n);
        }
        return true;
    }
};

}  // namespace grainfield::core
