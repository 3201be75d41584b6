#pragma once
// Runs with checkpoints: their options, --resume, and the state of one that failed.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/monitor.hpp"
#include "core/solver_options.hpp"
#include "core/state/checkpoint.hpp"
#include "triaxial/cli/argument_parser.hpp"
#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

/// The options of a subcommand whose runs can be resumed.
struct CheckpointArguments {
    bool resume = false;
    double every = 60;  ///< between two checkpoints; 0: only when the run is interrupted [s]

    void add_to(ArgumentParser& command);
    /// With --resume the checkpoint that a run left in `file`; damaged ones are told to the
    /// monitor. Nothing where there is none: the run begins anew, and the monitor is told. Throws
    /// FileError where none of those that are there can be used.
    std::optional<core::FoundCheckpoint> find(const std::filesystem::path& file,
                                              core::Monitor& monitor) const;
    /// A run that begins: puts away what an earlier one left in `file`, and tells the monitor.
    static void begin_anew(const std::filesystem::path& file, core::Monitor& monitor);
};

/// Config of a run that resumes: that of the checkpoint; what the command line says must agree with
/// it. Throws InputError naming the first line of the resolved configs that differs.
Config resumed_config(const core::FoundCheckpoint& found, const std::optional<std::string>& file,
                      std::span<const std::string> settings);

/// What a checkpoint says of its run: the subcommand, the kernels, and what the subcommand adds.
nlohmann::json run_identity(const std::string& command, const core::SolverOptions& solver);
/// The checksum of a file that a run is made from, for its identity; empty where there is none, or
/// where it is a pipe.
std::string input_checksum(const std::filesystem::path& file);
/// Throws InputError where a file is not what it was when the run began: the identity of its
/// checkpoint has the file's checksum as `key`. A file that is gone may not be needed any more.
void check_input(const core::FoundCheckpoint& found, const char* key,
                 const std::filesystem::path& file);

/// Kernels as the run that is resumed had them. Throws InputError where this is another subcommand.
core::SolverOptions resumed_solver(const core::FoundCheckpoint& found, const std::string& command,
                                   core::SolverOptions solver);

/// Passes everything on to another monitor; when a simulation breaks, its state is written first.
/// What leaves run() names the file of the state, or the checkpoint to go on from.
class ResumableRun : public core::Monitor {
  public:
    /// Stages are called by their names behind `prefix`.
    ResumableRun(core::Monitor& inner, std::filesystem::path state,
                 const core::Checkpoint& checkpoint, std::string prefix = {})
        : inner_(inner),
          state_(std::move(state)),
          checkpoint_(checkpoint),
          prefix_(std::move(prefix)) {}

    void begin(std::string_view stage) override { inner_.begin(prefix_ + std::string(stage)); }
    void progress(double done, std::int64_t steps, std::string_view detail) override {
        inner_.progress(done, steps, detail);
    }
    void note(const std::string& line) override { inner_.note(line); }
    bool stop_requested() const override { return inner_.stop_requested(); }
    void ended_early(const core::Simulation& simulation) override;

    template <class Task>
    auto run(const Task& task) {
        try {
            return task();
        } catch (const SimulationError& error) {
            throw SimulationError(error.what() + failure_text());
        } catch (const Interrupted& error) {
            throw Interrupted(error.what() + interruption_text());
        }
    }

  private:
    std::string failure_text() const;
    std::string interruption_text() const;

    core::Monitor& inner_;
    std::filesystem::path state_;
    const core::Checkpoint& checkpoint_;
    std::string prefix_;
    bool state_written_ = false;
};

}  // namespace grainfield::triaxial
