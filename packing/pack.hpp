#pragma once
// The whole packing: one block, its mirror images, the sample settled under gravity.

#include <string>

#include "core/base/monitor.hpp"
#include "core/drive/measures.hpp"
#include "core/state/checkpoint.hpp"
#include "packing/block.hpp"
#include "packing/stress_profile.hpp"

namespace grainfield::packing {

/// A sample with all that is known about how it was made.
struct Packing {
    core::ParticleStore spheres;  ///< at rest
    core::Box box;                ///< walls at the sides and below; top of the spheres above
    PackingOptions options;
    Grading grading;      ///< target
    Block block;          ///< phase 1
    double porosity = 0;  ///< of the sample in its box [-]
    core::Fabric fabric;
    StressProfile profile;        ///< of the sample settled under gravity
    double isotropic_stress = 0;  ///< the sample is held at, without gravity; 0: settled [Pa]
    std::int64_t steps = 0;       ///< of settling the sample [-]
    double block_seconds = 0, settling_seconds = 0, isotropic_seconds = 0;  ///< wall time [s]
    std::string state_hash;

    double seconds() const { return block_seconds + settling_seconds + isotropic_seconds; }
};

/// Packs, flips and settles; with options.isotropic_stress also brings the sample to that stress
/// without gravity. With a checkpoint, all of it can be saved and resumed. Throws InputError
/// (unreachable porosity), SimulationError, Interrupted.
Packing pack(const PackingOptions& options, const Grading& grading, const Material& material,
             const core::TimeOptions& time, core::Monitor& monitor,
             const core::SolverOptions& solver = {}, core::Checkpoint* checkpoint = nullptr);

}  // namespace grainfield::packing
