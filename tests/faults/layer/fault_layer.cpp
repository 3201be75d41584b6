// A library for LD_PRELOAD that stands between a program and its files: it counts the calls that
// touch a folder and lets one of them go wrong. Told what to do by environment variables:
//
//   GRAINFIELD_FAULT_FOLDER  calls on files below this folder, or on itself, count (absolute path)
//   GRAINFIELD_FAULT_AT      number of the call that goes wrong, from 1; none, if unset
//   GRAINFIELD_FAULT_KIND    what happens to it, see `Kind` below
//   GRAINFIELD_FAULT_LOG     file that gets a line for every call: number, call, path
//
// Calls inside libc (a FILE's) do not pass here; the program writes no file of its own that way.

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

enum class Kind {
    eio,        // "eio": the call fails with EIO, once
    enospc,     // "enospc": the call fails with ENOSPC, once
    full,       // "full": every write and new file from this call on fails with ENOSPC
    half,       // "half": a write writes half, once
    half_full,  // "half_full": a write writes half, the next call (for the rest) fails with ENOSPC
    kill,       // "kill": the process dies before the call
    half_kill,  // "half_kill": a write writes half, then the process dies
    none
};

enum class Call { space, write, other };  // space: needs room on the disk, but is no write

constexpr int most_files = 1024;

struct Layer {
    std::string folder;
    std::array<std::string, most_files> path;  // of each open descriptor; empty: none of ours
    std::atomic<int> calls{0};
    int at = 0, log = -1;
    Kind kind = Kind::none;
};

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

Kind kind_of(const std::string& name) {
    constexpr std::array names{"eio", "enospc", "full", "half", "half_full", "kill", "half_kill"};
    return static_cast<Kind>(std::find(names.begin(), names.end(), name) - names.begin());
}

