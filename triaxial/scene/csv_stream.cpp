#include "triaxial/scene/csv_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

namespace fs = std::filesystem;

fs::path part_of(fs::path path) {
    return path += ".part";
}

/// The first bytes of a file, as many as the mark says or as there are.
core::Checksum beginning_of(const fs::path& path, const CsvStream::Mark& mark) {
    core::Checksum checksum;
    std::ifstream in(path, std::ios::binary);
    std::vector<char> chunk(buffer_size);
    while (in && checksum.length() < mark.length) {
        const std::size_t wanted =
            std::min<std::uint64_t>(mark.length - checksum.length(), chunk.size());
        in.read(chunk.data(), static_cast<std::streamsize>(wanted));
        checksum.add(chunk.data(), static_cast<std::size_t>(in.gcount()));
    }
    return checksum;
}

bool agrees(const core::Checksum& checksum, const CsvStream::Mark& mark) {
    return checksum.length() == mark.length && checksum.digest() == mark.checksum;
}

/// The checksum of the rows at `mark`, which stand in the table's .part now.
core::Checksum written_rows(const fs::path& path, const CsvStream::Mark& mark) {
    const fs::path part = part_of(path);
    core::Checksum rows = beginning_of(part, mark);
    if (agrees(rows, mark)) return rows;
    // A run that ended between its results and its checkpoint has given the table its name already.
    rows = beginning_of(path, mark);
    if (!agrees(rows, mark))
        throw FileError(
            fmt::format("{}: is damaged: its first {} bytes are not those that the "
                        "checkpoint knows",
                        part.string(), mark.length));
    std::error_code error;
    fs::copy_file(path, part, fs::copy_options::overwrite_existing, error);
    if (error)
        throw FileError(fmt::format("{}: cannot be written: {}", part.string(), error.message()));
    return rows;
}

}  // namespace

CsvStream::CsvStream(const fs::path& path, std::string_view header)
    : path_(path), file_(path, part_of(path)), out_(::open(file_.path().c_str(), O_RDWR)) {
    if (out_.fd < 0) fail();
    text_ = header;
    text_ += '\n';
    flush();
}

CsvStream::CsvStream(const fs::path& path, const Mark& mark)
    : path_(path),
      checksum_(written_rows(path, mark)),
      file_(path, part_of(path), true),
      out_(::open(file_.path().c_str(), O_RDWR)),
      marked_(true) {
    if (out_.fd < 0 || ::ftruncate(out_.fd, static_cast<off_t>(mark.length)) != 0) fail();
}

CsvStream::~CsvStream() {
    if (marked_) file_.leave();
}

void CsvStream::fail() const {
    throw FileError(
        fmt::format("{}: cannot be written: {}", path_.string(), core::error_text(errno)));
}

CsvStream::Mark CsvStream::mark() {
    bring_to_disk();
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
    // After a write that failed these rows are still here, and go to the same place.
    if (!out_.write_at(checksum_.length(), text_)) fail();
    checksum_.add(text_.data(), text_.size());
    text_.clear();
}

void CsvStream::bring_to_disk() {
    flush();
    // Where fsync() fails, the system forgets what did not reach the disk, and the next fsync()
    // finds nothing to do: everything must be written again.
    if (doubtful_) write_again();
    doubtful_ = true;
    if (::fsync(out_.fd) != 0) fail();
    doubtful_ = false;
}

void CsvStream::write_again() {
    std::vector<char> chunk(buffer_size);
    for (std::uint64_t done = 0; done < checksum_.length();) {
        const ssize_t n = ::pread(out_.fd, chunk.data(), chunk.size(), static_cast<off_t>(done));
        if (n == 0) errno = EIO;
        if (n <= 0) fail();
        if (!out_.write_at(done, {chunk.data(), static_cast<std::size_t>(n)})) fail();
        done += static_cast<std::uint64_t>(n);
    }
}

void CsvStream::commit() {
    bring_to_disk();
    if (!out_.close()) fail();
    file_.commit();
    marked_ = false;
}

}  // namespace grainfield::triaxial
