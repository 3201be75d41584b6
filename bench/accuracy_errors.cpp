#include "bench/accuracy_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/statistics.hpp"
#include "core/kernel_choice.hpp"

namespace grainfield::bench {
namespace {

template <class Value>
double mean(std::span<const Run* const> runs, const Value& value) {
    double sum = 0;
    for (const Run* run : runs) sum += value(*run);
    return sum / static_cast<double>(runs.size());
}

template <class Value>
double median_of(std::span<const Run* const> runs, const Value& value) {
    std::vector<double> values;
    for (const Run* run : runs) values.push_back(value(*run));
    return median(std::move(values));
}

template <class Value>
Deviation deviation(std::span<const Run* const> runs, const Value& value, double reference) {
    const double middle = mean(runs, value);
    Deviation d;
    d.bias = 100 * (middle / reference - 1);
    double squares = 0;
    for (const Run* run : runs) {
        const double away = 100 * (value(*run) - middle) / reference;
        squares += away * away;
        d.largest = std::max(d.largest, std::abs(away));
    }
    const auto n = static_cast<double>(runs.size());
    if (n > 1) d.scatter = std::sqrt(squares / (n - 1));
    d.one_run = std::sqrt(d.bias * d.bias + squares / n);
    return d;
}

double rms_distance(const std::vector<double>& a, const std::vector<double>& b) {
    double squares = 0;
    for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(squares / static_cast<double>(a.size()));
}

std::string kernels_columns(const Setting& setting) {
    const kernels::KernelTable& table = core::choose_kernels(setting.solver());
    return fmt::format("{},{}", kernels::name(table.isa), table.precision);
}

std::string deviation_columns(const Deviation& d) {
    return fmt::format("{:.3f},{:.3f},{:.3f}", d.bias, d.scatter, d.one_run);
}

}  // namespace

Reference mean_of(std::span<const Run* const> runs) {
    Reference r;
    r.peak = mean(runs, [](const Run& run) { return run.peak; });
    r.E50 = mean(runs, [](const Run& run) { return run.E50; });
    r.curve.resize(strain_points);
    for (std::size_t k = 0; k < strain_points; ++k)
        r.curve[k] = mean(runs, [&](const Run& run) { return run.curve[k]; });
    return r;
}

void evaluate(Case& c, const Reference& reference) {
    if (c.runs.empty()) return;
    c.peak = deviation(
        c.runs, [](const Run& run) { return run.peak; }, reference.peak);
    c.E50 = deviation(
        c.runs, [](const Run& run) { return run.E50; }, reference.E50);
    c.curve_of_mean = 100 * rms_distance(mean_of(c.runs).curve, reference.curve) / reference.peak;
    c.curve_of_run = 100 / reference.peak * std::sqrt(mean(c.runs, [&](const Run& run) {
                         const double distance = rms_distance(run.curve, reference.curve);
                         return distance * distance;
                     }));
    c.wall_seconds = median_of(c.runs, [](const Run& run) { return run.wall_seconds; });
    c.cpu_seconds = median_of(c.runs, [](const Run& run) { return run.cpu_seconds; });
}

std::string cases_csv(std::span<const Case> cases) {
    std::string rows =
        "series,isa,precision,safety,mass_scaling,repeats,failed,threads,"
        "wall_s,cpu_s,isotropic_steps,shear_steps,mean_step_s,inertia_ratio,inertial_number,"
        "lateral_rms_error,peak_Pa,peak_bias_percent,peak_scatter_percent,peak_one_run_percent,"
        "E50_Pa,E50_bias_percent,E50_scatter_percent,E50_one_run_percent,"
        "curve_of_mean_percent,curve_of_run_percent\n";
    for (const Case& c : cases) {
        const Setting& s = c.setting;
        rows += fmt::format("{},{},{},{},{},{},1,", c.series->name, kernels_columns(s), s.safety,
                            s.mass_scaling, c.runs.size(), c.failed);
        if (c.runs.empty()) {
            rows += std::string(17, ',') + "\n";
            continue;
        }
        const auto of = [&](const auto& member) {
            return mean(c.runs, [&](const Run& run) { return double(run.*member); });
        };
        rows += fmt::format(
            "{:.3f},{:.3f},{:.0f},{:.0f},{:.4g},{:.4f},{:.4g},{:.5f},{:.5g},{},{:.5g},{},{:.3f},"
            "{:.3f}\n",
            c.wall_seconds, c.cpu_seconds, of(&Run::isotropic_steps), of(&Run::shear_steps),
            of(&Run::mean_step), of(&Run::inertia_ratio), of(&Run::inertial_number),
            of(&Run::lateral_rms_error), of(&Run::peak), deviation_columns(c.peak), of(&Run::E50),
            deviation_columns(c.E50), c.curve_of_mean, c.curve_of_run);
    }
    return rows;
}

std::string noise_csv(std::span<const Case> ensembles) {
    std::string rows =
        "series,isa,precision,safety,mass_scaling,runs,peak_Pa,"
        "peak_scatter_percent,peak_largest_percent,E50_Pa,E50_scatter_percent,"
        "E50_largest_percent,curve_of_run_percent\n";
    for (const Case& c : ensembles) {
        const Reference middle = mean_of(c.runs);
        Case own = c;  // against its own mean
        evaluate(own, middle);
        rows += fmt::format("{},{},{},{},{},{:.5g},{:.3f},{:.3f},{:.5g},{:.3f},{:.3f},{:.3f}\n",
                            c.series->name, kernels_columns(c.setting), c.setting.safety,
                            c.setting.mass_scaling, c.runs.size(), middle.peak, own.peak.scatter,
                            own.peak.largest, middle.E50, own.E50.scatter, own.E50.largest,
                            own.curve_of_run);
    }
    return rows;
}

}  // namespace grainfield::bench
