#pragma once
// One row of a campaign: what one realization gave, and how it stands in files.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grainfield::triaxial {

/// Realization of the rows of deterministic runs.
inline constexpr std::int64_t deterministic_run = -1;

struct Row {
    std::string case_name;
    std::int64_t realization = 0;  ///< deterministic_run for the run without a random field [-]
    std::uint64_t seed = 0;        ///< of the case's field [-]
    bool failed = false;
    double peak_deviator_stress = 0;  ///< [Pa]
    double E50 = 0;                   ///< [Pa]
    double friction_angle = 0;        ///< macroscopic, at the peak [rad]
    double axial_strain_at_peak = 0;  ///< [-]
    std::int64_t steps = 0;           ///< [-]
    double wall_seconds = 0;          ///< [s]
    std::string state_hash;
    std::string failure;     ///< "peak", "plateau" or "strain-limit"; empty in older tables
    std::string end_reason;  ///< of that, or "asked"
    std::string reason;      ///< why it failed
    std::vector<std::string> warnings = {};  ///< sentences on what makes the numbers doubtful

    bool operator==(const Row&) const = default;
};

/// Order of results.csv: by case, then by realization.
bool row_before(const Row& a, const Row& b);

/// Columns behind the others: keys that cases differ in, and their values, case by case.
struct SweptColumns {
    std::vector<std::string> keys;
    std::map<std::string, std::vector<std::string>> values;  ///< as many, of each case's name
};

/// results.csv of the contract: header and rows as they come; numbers of failed rows are empty.
std::string rows_csv(std::span<const Row> rows, const SweptColumns& swept = {});

/// warnings.csv: header and a line a warning.
std::string warnings_csv(std::span<const Row> rows);

/// A text as one field of a CSV file.
std::string quoted_field(std::string text);

/// A row as one line without its end, for the journal; numbers come back bit for bit.
std::string row_line(const Row& row);
/// The row of such a line. False if it is none.
bool parse_row(std::string_view line, Row& row);

}  // namespace grainfield::triaxial
