#include "core/files/table_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

/// The tables of the interface contract, by how their headers start.
constexpr struct {
    std::string_view header, kind;
} known_tables[] = {
    {"realization,i,j,k,G", "random field"},
    {"axial_strain,deviator_stress_Pa", "curve of a triaxial test"},
    {"case,realization,seed,status", "results of a campaign"},
    {"time_s,id,x,y,z", "trajectory"},
    {"time_s,kinetic_J", "energy balance"},
    {"i,j,overlap_m", "contacts"},
};

std::string_view kind_of(std::string_view header) {
    for (const auto& table : known_tables)
        if (header.starts_with(table.header)) return table.kind;
    return "table";
}

struct ColumnInfo {
    std::string name;
    bool numeric = true;
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
    std::set<std::string, std::less<>> texts;  ///< different values while there are few

    void add(std::string_view field) {
        double value = 0.0;
        if (numeric && parse_number(field, value)) {
            lower = std::min(lower, value);
            upper = std::max(upper, value);
        } else if (!field.empty()) {
            numeric = false;
        }
        constexpr std::size_t few = 6;
        if (texts.size() <= few && !texts.contains(field)) texts.emplace(field);
    }

    std::string text() const {
        if (numeric && lower <= upper) return fmt::format("{:.6g} to {:.6g}", lower, upper);
        constexpr std::size_t few = 6;
        if (texts.size() > few) return fmt::format("more than {} different texts", few);
        std::string list;
        for (const std::string& t : texts) list += (list.empty() ? "" : ", ") + t;
        return list;
    }
};

}  // namespace

std::string describe_table(std::string_view text, const std::filesystem::path& path) {
    LineReader lines(text);
    std::string_view line;
    if (!lines.next_content(line))
        throw InputError(fmt::format("{}: empty, not even a header", path.string()));
    const std::string_view kind = kind_of(line);
    if (double value = 0.0; parse_number(trim(line.substr(0, line.find(','))), value))
        throw InputError(fmt::format("{}:{}: begins with a number: the first line must be a header",
                                     path.string(), lines.number()));
    std::vector<ColumnInfo> columns(
        static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1);
    for (ColumnInfo& c : columns) c.name = trim(next_field(line, ','));
    std::size_t rows = 0;
    for (; lines.next_content(line); ++rows) {
        const auto fields = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
        if (fields != columns.size())
            throw InputError(fmt::format("{}:{}: {} fields, but the header has {}", path.string(),
                                         lines.number(), fields, columns.size()));
        for (ColumnInfo& c : columns) c.add(trim(next_field(line, ',')));
    }
    std::string info = fmt::format("{}: {} rows, {} columns\n", kind, rows, columns.size());
    for (const ColumnInfo& c : columns) info += fmt::format("  {}: {}\n", c.name, c.text());
    return info;
}

}  // namespace grainfield::core
