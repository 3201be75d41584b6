#include "triaxial/report/campaign/campaign_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/config/toml_file.hpp"
#include "triaxial/realization/failure.hpp"
#include "triaxial/realization/quality.hpp"
#include "triaxial/report/json_file.hpp"
#include "triaxial/report/natural_order.hpp"

namespace grainfield::triaxial::report {
namespace {

namespace fs = std::filesystem;

/// The rows of a results table.
std::vector<triaxial::Row> read_rows(const fs::path& path) {
    std::vector<triaxial::Row> rows;
    const std::string text = core::read_whole_file(path);
    core::LineReader lines(text);
    std::string_view line;
    const auto fail = [&](const char* what) {
        throw FileError(fmt::format("{}:{}: {}", path.string(), lines.number(), what));
    };
    // Behind these columns may stand those of swept keys. Tables of earlier versions end with the
    // state hash.
    constexpr std::string_view added = ",failure,end_reason";
    const std::string header(core::trim(rows_csv({})));
    const std::string earlier = header.substr(0, header.size() - added.size());
    const bool found = lines.next(line);
    const auto begins_with = [&](const std::string& columns) {
        return found && (std::string(line) + ",").starts_with(columns + ",");
    };
    const bool says_end = begins_with(header);
    if (!says_end && !begins_with(earlier)) fail("not the header of a table of results");
    while (lines.next(line)) {
        std::vector<std::string_view> fields;
        for (std::string_view rest = line; fields.size() < 13;)
            fields.push_back(core::next_field(rest, ','));
        triaxial::Row row;
        row.case_name = fields[0];
        row.failed = fields[3] == "failed";
        row.state_hash = fields[10];
        if (says_end) {
            row.failure = fields[11];
            row.end_reason = fields[12];
        }
        const auto number = [&](std::size_t at, auto& value) {
            if (!core::parse_number(fields[at], value)) fail("a number is expected");
        };
        number(1, row.realization);
        number(9, row.wall_seconds);
        if (!row.failed) {
            number(4, row.peak_deviator_stress);
            number(5, row.E50);
            number(6, row.friction_angle);
            number(7, row.axial_strain_at_peak);
            number(8, row.steps);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// The lines below the header.
std::vector<std::string> read_lines(const fs::path& path) {
    std::vector<std::string> found;
    const std::string text = core::read_whole_file(path);
    core::LineReader lines(text);
    std::string_view line;
    for (lines.next(line); lines.next(line);) found.emplace_back(line);
    return found;
}

/// Runs with warnings in each case; a run's warnings follow each other.
void count_warnings(CampaignData& data, const std::map<std::string, std::size_t>& index) {
    const std::string not_quasi_static = fmt::format("\"{}", not_quasi_static_words);
    std::string run;
    for (const std::string& warning : data.warnings) {
        std::string_view rest = warning;
        const std::string name(core::next_field(rest, ','));
        const std::string realization(core::next_field(rest, ','));
        const auto at = index.find(name);
        if (at == index.end() || realization == fmt::format("{}", deterministic_run)) continue;
        CaseData& one = data.cases[at->second];
        if (std::exchange(run, name + "," + realization) != run) ++one.with_warnings;
        if (rest.starts_with(not_quasi_static)) ++one.not_quasi_static;
    }
}

}  // namespace

bool is_campaign(const fs::path& folder) {
    return fs::exists(folder / "campaign.json");
}

CampaignData read_campaign_data(const fs::path& folder) {
    CampaignData data;
    data.path = folder;
    const JsonFile json(folder / "campaign.json");
    auto named = json.members("cases");
    std::ranges::sort(named, natural_less, [](const auto& one) { return one.first; });
    data.version = json.optional_text("version").value_or("unknown");
    data.machines = json.texts("machines");
    std::map<std::string, std::size_t> index;
    for (const auto& [name, one] : named) {
        CaseData& made = data.cases.emplace_back();
        index[name] = data.cases.size() - 1;
        made.name = name;
        made.kernels = one.optional_text("kernels").value_or("");
        made.config = one.optional_text("config").value_or("");
        made.values = leaf_texts(made.config, (folder / "campaign.json").string());
    }
    const auto place = [&](const triaxial::Row& row) -> CaseData& {
        const auto at = index.find(row.case_name);
        if (at == index.end())
            throw FileError(fmt::format("{}: case \"{}\" of results.csv is not there",
                                        (folder / "campaign.json").string(), row.case_name));
        return data.cases[at->second];
    };
    for (triaxial::Row& row : read_rows(folder / "results.csv")) {
        CaseData& one = place(row);
        data.wall_seconds += row.wall_seconds;
        if (row.failure == failure_name(Failure::strain_limit)) ++one.without_peak;
        if (row.failed)
            ++one.failed;
        else
            one.rows.push_back(std::move(row));
    }
    for (triaxial::Row& row : read_rows(folder / "deterministic.csv"))
        if (CaseData& one = place(row); !row.failed) one.deterministic = std::move(row);
    data.failures = read_lines(folder / "failures.csv");
    if (fs::exists(folder / "warnings.csv"))  // campaigns of earlier versions have none
        data.warnings = read_lines(folder / "warnings.csv");
    count_warnings(data, index);

    std::set<std::string> keys;
    for (const CaseData& one : data.cases)
        for (const auto& [key, value] : one.values)
            for (const CaseData& other : data.cases) {
                const auto at = other.values.find(key);
                if (at == other.values.end() || at->second != value) keys.insert(key);
            }
    data.varying.assign(keys.begin(), keys.end());
    return data;
}

std::vector<double> values_of(const CaseData& one, const Quantity& quantity) {
    std::vector<double> values;
    for (const triaxial::Row& row : one.rows)
        values.push_back(row.*quantity.value * quantity.scale);
    return values;
}

}  // namespace grainfield::triaxial::report
