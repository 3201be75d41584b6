#pragma once
// What a campaign left in its folder, as the report needs it.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "triaxial/campaign/row.hpp"
#include "triaxial/report/gnuplot_variables.hpp"

namespace grainfield::triaxial::report {

/// One case with its finished rows.
struct CaseData {
    std::string name;
    std::string kernels;                        ///< "avx512, mixed"
    std::string config;                         ///< TOML
    std::map<std::string, std::string> values;  ///< of all config keys, as TOML
    std::vector<triaxial::Row> rows;            ///< that did not fail, by realization
    std::optional<triaxial::Row> deterministic;
    std::size_t failed = 0;            ///< [-]
    std::size_t without_peak = 0;      ///< of the rows: ended before a peak or plateau [-]
    std::size_t with_warnings = 0;     ///< of the rows [-]
    std::size_t not_quasi_static = 0;  ///< of these [-]
};

struct CampaignData {
    std::filesystem::path path;
    std::string version;
    std::vector<std::string> machines;  ///< that worked on it
    std::vector<CaseData> cases;        ///< by name, numbers in it by their size
    std::vector<std::string> failures;  ///< case, realization and reason of each, as text
    std::vector<std::string> warnings;  ///< case, realization and sentence of each, as text
    std::vector<std::string> varying;   ///< config keys that are not the same in all cases
    double wall_seconds = 0;            ///< of all rows [s]
};

/// True if the folder is one of a campaign.
bool is_campaign(const std::filesystem::path& folder);

/// Reads campaign.json and the tables. Throws FileError naming file and line.
CampaignData read_campaign_data(const std::filesystem::path& folder);

/// A quantity of a row that is looked at.
struct Quantity {
    const char* id;    ///< for the names of figures
    const char* name;  ///< HTML
    Markup symbol;
    const char* unit;
    double scale;  ///< from SI to the unit
    double triaxial::Row::*value;
};

inline constexpr Quantity quantities[] = {
    {"e50", "modulus <i>E</i><sub>50</sub>", "{/:Italic E}_{50}", "MPa", 1e-6, &triaxial::Row::E50},
    {"peak", "peak deviator stress Δ<i>σ</i><sub>f</sub>", "Δ{/:Italic σ}_f", "kPa", 1e-3,
     &triaxial::Row::peak_deviator_stress}};

/// Values of a quantity over the rows of a case, by realization [its unit].
std::vector<double> values_of(const CaseData& one, const Quantity& quantity);

}  // namespace grainfield::triaxial::report
