#include "triaxial/scene/csv_stream.hpp"

#include <fmt/format.h>

#include <cerrno>

#include "core/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

}  // namespace

CsvStream::CsvStream(const std::filesystem::path& path, std::string_view header)
    : path_(path),
      file_(path),
      out_(std::fopen(file_.path().c_str(), "wb"), [](std::FILE* f) { return std::fclose(f); }) {
    if (!out_)
        throw FileError(
            fmt::format("{}: cannot be written: {}", path.string(), core::error_text(errno)));
    text_ = header;
    text_ += '\n';
    flush();
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
    if (!written || std::fflush(out_.get()) != 0)
        throw FileError(
            fmt::format("{}: cannot be written: {}", path_.string(), core::error_text(errno)));
    text_.clear();
}

void CsvStream::commit() {
    flush();
    if (std::fclose(out_.release()) != 0)
        throw FileError(
            fmt::format("{}: cannot be written: {}", path_.string(), core::error_text(errno)));
    file_.commit();
}

}  // namespace grainfield::triaxial
