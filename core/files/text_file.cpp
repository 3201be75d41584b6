#include "core/files/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/memory_limit.hpp"

namespace grainfield::core {
namespace {

constexpr std::string_view white_space = " \t\r\n\f\v";

/// Pipes and devices may never end [B].
constexpr double most_of_a_stream = 256e6;

/// from_chars knows no plus sign, people do.
std::string_view without_plus(std::string_view text) {
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
    return plus ? text.substr(1) : text;
}

template <class T>
bool parse_all(std::string_view text, T& value) {
    text = without_plus(text);
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value);
    return result.ec == std::errc() && result.ptr == end;
}

template <class T>
void append_any(std::string& text, T value) {
    char digits[32];  // the longest double takes 24 characters
    const auto result = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, result.ptr);
}

}  // namespace

std::string error_text(int error) {
    return std::generic_category().message(error);
}

std::string read_whole_file(const std::filesystem::path& path) {
    const auto fail = [&](int error) {
        throw FileError(fmt::format("{}: cannot be read: {}", path.string(), error_text(error)));
    };
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) fail(errno);
    constexpr std::size_t block = std::size_t{1} << 20;
    struct stat info {};
    std::string content;
    const bool known = ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
    // What is read once is there twice while it is parsed.
    const double most = known ? 0.5 * memory_of_process() : most_of_a_stream;
    const auto too_large = [&] {
        ::close(fd);
        throw FileError(fmt::format(
            "{}: cannot be read: it is larger than {:.3g} MB, the most that "
            "{} allows",
            path.string(), 1e-6 * most, known ? "the memory" : "a file without a size"));
    };
    if (known && static_cast<double>(info.st_size) > most) too_large();
    if (known && info.st_size > 0) content.reserve(static_cast<std::size_t>(info.st_size) + block);
    // Pipes have no size, and a file may grow: read until the end says so.
    std::size_t filled = 0;
    ssize_t n = 0;
    do {
        content.resize(filled + block);
        n = ::read(fd, content.data() + filled, block);
        if (n < 0 && errno == EINTR) {
            n = 1;  // try again; nothing was read
            continue;
        }
        if (n > 0) filled += static_cast<std::size_t>(n);
        if (static_cast<double>(filled) > most) too_large();
    } while (n > 0);
    const int error = n < 0 ? errno : 0;
    ::close(fd);
    if (error != 0) fail(error);
    content.resize(filled);
    return content;
}

LineReader::LineReader(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

bool LineReader::next(std::string_view& line) {
    if (rest_.empty()) return false;
    line = next_field(rest_, '\n');
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number_;
    return true;
}

bool LineReader::next_content(std::string_view& line) {
    while (next(line)) {
        const std::size_t first = line.find_first_not_of(white_space);
        if (first != std::string_view::npos && line[first] != '#') return true;
    }
    return false;
}

std::size_t count_lines(std::string_view text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
}

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

std::string_view next_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(white_space), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(white_space));
    rest.remove_prefix(word.size());
    return word;
}

std::string_view next_field(std::string_view& rest, char separator) {
    const std::string_view field = rest.substr(0, rest.find(separator));
    rest.remove_prefix(std::min(field.size() + 1, rest.size()));
    return field;
}

bool parse_number(std::string_view text, double& value) {
    return parse_all(text, value) && std::isfinite(value);
}

bool parse_number(std::string_view text, std::int64_t& value) {
    return parse_all(text, value);
}

void append_number(std::string& text, double value) {
    append_any(text, value);
}

void append_number(std::string& text, std::int64_t value) {
    append_any(text, value);
}

void throw_at_line(const std::filesystem::path& path, std::int32_t line,
                   const std::string& message) {
    std::string what = fmt::format("{}:{}: {}", path.string(), line, message);
    std::erase(what, '\0');  // of text in another encoding; what() would end there
    throw InputError(what);
}

std::string_view shortened(std::string_view text) {
    return text.substr(0, 40);
}

}  // namespace grainfield::core
