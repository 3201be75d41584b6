#pragma once
// A table that grows while a run goes on: rows go to NAME.part, which takes the table's name only
// at the end. A run that resumes goes on with the rows that its checkpoint knows.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/atomic_file.hpp"
#include "core/files/checksum.hpp"
#include "core/files/descriptor.hpp"

namespace grainfield::triaxial {

class CsvStream {
  public:
    /// The rows up to a moment.
    struct Mark {
        std::uint64_t length = 0;  ///< header and rows [B]
        core::Checksum::Digest checksum{};
    };

    /// Begins a table. FileError where the file cannot be made or written, here and below.
    CsvStream(const std::filesystem::path& path, std::string_view header);
    /// Goes on with the rows that were there at `mark`, whether the table has its name already or
    /// not; later ones are dropped. FileError where these are not there any more.
    CsvStream(const std::filesystem::path& path, const Mark& mark);
    ~CsvStream();

    /// Ids first, then numbers as the shortest text that reads back as the same double.
    void add(std::int64_t id);
    void add(double value);
    void end_row();

    /// Brings the rows so far to the disk, for a checkpoint. From now on they outlive this.
    Mark mark();

    /// Writes what is left and gives the file its name. Call once.
    void commit();

  private:
    [[noreturn]] void fail() const;
    void flush();
    void bring_to_disk();
    void write_again();

    std::filesystem::path path_;
    core::Checksum checksum_;  // of the rows written
    core::AtomicFile file_;
    core::Descriptor out_;
    std::string text_;  // rows not yet written
    bool marked_ = false;
    bool doubtful_ = false;  // some of what was written may never reach the disk
};

}  // namespace grainfield::triaxial
