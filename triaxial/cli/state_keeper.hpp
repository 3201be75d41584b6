#pragma once
// Keeps the state of a simulation that ended early.

#include <filesystem>
#include <string>

#include "core/errors.hpp"
#include "core/monitor.hpp"

namespace grainfield::triaxial {

/// Passes everything on to another monitor; when a simulation breaks or is stopped, its state is
/// written first and the file named in a note.
class StateKeeper : public core::Monitor {
  public:
    StateKeeper(core::Monitor& inner, std::filesystem::path path)
        : inner_(inner), path_(std::move(path)) {}

    void begin(std::string_view stage) override { inner_.begin(stage); }
    void progress(double done, std::int64_t steps, std::string_view detail) override {
        inner_.progress(done, steps, detail);
    }
    void note(const std::string& line) override { inner_.note(line); }
    bool stop_requested() const override { return inner_.stop_requested(); }
    void ended_early(const core::Simulation& simulation) override;

    /// Calls the work; a SimulationError or Interrupted that leaves it names the file of the state.
    template <class Work>
    auto run(const Work& work);

  private:
    core::Monitor& inner_;
    std::filesystem::path path_;
    bool kept_ = false;
};

template <class Work>
auto StateKeeper::run(const Work& work) {
    const auto where = [this](const char* what) {
        return kept_ ? std::string(what) + "; the state is in " + path_.string()
                     : std::string(what);
    };
    try {
        return work();
    } catch (const SimulationError& error) {
        throw SimulationError(where(error.what()));
    } catch (const Interrupted& error) {
        throw Interrupted(where(error.what()));
    }
}

}  // namespace grainfield::triaxial
