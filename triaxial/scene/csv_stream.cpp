#include "triaxial/scene/csv_stream.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "core/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

std::filesystem::path part_of(std::filesystem::path path) {
    return path += ".part";
}

}  // namespace

CsvStream::CsvStream(const std::filesystem::path& path, std::string_view header)
    : path_(path),
      file_(path, part_of(path)),
      out_(std::fopen(file_.path().c_str(), "wb"), [](std::FILE* f) { return std::fclose(f); }) {
    if (!out_) fail();
    text_ = header;
    text_ += '\n';
    flush();
}

CsvStream::CsvStream(const std::filesystem::path& path, const Mark& mark)
    : path_(path),
      file_(path, part_of(path), true),
      out_(std::fopen(file_.path().c_str(), "rb+"), [](std::FILE* f) { return std::fclose(f); }),
      marked_(true) {
    if (!out_) fail();
    std::vector<char> chunk(buffer_size);
    while (checksum_.length() < mark.length) {
        const std::size_t wanted =
            std::min<std::uint64_t>(mark.length - checksum_.length(), chunk.size());
        const std::size_t read = std::fread(chunk.data(), 1, wanted, out_.get());
        if (read == 0) break;
        checksum_.add(chunk.data(), read);
    }
    if (checksum_.length() != mark.length || checksum_.digest() != mark.checksum)
        throw FileError(
            fmt::format("{}: is damaged: its first {} bytes are not those that the "
                        "checkpoint knows",
                        file_.path().string(), mark.length));
    if (::ftruncate(::fileno(out_.get()), static_cast<off_t>(mark.length)) != 0) fail();
    if (std::fseek(out_.get(), 0, SEEK_END) != 0) fail();
}

CsvStream::~CsvStream() {
    if (marked_) file_.leave();
}

void CsvStream::fail() const {
    throw FileError(
        fmt::format("{}: cannot be written: {}", path_.string(), core::error_text(errno)));
}

CsvStream::Mark CsvStream::mark() {
    flush();
    if (::fsync(::fileno(out_.get())) != 0) fail();
    marked_ = true;
    return {checksum_.length(), checksum_.digest()};
}

void CsvStream::add(std::int64_t id) {
    core::append_number(text_, id);
    text_ += ',';
}

void CsvStream::add(double value) {
    core::append_number(text_, value);
    text_ += ',';
}

void CsvStream::end_row() {
    text_.back() = '\n';
    if (text_.size() > buffer_size) flush();
}

void CsvStream::flush() {
    const bool written = std::fwrite(text_.data(), 1, text_.size(), out_.get()) == text_.size();
    if (!written || std::fflush(out_.get()) != 0) fail();
    checksum_.add(text_.data(), text_.size());
    text_.clear();
}

void CsvStream::commit() {
    flush();
    if (std::fclose(out_.release()) != 0) fail();
    file_.commit();
    marked_ = false;
}

}  // namespace grainfield::triaxial
