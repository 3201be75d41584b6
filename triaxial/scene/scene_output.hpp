#pragma once
// The files of a scene's run (docs/interface.md, "Files").

#include <filesystem>
#include <optional>
#include <string>

#include "core/simulation.hpp"
#include "triaxial/scene/csv_stream.hpp"
#include "triaxial/scene/run_scene.hpp"

namespace grainfield::triaxial {

/// trajectory.csv and energy.csv, row by row as the run goes on.
///
/// Velocities and spins are those at the time of the positions. The eight energies of a row add up
/// to a constant: kinetic, rotational, elastic and potential (gravity_J, -m g.x) of the moment, the
/// works of friction and damping dissipated since the start, and external_work_J, minus the work
/// that moving walls have put in since the start.
class SceneOutput {
  public:
    /// Makes the folder where it is missing, and begins the tables unless load() will find them as
    /// a checkpoint knows them. FileError.
    SceneOutput(const std::filesystem::path& folder, bool begins);

    /// For checkpoints: the rows so far go to the disk; or the tables are those of then.
    void save(core::StateWriter& archive);
    void load(core::StateReader& archive);

    /// Adds the present state at `time` [s]; compute_forces(true) must have been called.
    void add(const core::Simulation& simulation, double time);

    double energy_closing_error() const { return closing_.error(); }  ///< [-]

    /// The tables take their names; contacts.csv and summary.json are written.
    void finish(const core::Simulation& simulation, const SceneSummary& summary);

  private:
    std::filesystem::path folder_;
    std::optional<CsvStream> trajectory_, energy_;
    core::EnergyClosing closing_;
};

/// Saves spheres, walls and touching contacts in failed_state_file(folder), whatever state they are
/// in, and returns the file's path. FileError.
std::filesystem::path save_state(const core::Simulation& simulation,
                                 const std::filesystem::path& folder);

}  // namespace grainfield::triaxial
