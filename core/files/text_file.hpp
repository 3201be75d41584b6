#pragma once
// What every reader and writer of text shares: whole files, lines with their numbers, and numbers
// that come back bit for bit whatever the locale.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace grainfield::core {

/// What the system says about an errno value.
std::string error_text(int error);

/// All bytes of a file. FileError names file and reason: also where it is larger than half of the
/// memory, or is a pipe or a device and gives more than 256 MB.
std::string read_whole_file(const std::filesystem::path& path);

/// Goes through a text line by line and counts. Lines end with LF or CRLF; a UTF-8 byte order
/// mark at the start is skipped. The text must outlive the reader.
class LineReader {
  public:
    explicit LineReader(std::string_view text);

    /// The next line without its end; false after the last one.
    bool next(std::string_view& line);
    /// Like next(), but skips lines that are blank or start with #.
    bool next_content(std::string_view& line);
    /// Number of the line that was returned last, from 1.
    std::int32_t number() const { return number_; }

  private:
    std::string_view rest_;
    std::int32_t number_ = 0;
};

/// Upper bound of the number of lines, to reserve memory by.
std::size_t count_lines(std::string_view text);

/// Without white space at both ends.
std::string_view trim(std::string_view text);

/// Cuts the next word (white space separates) off the front of `rest`; empty if there is none.
std::string_view next_word(std::string_view& rest);

/// Cuts the part before the next `separator` off the front of `rest`. Call once more than there
/// are separators; the last part leaves `rest` empty.
std::string_view next_field(std::string_view& rest, char separator);

/// The whole text as a number. False if it is not one, does not fit or is not finite.
bool parse_number(std::string_view text, double& value);
bool parse_number(std::string_view text, std::int64_t& value);

/// Appends the shortest text that reads back as the same double.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);

/// "file:line: message" as InputError.
[[noreturn]] void throw_at_line(const std::filesystem::path& path, std::int32_t line,
                                const std::string& message);

/// A piece of the user's text, short enough to quote in a message.
std::string_view shortened(std::string_view text);

}  // namespace grainfield::core
