#pragma once
// Triaxial tests of one small sample under many settings of the solver, one thread each.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/monitor.hpp"
#include "triaxial/realization/sample.hpp"

namespace grainfield::bench {

/// What is varied: the kernels and the settings that trade error for time.
struct Setting {
    bool reference_kernels = false;  ///< scalar loops in double precision, whatever `precision`
    core::Precision precision = core::Precision::mixed;
    double safety = 0.8;        ///< share of the stability limit [-]
    double mass_scaling = 1.0;  ///< [-]

    bool operator==(const Setting&) const = default;
    core::SolverOptions solver() const;
};

/// The default of the program, which users get.
inline constexpr Setting default_setting;

/// A sample with its properties, which all runs of a series start from.
struct Series {
    std::string name;
    triaxial::Config config;
    triaxial::Sample sample;
    double stiffness_contrast = 1;  ///< largest k_n of a sphere over the smallest [-]
    double work = 1;  ///< expected, of a test with the default setting, in that of "uniform" [-]
};

/// Strains at which curves are compared: `strain_points` of them, evenly spaced up to the end.
inline constexpr std::size_t strain_points = 300;

struct Run {
    std::string failure;        ///< why the run ended early; empty: it did not
    std::vector<double> curve;  ///< deviator stress at the strains of comparison [Pa]
    double peak = 0;            ///< [Pa]
    double peak_strain = 0;     ///< [-]
    double E50 = 0;             ///< [Pa]
    double wall_seconds = 0;    ///< of both stages [s]
    double cpu_seconds = 0;     ///< of the one thread that ran them [s]
    std::int64_t isotropic_steps = 0, shear_steps = 0;  ///< [-]
    double mean_step = 0;                               ///< of the shear stage [s]
    double inertia_ratio = 1;                           ///< [-]
    double inertial_number = 0;                         ///< [-]
    double lateral_rms_error = 0;                       ///< of the servos [-]
};

/// One test to be made: repeats of a setting differ by 1e-12 m in the start positions. Repeat 0 is
/// not disturbed.
struct Task {
    const Series* series = nullptr;
    Setting setting;
    int repeat = 0;
    Run run;  ///< filled by make_runs()
};

/// The series "uniform", Tran et al.'s case with k_n the same everywhere, and "contrast", k_n of
/// each block lognormal with COV 2. Shear ends at `last_strain` [-]. The packing is read from
/// `packing`, or made and left there.
std::vector<Series> make_series(const std::filesystem::path& packing, double last_strain,
                                core::Monitor& monitor);

/// Fills the runs of all tasks, `workers` at a time, one thread each; the monitor hears of
/// progress from several threads, one at a time. Throws what a test throws, but for a simulation
/// that broke: that is a result.
void make_runs(std::vector<Task>& tasks, int workers, core::Monitor& monitor);

}  // namespace grainfield::bench
