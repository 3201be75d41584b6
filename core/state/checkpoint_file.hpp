#pragma once
// A checkpoint as a file: a line that says what it is, its length, a checksum of all that follows,
// the content. Every bit of it is looked at before any of it is believed.

#include <filesystem>
#include <fstream>
#include <functional>
#include <iosfwd>

namespace grainfield::core {

/// Replaces (or makes) the file, with the content that `content` writes to the stream; the file of
/// before becomes `before`. All of it is on the disk when this returns. FileError names file and
/// reason; `file` or `before` is then still what `file` was.
void write_checkpoint_file(const std::filesystem::path& file, const std::filesystem::path& before,
                           const std::function<void(std::ostream&)>& content);

/// Where a checkpoint stands until it is whole: x.bin -> x.bin.new. Always the same name: what a
/// killed run leaves behind is written over, not heaped up.
std::filesystem::path unfinished_file(const std::filesystem::path& file);

/// A checkpoint file whose checksum is right, open where its content begins.
class CheckpointReader {
  public:
    /// FileError if it cannot be read, is no checkpoint, is too short or too long, or has changed.
    explicit CheckpointReader(const std::filesystem::path& file);

    std::istream& stream() { return stream_; }
    /// True once everything has been read.
    bool at_end();

  private:
    std::ifstream stream_;
};

}  // namespace grainfield::core