// Made by the first call and never unmade: other libraries open and close files before this one's
// constructors have run and after its destructors.
Layer& layer() {
    static Layer* const the = [] {
        auto* made = new Layer;
        made->folder = variable("GRAINFIELD_FAULT_FOLDER");
        made->at = std::atoi(variable("GRAINFIELD_FAULT_AT").c_str());
        made->kind = kind_of(variable("GRAINFIELD_FAULT_KIND"));
        const std::string log = variable("GRAINFIELD_FAULT_LOG");
        if (!log.empty())
            made->log =
                static_cast<int>(::syscall(SYS_openat, AT_FDCWD, log.c_str(),
                                           O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
        ::unsetenv("LD_PRELOAD");  // programs that this one starts are left alone
        return made;
    }();
    return *the;
}

/// The path without links in its folders, as the kernel knows it; "" where that is not ours.
std::string our_path(int folder, const char* path) {
    const int error = errno;
    std::string whole = path;
    if (whole.empty() || whole[0] != '/') {
        std::array<char, PATH_MAX> base{};
        const std::string link =
            folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/" + std::to_string(folder);
        const ssize_t n = ::readlink(link.c_str(), base.data(), base.size());
        whole = std::string(base.data(), n > 0 ? static_cast<std::size_t>(n) : 0) + "/" + whole;
    }
    errno = error;
    const std::string& ours = layer().folder;
    const bool below = !ours.empty() && whole.starts_with(ours) &&
                       (whole.size() == ours.size() || whole[ours.size()] == '/');
    return below ? whole : "";
}

const std::string& path_of(int fd) {
    static const std::string nothing;
    return fd >= 0 && fd < most_files ? layer().path[static_cast<std::size_t>(fd)] : nothing;
}

void set_path(int fd, const std::string& path) {
    if (fd >= 0 && fd < most_files) layer().path[static_cast<std::size_t>(fd)] = path;
}

[[noreturn]] void die() {
    ::syscall(SYS_kill, ::getpid(), SIGKILL);
    while (true) ::pause();
}

/// Counts a call on `path`. True where it must fail, errno set; half of a write is left to write().
bool goes_wrong(const char* call, const std::string& path, Call sort, bool& half) {
    half = false;
    if (path.empty()) return false;
    Layer& l = layer();
    const int number = ++l.calls;
    if (l.log >= 0) {
        const std::string line = std::to_string(number) + " " + call + " " + path + "\n";
        (void)::syscall(SYS_write, l.log, line.data(), line.size());
    }
    if (l.kind == Kind::full && l.at > 0 && number >= l.at && sort != Call::other) {
        errno = ENOSPC;
        return true;
    }
    if (l.kind == Kind::half_full && l.at > 0 && number == l.at + 1) {
        errno = ENOSPC;
        return true;
    }
    if (number != l.at) return false;
    switch (l.kind) {
        case Kind::eio:
        case Kind::enospc:
            errno = l.kind == Kind::eio ? EIO : ENOSPC;
            return true;
        case Kind::kill:
            die();
        case Kind::half:
        case Kind::half_full:
        case Kind::half_kill:
            half = sort == Call::write;
            return false;
        case Kind::full:
        case Kind::none:
            break;
    }
    return false;
}

bool goes_wrong(const char* call, const std::string& path, Call sort = Call::other) {
    bool half = false;
    return goes_wrong(call, path, sort, half);
}

/// A write of `size` bytes, which `write` does.
template <class Write>
ssize_t guarded_write(const char* call, int fd, std::size_t size, const Write& write) {
    bool half = false;
    if (goes_wrong(call, path_of(fd), Call::write, half)) return -1;
    const ssize_t n = write(half ? size / 2 : size);
    if (half && layer().kind == Kind::half_kill) die();
    return n;
}

int guarded_open(int folder, const char* path, int flags, mode_t mode) {
    const std::string ours = our_path(folder, path);
    if (goes_wrong("open", ours, (flags & O_CREAT) ? Call::space : Call::other)) return -1;
    const int fd = static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
    set_path(fd, ours);
    return fd;
}

mode_t mode_in(int flags, va_list arguments) {
    return (flags & (O_CREAT | O_TMPFILE)) ? va_arg(arguments, mode_t) : 0;
}

/// Of a system call on one path.
int guarded(const char* call, const char* path, Call sort, long number, long argument = 0) {
    if (goes_wrong(call, our_path(AT_FDCWD, path), sort)) return -1;
    return static_cast<int>(::syscall(number, path, argument));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_in(flags, arguments);
    va_end(arguments);
    return guarded_open(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_in(flags, arguments);
    va_end(arguments);
    return guarded_open(AT_FDCWD, path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_in(flags, arguments);
    va_end(arguments);
    return guarded_open(folder, path, flags, mode);
}
int openat64(int folder, const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_in(flags, arguments);
    va_end(arguments);
    return guarded_open(folder, path, flags, mode);
}
int creat(const char* path, mode_t mode) {
    return guarded_open(AT_FDCWD, path, O_CREAT | O_WRONLY | O_TRUNC, mode);
}

ssize_t write(int fd, const void* data, size_t size) {
    return guarded_write("write", fd, size,
                         [&](std::size_t n) { return ::syscall(SYS_write, fd, data, n); });
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
    return guarded_write("pwrite", fd, size, [&](std::size_t n) {
        return ::syscall(SYS_pwrite64, fd, data, n, offset);
    });
}
ssize_t pwrite64(int fd, const void* data, size_t size, off64_t offset) {
    return pwrite(fd, data, size, offset);
}
ssize_t writev(int fd, const iovec* parts, int count) {
    return guarded_write("writev", fd, 2, [&](std::size_t n) {
        return n == 2 || count == 0 ? ::syscall(SYS_writev, fd, parts, count)
                                    : ::syscall(SYS_write, fd, parts->iov_base, parts->iov_len / 2);
    });
}

int fsync(int fd) {
    if (path_of(fd).empty()) return static_cast<int>(::syscall(SYS_fsync, fd));
    // Of ours none waits for the disk: nobody cuts the power here.
    return goes_wrong("fsync", path_of(fd), Call::space) ? -1 : 0;
}
int fdatasync(int fd) {
    return fsync(fd);
}
int ftruncate(int fd, off_t length) {
    if (goes_wrong("ftruncate", path_of(fd))) return -1;
    return static_cast<int>(::syscall(SYS_ftruncate, fd, length));
}
int ftruncate64(int fd, off64_t length) {
    return ftruncate(fd, length);
}
int close(int fd) {
    const std::string ours = path_of(fd);
    set_path(fd, "");
    // One that reports an error has closed the file all the same.
    const bool wrong = goes_wrong("close", ours);
    const int error = errno;
    const int rc = static_cast<int>(::syscall(SYS_close, fd));
    if (!wrong) return rc;
    errno = error;
    return -1;
}

int rename(const char* from, const char* to) {
    // Told by where it goes; a name that only leaves the folder's eye is told by where it was.
    std::string ours = our_path(AT_FDCWD, to);
    if (ours.empty()) ours = our_path(AT_FDCWD, from);
    if (goes_wrong("rename", ours, Call::space)) return -1;
    return static_cast<int>(::syscall(SYS_rename, from, to));
}
int link(const char* from, const char* to) {
    if (goes_wrong("link", our_path(AT_FDCWD, to), Call::space)) return -1;
    return static_cast<int>(::syscall(SYS_link, from, to));
}
int unlink(const char* path) {
    return guarded("unlink", path, Call::other, SYS_unlink);
}
int remove(const char* path) {
    const int rc = guarded("remove", path, Call::other, SYS_unlink);
    return rc != 0 && errno == EISDIR ? static_cast<int>(::syscall(SYS_rmdir, path)) : rc;
}
int mkdir(const char* path, mode_t mode) {
    return guarded("mkdir", path, Call::space, SYS_mkdir, mode);
}

}  // extern "C"
