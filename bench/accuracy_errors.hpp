#pragma once
// What the runs of a setting say about its error: bias and scatter told apart.
//
// Results of a granular sample are chaotic: two runs that differ by 1e-12 m in the start positions
// end with peaks some per cent apart. So nothing is compared with a single run. The reference is
// the mean over an ensemble of disturbed runs with a quarter of the default step, real masses and
// double precision; its spread is the noise floor.

#include <span>
#include <string>
#include <vector>

#include "bench/accuracy_runs.hpp"

namespace grainfield::bench {

/// A result over several runs, in per cent of the reference.
struct Deviation {
    double bias = 0;     ///< mean of the runs less the reference [%]
    double scatter = 0;  ///< standard deviation of one run; 0 of a single run [%]
    double one_run = 0;  ///< root mean square deviation of a run from the reference [%]
    double largest = 0;  ///< of a run from the mean of these runs [%]
};

/// All repeats of one setting on one series, or several settings taken together.
struct Case {
    const Series* series = nullptr;
    Setting setting;
    std::vector<const Run*> runs;  ///< those that reached the end
    int failed = 0;                ///< those that did not [-]

    Deviation peak, E50;
    double curve_of_mean = 0;  ///< RMS distance of the mean curve from the reference's [% of peak]
    double curve_of_run = 0;   ///< the same of one run, root mean square [% of peak]
    double wall_seconds = 0;   ///< median of a run [s]
    double cpu_seconds = 0;    ///< median of a run [s]
};

/// The mean over an ensemble.
struct Reference {
    double peak = 0, E50 = 0;   ///< [Pa]
    std::vector<double> curve;  ///< [Pa]
};

/// Mean of runs that reached the end. There must be one.
Reference mean_of(std::span<const Run* const> runs);

/// Fills in what follows from the runs; a case without any stays as it is.
void evaluate(Case& c, const Reference& reference);

/// accuracy.csv: one row a case.
std::string cases_csv(std::span<const Case> cases);
/// accuracy_noise.csv: spread over runs that differ only by 1e-12 m in the start positions.
std::string noise_csv(std::span<const Case> ensembles);

}  // namespace grainfield::bench
