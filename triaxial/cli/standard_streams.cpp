#include "triaxial/cli/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial {
namespace {

[[noreturn]] void fail_on_stdout() {
    const int error = errno;
    std::clearerr(stdout);
    throw FileError(fmt::format("standard output: cannot be written: {}", core::error_text(error)));
}

}  // namespace

void open_standard_streams() {
    // open() takes the lowest free descriptor: what it gives above 2 was free by chance.
    while (true) {
        const int fd = ::open("/dev/null", O_RDWR);
        if (fd > STDERR_FILENO) ::close(fd);
        if (fd < 0 || fd > STDERR_FILENO) return;
    }
}

void write_log(std::string_view text) {
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
    (void)std::fflush(stderr);
}

void write_result(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail_on_stdout();
}

void flush_results() {
    if (std::fflush(stdout) != 0) fail_on_stdout();
}

}  // namespace grainfield::triaxial
