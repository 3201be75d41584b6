#include "triaxial/report/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial::report {
namespace {

void parse_row(std::string_view line, const std::string& where,
               std::vector<std::vector<double>>& columns) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
        if (line.empty())
            throw FileError(fmt::format("{}: {} cells, must be {}", where, column, columns.size()));
        const std::string_view cell = core::next_field(line, ',');
        double value = 0;
        if (!core::parse_number(core::trim(cell), value))
            throw FileError(
                fmt::format("{}: '{}' is not a finite number", where, core::shortened(cell)));
        columns[column].push_back(value);
    }
    if (!line.empty())
        throw FileError(fmt::format("{}: more than {} cells", where, columns.size()));
}

}  // namespace

std::vector<std::vector<double>> read_number_table(const std::filesystem::path& path,
                                                   std::string_view header) {
    const std::string text = core::read_whole_file(path);
    core::LineReader reader(text);
    const auto where = [&] { return fmt::format("{}:{}", path.string(), reader.number()); };
    std::string_view line;
    if (!reader.next(line) || line != header)
        throw FileError(fmt::format("{}:1: the header must be '{}'", path.string(), header));
    std::vector<std::vector<double>> columns(
        static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1);
    while (reader.next_content(line)) parse_row(line, where(), columns);
    if (columns[0].size() < 2)
        throw FileError(
            fmt::format("{}: {} rows, must be two at least", path.string(), columns[0].size()));
    return columns;
}

}  // namespace grainfield::triaxial::report
