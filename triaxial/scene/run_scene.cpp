#include "triaxial/scene/run_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/base/stopwatch.hpp"
#include "core/drive/driver.hpp"
#include "core/kernel_choice.hpp"
#include "core/state/section_of.hpp"
#include "triaxial/realization/given_packing.hpp"
#include "triaxial/scene/scene_output.hpp"
#include "triaxial/scene/scene_setup.hpp"

namespace grainfield::triaxial {
namespace {

/// round(end/step), or nothing where the step is automatic [-].
std::optional<std::int64_t> fixed_steps(const SceneFile& file, const std::string& source) {
    if (!file.step) return std::nullopt;
    const double steps = std::round(file.end / *file.step);
    if (!(steps >= 1 && steps <= 1e15))
        throw InputError(
            fmt::format("{}: time.end = {}: is {} steps of time.step = {} s; must be 1 "
                        "to 1e15 steps",
                        source, file.end, steps, *file.step));
    return static_cast<std::int64_t>(steps);
}

constexpr double report_interval = 0.1;   // [s]
constexpr double most_open_energy = 0.1;  // a step below the limit stays well below [-]

class SceneRun {
  public:
    SceneRun(const SceneFile& file, const std::string& source, core::Simulation& simulation,
             SceneOutput& output, core::Monitor& monitor, core::Checkpoint* checkpoint)
        : file_(file),
          fixed_steps_(fixed_steps(file, source)),
          simulation_(simulation),
          output_(output),
          monitor_(monitor),
          driver_(simulation, {file.step, file.safety, file.mass_scaling}, monitor, checkpoint),
          servos_(set_up_servos(file, simulation.scene(), source)),
          section_(
              checkpoint, "scene",
              [this](core::StateWriter& archive) {
                  archive_state(archive);
                  output_.save(archive);
              },
              [this](core::StateReader& archive) {
                  archive_state(archive);
                  output_.load(archive);
              }) {}

    void run() {
        report();
        bool last = false;
        while (!last) {
            driver_.safe_point();
            simulation_.compute_forces(true);
            double step = driver_.control().next(simulation_);
            if (fixed_steps_) {
                last = simulation_.steps() + 1 >= *fixed_steps_;
            } else if (file_.end - simulation_.time() <= (1 + 1e-9) * step) {
                step = file_.end - simulation_.time();
                last = true;
            }
            write_if_due(step);
            for (ServoWall& s : servos_)
                s.servo.steer(simulation_, s.area(simulation_.walls()), step);
            simulation_.advance(step);
            if (simulation_.steps() % core::Driver::watch_interval == 0 ||
                simulation_.health().alarmed())
                driver_.watch();
            if (reported_.seconds() > report_interval) report();
        }
        report();
        simulation_.compute_forces(true);
        simulation_.health().check();
        output_.add(simulation_, time());
    }

    /// Free of the sum's round-off where the step is fixed [s].
    double time() const {
        if (!fixed_steps_) return simulation_.time();
        return static_cast<double>(simulation_.steps()) * *file_.step;
    }

    double wall_seconds() const { return watch_.seconds(); }
    /// Nothing where the fixed step was never above the stability limit, or there is none.
    std::string step_warning() const { return driver_.control().exceeded_text(); }

  private:
    template <class Archive>
    void archive_state(Archive& archive) {
        archive(next_output_, watch_);
        for (ServoWall& wall : servos_) archive(wall.servo);
    }
    void write_if_due(double step) {
        // A step may miss a multiple of the interval by round-off.
        const double reached = (time() + 1e-6 * step) / file_.output_interval;
        if (reached < next_output_) return;
        output_.add(simulation_, time());
        next_output_ = std::floor(reached) + 1;
    }

    /// To the monitor, which shows what it wants of it.
    void report() {
        reported_.lap();
        monitor_.progress(
            time() / file_.end, simulation_.steps(),
            fmt::format("t {:.4g} s, {} contacts", time(), simulation_.contacts().count()));
    }

    const SceneFile& file_;
    std::optional<std::int64_t> fixed_steps_;
    core::Simulation& simulation_;
    SceneOutput& output_;
    core::Monitor& monitor_;
    core::Driver driver_;
    std::vector<ServoWall> servos_;
    double next_output_ = 0;  // in units of the interval [-]
    core::Stopwatch reported_, watch_;
    core::Checkpoint::Section section_;  // last: it loads what stands above
};

}  // namespace

SceneSummary run_scene(const SceneFile& file, const std::filesystem::path& source,
                       const std::filesystem::path& out, int threads, core::Monitor& monitor,
                       core::Checkpoint* checkpoint) {
    const kernels::KernelTable& kernels = core::choose_kernels(file.solver);
    monitor.begin("reading the scene");
    core::SimulationOptions options;
    options.ledger = true;
    const bool resumes = checkpoint != nullptr && checkpoint->resuming();
    core::Simulation simulation(resumes ? core::Scene{} : set_up_scene(file, &monitor), kernels,
                                options);
    SceneOutput output(out, !resumes);
    SceneRun run(file, source.string(), simulation, output, monitor, checkpoint);

    monitor.begin("simulating");
    try {
        run.run();
    } catch (const SimulationError& error) {
        const auto saved = save_state(simulation, out);
        const std::string step = run.step_warning();
        throw SimulationError(fmt::format("{}{}{}; the state is saved in {}", error.what(),
                                          step.empty() ? "" : "; ", step, saved.string()));
    } catch (const Interrupted& error) {
        throw Interrupted(fmt::format("{} at time {:g} s", error.what(), run.time()));
    }
    SceneSummary summary;
    summary.particles = simulation.spheres().size();
    summary.walls = simulation.walls().size();
    summary.contacts = simulation.contacts().count();
    summary.density = density_text(simulation.spheres());
    summary.steps = simulation.steps();
    summary.time = run.time();
    summary.time_step = file.step ? *file.step : summary.time / double(summary.steps);
    if (const std::string warning = run.step_warning(); !warning.empty())
        summary.warnings.push_back(warning);
    summary.energy_closing_error = output.energy_closing_error();
    if (summary.energy_closing_error > most_open_energy)
        summary.warnings.push_back(
            fmt::format("the energies close only to {:.2g} % of the largest: the time step is too "
                        "long for the contacts that there were",
                        100 * summary.energy_closing_error));
    summary.wall_seconds = run.wall_seconds();
    summary.particle_steps_per_second =
        double(summary.particles) * double(summary.steps) / summary.wall_seconds;
    summary.state_hash = simulation.state_hash();
    summary.isa = kernels::name(kernels.isa);
    summary.precision = kernels.precision;
    summary.threads = threads;
    output.finish(simulation, summary);
    return summary;
}

}  // namespace grainfield::triaxial
