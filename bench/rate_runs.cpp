#include "bench/rate_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/files/text_file.hpp"
#include "triaxial/report/json_file.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::bench {
namespace {

namespace fs = std::filesystem;

const std::vector<double> study_dampings{0.05, 0.2, 0.5, 0.8};

RateRun read_run(const fs::path& folder) {
    const triaxial::report::JsonFile summary(folder / "summary.json");
    return {.peak = summary.number("peak_deviator_stress_Pa"),
            .strain_at_peak = summary.number("axial_strain_at_peak"),
            .E50 = summary.number("E50_Pa"),
            .inertial_number = summary.number("inertial_number"),
            .damping_share = summary.number("damping_share"),
            .kinetic_ratio = summary.number("kinetic_over_elastic_energy"),
            .held = std::max(summary.number("lateral_stress_rms_error_to_E50"),
                             summary.number("lateral_stress_rms_error_to_peak")),
            .isotropic_steps = summary.number("isotropic_steps"),
            .shear_steps = summary.number("shear_steps"),
            .spheres = summary.number("particles"),
            .failure = summary.optional_text("failure").value_or("")};
}

/// A single test, or a series of repeats.
std::vector<RateRun> read_runs(const fs::path& folder) {
    std::vector<RateRun> runs;
    if (!fs::exists(folder / "report.html")) return runs;  // not finished
    if (fs::exists(folder / "summary.json")) {
        runs.push_back(read_run(folder));
        return runs;
    }
    for (int k = 0; fs::exists(folder / fmt::format("repeat{}", k) / "summary.json"); ++k)
        runs.push_back(read_run(folder / fmt::format("repeat{}", k)));
    return runs;
}

}  // namespace

std::vector<double> RateCell::values(double RateRun::*value) const {
    std::vector<double> all;
    for (const RateRun& run : runs) all.push_back(run.*value);
    return all;
}

double RateCell::mean(double RateRun::*value) const {
    return *triaxial::statistics::mean(values(value));
}

std::optional<double> RateCell::deviation(double RateRun::*value) const {
    return triaxial::statistics::standard_deviation(values(value));
}

std::size_t RateCell::without_peak() const {
    return static_cast<std::size_t>(
        std::ranges::count(runs, std::string("strain-limit"), &RateRun::failure));
}

const RateCell* RateSample::cell(double damping, double rate) const {
    for (const RateCell& c : cells)
        if (c.damping == damping && c.rate == rate) return &c;
    return nullptr;
}

double RateSample::scatter(double RateRun::*value) const {
    double squares = 0, freedom = 0;
    for (const RateCell& c : cells)
        if (const auto deviation = c.deviation(value)) {
            const double share = *deviation / c.mean(value);
            const auto free = static_cast<double>(c.runs.size() - 1);
            squares += free * share * share;
            freedom += free;
        }
    return freedom > 0 ? std::sqrt(squares / freedom) : 0.0;
}

std::vector<RateSample> read_rate_runs(const fs::path& plan, const fs::path& runs) {
    std::vector<RateSample> samples;
    const std::string text = core::read_whole_file(plan);
    core::LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
        if (line.starts_with('#')) continue;
        RateSample sample;
        sample.name = core::next_field(line, ' ');
        sample.keys = line;
        for (const double damping : study_dampings)
            for (const double rate : study_rates) {
                RateCell cell{
                    .damping = damping,
                    .rate = rate,
                    .runs = read_runs(runs / fmt::format("{}-{}-{}", sample.name, damping, rate))};
                if (!cell.runs.empty()) sample.cells.push_back(std::move(cell));
            }
        // A power law needs three rates.
        for (const double damping : study_dampings)
            if (std::ranges::count(sample.cells, damping, &RateCell::damping) >= 3)
                sample.dampings.push_back(damping);
        if (!sample.dampings.empty()) samples.push_back(std::move(sample));
    }
    return samples;
}

}  // namespace grainfield::bench
