#include "triaxial/campaign/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <string>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial {
namespace {

std::string checksum(std::string_view line) {
    return fmt::format("{:016x}", XXH3_64bits(line.data(), line.size()));
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    throw FileError(
        fmt::format("{}: cannot be written: {}", path.string(), core::error_text(error)));
}

}  // namespace

std::vector<Row> read_journal(const std::filesystem::path& path) {
    std::vector<Row> rows;
    if (!std::filesystem::exists(path)) return rows;
    const std::string text = core::read_whole_file(path);
    std::string_view rest = text;
    for (int number = 1; !rest.empty(); ++number) {
        const auto end = rest.find('\n');
        if (end == std::string_view::npos) break;
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        // 16 digits, a blank, the row.
        Row row;
        if (line.size() < 17 || line[16] != ' ' ||
            line.substr(0, 16) != checksum(line.substr(17)) || !parse_row(line.substr(17), row))
            throw FileError(fmt::format(
                "{}:{}: the row is damaged; delete the line and its realization is computed anew",
                path.string(), number));
        rows.push_back(std::move(row));
    }
    return rows;
}

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0) fail(path_, errno);
    const std::string text = core::read_whole_file(path_);
    const auto last = text.rfind('\n');
    const std::size_t whole = last == std::string::npos ? 0 : last + 1;
    if (whole < text.size() && ::ftruncate(file_, static_cast<off_t>(whole)) != 0)
        fail(path_, errno);
    // The new name must outlive a power cut, too.
    const auto parent = path_.has_parent_path() ? path_.parent_path() : ".";
    const int folder = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) fail(path_, errno);
    ::fsync(folder);
    ::close(folder);
}

Journal::~Journal() {
    if (file_ >= 0) ::close(file_);
}

void Journal::append(std::span<const Row> rows) {
    if (rows.empty()) return;
    std::string text;
    for (const Row& row : rows) {
        const std::string line = row_line(row);
        text += checksum(line) + ' ' + line + '\n';
    }
    const off_t before = ::lseek(file_, 0, SEEK_END);
    const char* data = text.data();
    for (std::size_t left = text.size(); left > 0;) {
        const ssize_t n = ::write(file_, data, left);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            const int error = errno;
            // A full disk may have taken a part; if it cannot be cut off now, the next opening
            // does.
            std::ignore = ::ftruncate(file_, before);
            fail(path_, error);
        }
        data += n;
        left -= static_cast<std::size_t>(n);
    }
    if (::fsync(file_) != 0) fail(path_, errno);
}

}  // namespace grainfield::triaxial
