#pragma once
// `simulate`: a scene from its file to its results.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/monitor.hpp"
#include "core/state/checkpoint.hpp"
#include "triaxial/config/scene_file.hpp"

namespace grainfield::triaxial {

struct SceneSummary {
    std::size_t particles = 0, walls = 0;  ///< [-]
    std::int64_t contacts = 0;             ///< touching at the end [-]
    std::string density;                   ///< of the spheres, as text
    std::int64_t steps = 0;                ///< [-]
    double time_step = 0;                  ///< the mean one where it was automatic [s]
    double time = 0;                       ///< reached [s]
    double energy_closing_error = 0;       ///< see SceneOutput [-]
    double wall_seconds = 0;               ///< of the stepping and its output [s]
    double particle_steps_per_second = 0;  ///< [1/s]
    std::string state_hash, isa, precision;
    std::vector<std::string> warnings;  ///< sentences on what makes the numbers doubtful
    int threads = 1;                    ///< [-]
};

/// Runs the scene and writes trajectory.csv, energy.csv, contacts.csv and summary.json into `out`:
/// states at t = 0, at the first step at or after each multiple of the output interval, and at the
/// end. A fixed step is taken round(end/step) times; of automatic steps the last is cut to hit the
/// end. `source`: the scene's file, for messages.
/// With a checkpoint it can be saved and resumed; rows of the tables that a checkpoint knows are
/// kept as NAME.part until then.
/// Throws InputError, FileError, Interrupted; SimulationError after out/state.h5 was written, which
/// the message names. None of the other files appears then.
SceneSummary run_scene(const SceneFile& file, const std::filesystem::path& source,
                       const std::filesystem::path& out, int threads, core::Monitor& monitor,
                       core::Checkpoint* checkpoint = nullptr);

}  // namespace grainfield::triaxial
