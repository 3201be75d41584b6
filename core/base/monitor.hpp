#pragma once
// How long work tells what it is doing. Core prints nothing; whoever runs it may.

#include <cstdint>
#include <string>
#include <string_view>

namespace grainfield::core {

class Simulation;

class Monitor {
  public:
    virtual ~Monitor() = default;
    /// A stage of the work begins, e.g. "settling".
    virtual void begin(std::string_view /*stage*/) {}
    /// Called now and then. `done` is the share of the stage in [0, 1], negative where it cannot be
    /// known; `steps` so far, negative where steps are not what counts; `detail` a few figures for
    /// the screen.
    virtual void progress(double /*done*/, std::int64_t /*steps*/, std::string_view /*detail*/) {}
    /// A line worth keeping, e.g. a figure chosen by the program.
    virtual void note(const std::string& /*line*/) {}
    /// The simulation broke (it is about to throw SimulationError) or was stopped: the state may be
    /// worth keeping.
    virtual void ended_early(const Simulation& /*simulation*/) {}
    /// True once the user asked to stop; the work then throws Interrupted at a safe place.
    virtual bool stop_requested() const { return false; }
};

}  // namespace grainfield::core
