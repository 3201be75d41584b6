#pragma once
// The finished tests of the study of strain rate and damping (bench/rate/run), read from their
// folders.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainfield::bench {

/// One test.
struct RateRun {
    double peak = 0;                              ///< largest deviator stress [Pa]
    double strain_at_peak = 0;                    ///< [-]
    double E50 = 0;                               ///< [Pa]
    double inertial_number = 0;                   ///< [-]
    double damping_share = 0;                     ///< of the dissipated energy, up to the peak [-]
    double kinetic_ratio = 0;                     ///< kinetic over elastic energy [-]
    double held = 0;                              ///< worst RMS error of the lateral stress [-]
    double isotropic_steps = 0, shear_steps = 0;  ///< [-]
    double spheres = 0;                           ///< [-]
    std::string failure;
};

/// The tests of one sample, damping and rate: starts 1e-12 m apart.
struct RateCell {
    double damping = 0;  ///< of forces and moments [-]
    double rate = 0;     ///< axial strain rate [1/s]
    std::vector<RateRun> runs;

    std::vector<double> values(double RateRun::*value) const;
    double mean(double RateRun::*value) const;
    /// Over n - 1; none of a single run.
    std::optional<double> deviation(double RateRun::*value) const;
    /// How many ended without a peak.
    std::size_t without_peak() const;
};

struct RateSample {
    std::string name, keys;        ///< and what differs from the default config
    std::vector<RateCell> cells;   ///< of the tests that have run
    std::vector<double> dampings;  ///< of these, in rising order [-]

    const RateCell* cell(double damping, double rate) const;
    /// Standard deviation of one run over its mean, pooled over all cells of more than one [-].
    double scatter(double RateRun::*value) const;
};

/// The rates of the study, in falling order [1/s].
inline const std::vector<double> study_rates{0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002};

/// The samples of `plan` of which tests have run in `runs`.
std::vector<RateSample> read_rate_runs(const std::filesystem::path& plan,
                                       const std::filesystem::path& runs);

}  // namespace grainfield::bench
