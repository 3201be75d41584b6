#include "core/state/checkpoint_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/checksum.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

namespace fs = std::filesystem;

// The number goes up whenever the content is laid out otherwise.
constexpr std::string_view file_title = "grainfield checkpoint 3\n";

struct Preamble {
    std::array<char, file_title.size()> title;
    std::array<char, 8> length;  ///< of the content, little end first [B]
    Checksum::Digest checksum;   ///< of the content
};
static_assert(sizeof(Preamble) == file_title.size() + 24);

Preamble preamble_of(const Checksum& content) {
    Preamble p;
    std::memcpy(p.title.data(), file_title.data(), file_title.size());
    for (std::size_t k = 0; k < p.length.size(); ++k)
        p.length[k] = static_cast<char>(content.length() >> (8 * k) & 0xff);
    p.checksum = content.digest();
    return p;
}

/// Writes to a file and takes the checksum on the way. Throws FileError from sputn().
class FileBuffer : public std::streambuf {
  public:
    FileBuffer(const fs::path& path, const fs::path& name)
        : name_(name), fd_(::open(path.c_str(), O_WRONLY)), buffer_(std::size_t{1} << 20) {
        if (fd_ < 0) fail();
        write(reinterpret_cast<const char*>(&blank_), sizeof blank_);
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }
    ~FileBuffer() override {
        if (fd_ >= 0) ::close(fd_);
    }

    /// Writes what is left, and the preamble over the blank one.
    void finish() {
        flush();
        const Preamble preamble = preamble_of(checksum_);
        if (::lseek(fd_, 0, SEEK_SET) != 0) fail();
        write(reinterpret_cast<const char*>(&preamble), sizeof preamble);
        const int fd = fd_;
        fd_ = -1;
        if (::close(fd) != 0) fail();
    }

  protected:
    int_type overflow(int_type c) override {
        flush();
        if (!traits_type::eq_int_type(c, traits_type::eof())) {
            *pptr() = traits_type::to_char_type(c);
            pbump(1);
        }
        return traits_type::not_eof(c);
    }
    int sync() override {
        flush();
        return 0;
    }

  private:
    [[noreturn]] void fail() const {
        throw FileError(
            fmt::format("{}: cannot be written: {}", name_.string(), error_text(errno)));
    }
    void flush() {
        const auto size = static_cast<std::size_t>(pptr() - pbase());
        checksum_.add(pbase(), size);
        write(pbase(), size);
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }
    void write(const char* data, std::size_t size) {
        while (size > 0) {
            const ssize_t n = ::write(fd_, data, size);
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) fail();
            data += n;
            size -= static_cast<std::size_t>(n);
        }
    }

    fs::path name_;
    int fd_;
    std::vector<char> buffer_;
    Checksum checksum_;
    Preamble blank_{};
};

}  // namespace

fs::path unfinished_file(const fs::path& file) {
    return fs::path(file) += ".new";
}

void write_checkpoint_file(const fs::path& file, const fs::path& before,
                           const std::function<void(std::ostream&)>& content) {
    AtomicFile target(file, unfinished_file(file));
    {
        FileBuffer buffer(target.path(), file);
        std::ostream stream(&buffer);
        stream.exceptions(std::ios::badbit | std::ios::failbit);
        content(stream);
        buffer.finish();
    }
    target.commit_keeping(before);
}

CheckpointReader::CheckpointReader(const fs::path& file) : stream_(file, std::ios::binary) {
    const auto fail = [&](std::string_view why) {
        throw FileError(fmt::format("{}: {}", file.string(), why));
    };
    if (!stream_) fail(fmt::format("cannot be read: {}", error_text(errno)));
    Preamble found;
    stream_.read(reinterpret_cast<char*>(&found), sizeof found);
    const auto read = static_cast<std::size_t>(stream_.gcount());
    constexpr std::size_t name = file_title.rfind(' ');
    if (read < file_title.size() ||
        std::string_view(found.title.data(), name) != file_title.substr(0, name))
        fail("is no checkpoint");
    if (std::string_view(found.title.data(), file_title.size()) != file_title)
        fail("is a checkpoint of another version of the program");
    if (read < sizeof found) fail("is damaged: cut off in its first lines");

    Checksum checksum;
    std::vector<char> chunk(std::size_t{1} << 20);
    while (stream_.read(chunk.data(), static_cast<std::streamsize>(chunk.size())),
           stream_.gcount() > 0)
        checksum.add(chunk.data(), static_cast<std::size_t>(stream_.gcount()));
    if (stream_.bad()) fail(fmt::format("cannot be read: {}", error_text(errno)));
    const Preamble right = preamble_of(checksum);
    if (right.length != found.length) fail("is damaged: its length is not what it says");
    if (right.checksum != found.checksum) fail("is damaged: its checksum is wrong");
    stream_.clear();
    stream_.seekg(sizeof found);
}

bool CheckpointReader::at_end() {
    return stream_.peek() == std::ifstream::traits_type::eof();
}

}  // namespace grainfield::core
