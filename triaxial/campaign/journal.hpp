#pragma once
// The journal of a campaign: every finished row, appended and on the disk before it counts. A row
// is there whole or not at all, whatever kills the program.

#include <filesystem>
#include <span>
#include <vector>

#include "triaxial/campaign/row.hpp"

namespace grainfield::triaxial {

/// All whole rows of a journal, in the order they were written; none if there is no such file. A
/// last line without its end is what a kill left of a row and is passed over. FileError: cannot be
/// read, or a line is damaged (each carries a checksum); the message names it.
std::vector<Row> read_journal(const std::filesystem::path& path);

/// Appends to a journal. One process at a time may have it open.
class Journal {
  public:
    /// Opens or makes the file and cuts off what a kill left of a last row. Throws FileError.
    explicit Journal(std::filesystem::path path);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Appends rows; when it returns they are on the disk. FileError where that fails; the journal
    /// then ends with the row before, or with a part of a row that the next opening cuts off.
    void append(std::span<const Row> rows);

  private:
    std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace grainfield::triaxial
