#pragma once
// One step of a driven simulation: forces, step length, steering, motion, the watch, and the
// checkpoints between steps.

#include <optional>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/monitor.hpp"
#include "core/drive/step_control.hpp"
#include "core/simulation.hpp"
#include "core/state/checkpoint.hpp"

namespace grainfield::core {

class Driver {
  public:
    /// How often the state is checked for NaN, lost spheres and the like, in steps.
    static constexpr std::int64_t watch_interval = 50;

    /// With a checkpoint, the simulation and what is known of its step are part of it; a run that
    /// resumes finds both as they were.
    Driver(Simulation& simulation, const TimeOptions& time, Monitor& monitor,
           Checkpoint* checkpoint = nullptr);

    /// One step; tells the monitor before an error or an interruption leaves it. steer(step) is
    /// called with wall loads current and may set wall velocities. With `look` it is called before
    /// anything moves and sees all of the state, sums over contacts too, and may change what it
    /// likes; without, spheres may already have moved.
    template <class Steer>
    void step(bool look, const Steer& steer) {
        try {
            if (look || control_.due(simulation_)) {
                simulation_.compute_forces(look);
                if (look && energies_ && simulation_.steps() >= next_energy_) log_energy();
                if (look && most_kinetic_ && simulation_.steps() >= next_kinetic_)
                    check_kinetic_energy();
                const double step = control_.next(simulation_);
                steer(step);
                simulation_.advance(step);
            } else {
                const double step = control_.next(simulation_);
                simulation_.step(step, [&] { steer(step); });
            }
            if (simulation_.steps() % watch_interval == 0 || simulation_.health().alarmed())
                watch();
        } catch (const SimulationError& error) {
            fail(error.what());
        }
        if (!said_ && control_.exceeded_limit() > 0) say_exceeded();
    }

    /// To be called between steps, where all state of the work is in its sections of the
    /// checkpoint: saves if it is time to. If the user asked to stop, saves (where there is a
    /// checkpoint) and throws Interrupted. A save that fails while the run goes on is told to the
    /// monitor.
    void safe_point() {
        if (monitor_.stop_requested()) stop();
        if (checkpoint_ != nullptr && checkpoint_->due()) save();
    }

    /// From now on the kinetic energy must not exceed this [J]; looked at every 200 steps or so, at
    /// steps that look. A sample whose step is too long for it heats up even where no single sphere
    /// moves far. SimulationError names the fastest sphere.
    void limit_kinetic_energy(double most) { most_kinetic_ = most; }

    /// Adds the simulation's ledger to `rows` about every 200 steps, at steps that look, and
    /// whenever log_energy() is called; forces and sums must be current then.
    void log_energies_to(std::vector<EnergyRow>& rows) { energies_ = &rows; }
    void log_energy() {
        energies_->push_back({simulation_.time(), simulation_.energy()});
        next_energy_ = simulation_.steps() + energy_interval;
    }

    /// Throws SimulationError if the state is broken.
    void watch() { simulation_.health().check(); }

    /// Ends a run that cannot reach what it should; the monitor hears of it first. A fixed step
    /// above the stability limit is named as well.
    [[noreturn]] void fail(const std::string& what) {
        monitor_.ended_early(simulation_);
        const std::string step = control_.exceeded_text();
        throw SimulationError(step.empty() ? what : what + "; " + step);
    }

    Simulation& simulation() { return simulation_; }
    StepControl& control() { return control_; }
    const StepControl& control() const { return control_; }
    Monitor& monitor() { return monitor_; }
    Checkpoint* checkpoint() { return checkpoint_; }

  private:
    void check_kinetic_energy();
    void say_exceeded();
    void check_before_save();
    [[noreturn]] void stop();
    void save();

    Simulation& simulation_;
    StepControl control_;
    Monitor& monitor_;
    Checkpoint* checkpoint_;
    static constexpr std::int64_t energy_interval = 200;  // [steps]
    std::vector<EnergyRow>* energies_ = nullptr;
    std::int64_t next_energy_ = 0;
    bool said_ = false;                   // that the step is above the limit
    std::optional<double> most_kinetic_;  // [J]
    std::int64_t next_kinetic_ = 0;
    Checkpoint::Section section_;  // last: it loads what stands above
};

}  // namespace grainfield::core
