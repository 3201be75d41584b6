#pragma once
// A table that grows while a run goes on: rows go to a temporary file, which takes the table's name
// only at the end.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/files/atomic_file.hpp"

namespace grainfield::triaxial {

class CsvStream {
  public:
    /// FileError where the file cannot be made or written, here and below.
    CsvStream(const std::filesystem::path& path, std::string_view header);

    /// Ids first, then numbers as the shortest text that reads back as the same double.
    void add(std::int64_t id);
    void add(double value);
    void end_row();

    /// Writes what is left and gives the file its name. Call once.
    void commit();

  private:
    void flush();

    std::filesystem::path path_;
    core::AtomicFile file_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> out_;
    std::string text_;  // rows not yet written
};

}  // namespace grainfield::triaxial
