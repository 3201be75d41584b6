#include "core/drive/driver.hpp"

#include <fmt/format.h>

#include "core/drive/measures.hpp"
#include "core/state/section_of.hpp"

namespace grainfield::core {

Driver::Driver(Simulation& simulation, const TimeOptions& time, Monitor& monitor,
               Checkpoint* checkpoint)
    : simulation_(simulation),
      control_(time),
      monitor_(monitor),
      checkpoint_(checkpoint),
      section_(
          checkpoint, "simulation",
          [this](StateWriter& archive) {
              simulation_.save(archive);
              archive(control_, next_energy_);
          },
          [this](StateReader& archive) {
              simulation_.load(archive);
              archive(control_, next_energy_);
          }) {}

void Driver::check_kinetic_energy() {
    next_kinetic_ = simulation_.steps() + energy_interval;
    const double kinetic = kinetic_energy(simulation_);
    if (kinetic <= *most_kinetic_) return;
    const Vec3Column& velocity = simulation_.spheres().velocity;
    std::size_t fastest = 0;
    for (std::size_t i = 1; i < velocity.size(); ++i)
        if (velocity[i].squaredNorm() > velocity[fastest].squaredNorm()) fastest = i;
    const Vec3 x = simulation_.spheres().position[fastest];
    throw SimulationError(fmt::format(
        "unstable: the kinetic energy is {:.3g} J, more than {:.3g} J (fastest sphere {} at {:.3g} "
        "m/s, step {}, time {:g} s, at ({:g}, {:g}, {:g}) m)",
        kinetic, *most_kinetic_, fastest, velocity[fastest].norm(), simulation_.steps(),
        simulation_.time(), x.x(), x.y(), x.z()));
}

void Driver::say_exceeded() {
    said_ = true;
    monitor_.note("warning: " + control_.exceeded_text());
}

/// A broken state must not take the place of a good one.
void Driver::check_before_save() {
    try {
        watch();
    } catch (const SimulationError&) {
        monitor_.ended_early(simulation_);
        throw;
    }
}

void Driver::stop() {
    check_before_save();
    if (checkpoint_ != nullptr) checkpoint_->save();
    throw Interrupted("stopped by the user");
}

void Driver::save() {
    check_before_save();
    try {
        checkpoint_->save();
    } catch (const FileError& error) {
        monitor_.note(fmt::format("no checkpoint this time, the run goes on: {}", error.what()));
    }
}

}  // namespace grainfield::core
