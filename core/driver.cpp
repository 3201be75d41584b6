#include "core/driver.hpp"

#include <fmt/format.h>

#include "core/state/part_of.hpp"

namespace grainfield::core {

Driver::Driver(Simulation& simulation, const TimeOptions& time, Monitor& monitor,
               Checkpoint* checkpoint)
    : simulation_(simulation),
      control_(time),
      monitor_(monitor),
      checkpoint_(checkpoint),
      part_(
          checkpoint, "simulation",
          [this](StateWriter& archive) {
              simulation_.save(archive);
              archive(control_, next_energy_);
          },
          [this](StateReader& archive) {
              simulation_.load(archive);
              archive(control_, next_energy_);
          }) {}

void Driver::stop() {
    if (checkpoint_ != nullptr) checkpoint_->save();
    throw Interrupted("stopped by the user");
}

void Driver::save() {
    try {
        checkpoint_->save();
    } catch (const FileError& error) {
        monitor_.note(fmt::format("no checkpoint this time, the run goes on: {}", error.what()));
    }
}

}  // namespace grainfield::core
