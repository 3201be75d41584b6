#include "triaxial/campaign/run_job.hpp"

#include <chrono>
#include <mutex>

#include "core/base/errors.hpp"
#include "core/files/folder.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/realization/failure.hpp"
#include "triaxial/realization/run_files.hpp"
#include "triaxial/realization/sample.hpp"

namespace grainfield::triaxial {
namespace {

/// Shows nothing; keeps the state of a run that broke.
class RunMonitor : public core::Monitor {
  public:
    RunMonitor(const std::atomic<bool>& stop, const std::filesystem::path& state)
        : stop_(stop), state_(state) {}

    bool stop_requested() const override { return stop_; }
    void ended_early(const core::Simulation& simulation) override {
        if (stop_) return;
        static std::mutex one_at_a_time;  // HDF5 knows no threads
        const std::lock_guard lock(one_at_a_time);
        core::create_folder(state_.parent_path());
        write_state(state_, simulation);
    }

  private:
    const std::atomic<bool>& stop_;
    const std::filesystem::path& state_;
};

/// A realization that the property cannot have (one in a billion cells of an unbounded marginal) is
/// a failed run among others, not the end of the campaign.
void draw_field(const Config& config, std::int64_t realization, Sample& sample) {
    try {
        map_field(config, realization, sample);
    } catch (const InputError& error) {
        throw SimulationError(error.what());
    }
}

}  // namespace

Row run_job(const Job& job, const Starts& starts, const std::filesystem::path& failed_state,
            const std::atomic<bool>& stop) {
    const auto begin = std::chrono::steady_clock::now();
    RunMonitor monitor(stop, failed_state);
    const Config& config = job.inputs->config;
    Row row;
    try {
        Sample sample = starts.of(*job.start);
        draw_field(config, job.realization, sample);
        core::Simulation simulation =
            make_simulation(std::move(sample), config, core::choose_kernels(config.solver),
                            "the start of the campaign");
        const TestResult result = run_test(simulation, config, monitor);
        row.peak_deviator_stress = result.results.peak_deviator_stress;
        row.E50 = result.results.E50;
        row.friction_angle = result.results.friction_angle;
        row.axial_strain_at_peak = result.results.axial_strain_at_peak;
        row.steps = result.isotropic_steps + result.shear_steps;
        row.state_hash = simulation.state_hash();
        row.failure = failure_name(result.results.failure);
        row.end_reason = result.end_reason;
        row.warnings = result.warnings;
    } catch (const SimulationError& error) {
        row.failed = true;
        row.reason = error.what();
    }
    row.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return row;
}

}  // namespace grainfield::triaxial
