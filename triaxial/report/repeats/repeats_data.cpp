#include "triaxial/report/repeats/repeats_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/realization/repeated_start.hpp"
#include "triaxial/report/json_file.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial::report {

namespace fs = std::filesystem;

bool is_series(const fs::path& folder) {
    return fs::exists(folder / "repeats.json");
}

RepeatsData read_repeats(const fs::path& folder, std::size_t count) {
    RepeatsData data{.path = folder,
                     .repeats = {},
                     .without_peak = 0,
                     .case_words = {},
                     .config = core::read_whole_file(repeat_folder(folder, 0) / "config.toml")};
    for (std::size_t k = 0; k < count; ++k) {
        const JsonFile summary(repeat_folder(folder, k) / "summary.json");
        if (k == 0) data.case_words = case_in_words(summary);
        data.repeats.push_back({.results = results_of(summary),
                                .end_reason = summary.optional_text("end_reason").value_or(""),
                                .steps = std::llround(summary.number("steps")),
                                .state_hash = summary.optional_text("state_hash").value_or(""),
                                .curve = read_curve(repeat_folder(folder, k) / "curve.csv")});
        if (data.repeats.back().results.failure == Failure::strain_limit) ++data.without_peak;
    }
    return data;
}

RepeatsData read_repeats(const fs::path& folder) {
    const JsonFile file(folder / "repeats.json");
    const double count = file.number("repeats");
    if (!(count >= 2) || count != std::floor(count))
        throw FileError(fmt::format("{}: key 'repeats' must be a whole number >= 2, is {}",
                                    file.path().string(), count));
    return read_repeats(folder, static_cast<std::size_t>(count));
}

Scatter scatter_of(const RepeatsData& data, const RepeatedQuantity& quantity) {
    std::vector<double> values;
    for (const Repeat& repeat : data.repeats) values.push_back(repeat.results.*quantity.value);
    Scatter s{.mean = *statistics::mean(values),
              .deviation = *statistics::standard_deviation(values),
              .variation = *statistics::coefficient_of_variation(values),
              .mean_interval = *statistics::interval_of_mean(values),
              .deviation_interval = *statistics::chi_square_interval_of_deviation(values),
              .variation_interval = {}};
    s.variation_interval = {s.deviation_interval.lower / s.mean,
                            s.deviation_interval.upper / s.mean};
    return s;
}

std::string repeats_csv(const RepeatsData& data) {
    std::string text =
        "repeat,peak_deviator_stress_Pa,E50_Pa,friction_angle_rad,axial_strain_at_peak,failure,"
        "end_reason,steps,state_hash\n";
    for (std::size_t k = 0; k < data.repeats.size(); ++k) {
        const Repeat& r = data.repeats[k];
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", k,
                       r.results.peak_deviator_stress, r.results.E50, r.results.friction_angle,
                       r.results.axial_strain_at_peak, failure_name(r.results.failure),
                       r.end_reason, r.steps, r.state_hash);
    }
    return text;
}

nlohmann::json repeats_json(const RepeatsData& data) {
    nlohmann::json json = {{"repeats", data.repeats.size()},
                           {"start_spread_m", start_spread},
                           {"without_peak", data.without_peak},
                           {"version", GRAINFIELD_VERSION}};
    for (const RepeatedQuantity& quantity : repeated_quantities) {
        const Scatter s = scatter_of(data, quantity);
        json[quantity.key] = {{"mean", s.mean},
                              {"mean_low", s.mean_interval.lower},
                              {"mean_high", s.mean_interval.upper},
                              {"deviation", s.deviation},
                              {"deviation_low", s.deviation_interval.lower},
                              {"deviation_high", s.deviation_interval.upper},
                              {"cov", s.variation},
                              {"cov_low", s.variation_interval.lower},
                              {"cov_high", s.variation_interval.upper}};
    }
    return json;
}

}  // namespace grainfield::triaxial::report
