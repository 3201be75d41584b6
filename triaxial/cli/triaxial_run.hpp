#pragma once
// What a test of `triaxial` is made of, and the files it leaves: for one run and for repeats.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/base/stopwatch.hpp"
#include "core/files/sphere_file.hpp"
#include "core/state/bytes.hpp"
#include "core/state/checkpoint.hpp"
#include "triaxial/cli/command_line.hpp"
#include "triaxial/cli/resumable_run.hpp"
#include "triaxial/config/config.hpp"
#include "triaxial/realization/run_files.hpp"
#include "triaxial/realization/sample.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial {

struct TriaxialArguments {
    std::optional<std::string> config;
    std::optional<std::string> packing;
    std::optional<std::int64_t> realization;
    std::optional<std::int32_t> repeats;
    std::string out;
    CheckpointArguments checkpoints;
};

/// A run to begin or to go on with.
struct Run {
    Config config;
    std::string used;      ///< the config as resolved, before "auto" got its meaning
    std::string identity;  ///< for its checkpoints, JSON
    std::optional<core::FoundCheckpoint> found;
    std::optional<std::string> packing;
    std::optional<core::SphereFile> spheres;  ///< of the packing, where they have been read
    std::int64_t realization = 0;
    std::int32_t repeats = 0;  ///< 0: one run, not a series [-]
};

/// What was asked for, completed by the checkpoint where the run resumes. Throws InputError,
/// FileError.
Run prepare_run(const TriaxialArguments& arguments, const std::filesystem::path& checkpoint,
                Session& session);

/// What was done before the test.
struct Before {
    bool ready = false;  ///< the sample is made
    core::Stopwatch watch;
    RunTimes times;
    FieldRecord field;  ///< but for the field itself

    template <class Archive>
    void serialize(Archive& archive) {
        using core::bytes;
        archive(ready, watch, bytes(times), bytes(field.variable), field.realization, field.gamma,
                field.covariance_error, field.mean_ratio_expected, field.mean_ratio_cells);
    }
};

/// The sample that tests begin with, its field mapped; spheres that have been read are used up.
/// Makes the packing where none is given, in the folder `out`.
Sample make_sample(Run& run, Before& before, const std::filesystem::path& out,
                   core::Monitor& monitor, core::Checkpoint& checkpoint);

/// The simulation of a test on the sample, with the ledger.
core::Simulation simulation_of(Sample sample, const Run& run, const kernels::KernelTable& kernels);
/// One that a checkpoint is loaded into.
core::Simulation empty_simulation(const kernels::KernelTable& kernels);

/// packing.h5 and packing.json of a run's folder are this run's from here on, or gone.
void keep_own_packing(const Run& run, const std::filesystem::path& out);

/// Writes config.toml, curve.csv, energy.csv, state.h5 and, last, summary.json, which it returns.
nlohmann::json write_results(const std::filesystem::path& folder, const Run& run,
                             const TestResult& result, const FieldRecord& field,
                             const RunTimes& times, const core::Simulation& simulation,
                             int threads);

}  // namespace grainfield::triaxial
