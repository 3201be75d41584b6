#pragma once
// What a series of repeats left in its folder: the results of each, and what they scatter by.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "triaxial/report/curve_file.hpp"
#include "triaxial/report/run_folder.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::report {

/// One finished test of the series.
struct Repeat {
    KeyResults results;
    std::string end_reason;  ///< of failure_name(), or ended_as_asked
    std::int64_t steps = 0;  ///< isotropic stage and shear [-]
    std::string state_hash;
    Curve curve;
};

struct RepeatsData {
    std::filesystem::path path;
    std::vector<Repeat> repeats;
    std::size_t without_peak = 0;  ///< of the repeats: ended before a peak or plateau [-]
    std::string case_words;        ///< case_in_words()
    std::string config;            ///< config.toml of the first as it stands
};

/// True if the folder is that of a finished series.
bool is_series(const std::filesystem::path& folder);

/// Reads `count` repeats, two at least. Throws FileError naming the file that is missing or
/// corrupt.
RepeatsData read_repeats(const std::filesystem::path& folder, std::size_t count);
/// The same of a finished series, whose repeats.json tells the count.
RepeatsData read_repeats(const std::filesystem::path& folder);

/// A result of which it is told what it scatters by.
struct RepeatedQuantity {
    const char* key;   ///< in files, with the SI unit
    const char* name;  ///< HTML
    const char* word;  ///< on screen
    const char* unit;  ///< on page and screen
    double scale;      ///< from SI to the unit
    double KeyResults::*value;
};
inline constexpr RepeatedQuantity repeated_quantities[] = {
    {"peak_deviator_stress_Pa", "largest deviator stress <i>q</i>", "largest deviator stress",
     "kPa", 1e-3, &KeyResults::peak_deviator_stress},
    {"E50_Pa", "modulus <i>E</i><sub>50</sub>", "E50", "MPa", 1e-6, &KeyResults::E50},
    {"friction_angle_rad", "friction angle φ", "friction angle", "degrees", 57.29577951308232,
     &KeyResults::friction_angle},
    {"axial_strain_at_peak", "axial strain at the largest <i>q</i>", "axial strain there", "%", 100,
     &KeyResults::axial_strain_at_peak}};

/// Mean and scatter with 95 % intervals: Student's t for the mean, chi-square for the deviation,
/// both exact for normal values. The interval of the coefficient of variation is that of the
/// deviation over the mean.
struct Scatter {
    double mean = 0;                          ///< [as the values]
    double deviation = 0;                     ///< over n - 1 [as the values]
    double variation = 0;                     ///< deviation over mean [-]
    statistics::Interval mean_interval;       ///< [as the values]
    statistics::Interval deviation_interval;  ///< [as the values]
    statistics::Interval variation_interval;  ///< [-]
};
/// In SI units. Two repeats at least.
Scatter scatter_of(const RepeatsData& data, const RepeatedQuantity& quantity);

/// repeats.csv: a row a repeat, with header.
std::string repeats_csv(const RepeatsData& data);
/// repeats.json: the scatter of every quantity in SI units.
nlohmann::json repeats_json(const RepeatsData& data);

}  // namespace grainfield::triaxial::report
