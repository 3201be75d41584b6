#pragma once
// The triaxial test: isotropic compression, then shear under constant confining stress.

#include <cstdint>
#include <string>
#include <vector>

#include "core/drive/driver.hpp"
#include "core/drive/measures.hpp"
#include "core/simulation.hpp"
#include "triaxial/config/config.hpp"
#include "triaxial/realization/curve.hpp"
#include "triaxial/realization/quality.hpp"

namespace grainfield::triaxial {

/// The sample as the test starts with it: spheres with their properties, and its box.
struct Sample {
    core::ParticleStore spheres;
    core::Box box;
    /// Contacts that carry a shear force when the test starts.
    std::vector<core::ContactShear> contacts = {};
};

struct TestResult {
    CurveResults results;
    std::vector<CurvePoint> curve;
    std::string end_reason;  ///< of failure_name(), or ended_as_asked

    double porosity = 0;                                ///< before compression, in the box [-]
    double sheared_porosity = 0;                        ///< when shear begins [-]
    std::int64_t contacts = 0;                          ///< when shear begins [-]
    core::Fabric fabric;                                ///< when shear begins
    std::int64_t isotropic_steps = 0, shear_steps = 0;  ///< [-]
    double mean_step = 0;                               ///< of the shear stage [s]
    double inertia_ratio = 1;      ///< inertia over real mass (mass scaling) [-]
    double lateral_rms_error = 0;  ///< of both lateral stresses over all steps of shear [-]
    double lateral_max_error = 0;  ///< at any recorded point after 0.1 % of strain [-]
    HeldStress held;
    double lowest_start_ratio = 0;      ///< smallest q over sigma_3 up to half the peak [-]
    double inertial_number = 0;         ///< of the shear rate and the inertia in use [-]
    double isotropic_unbalanced = 0;    ///< at the end of the isotropic stage [-]
    double isotropic_stress_error = 0;  ///< largest of the six walls then [-]
    double isotropic_seconds = 0, shear_seconds = 0;  ///< wall time [s]

    // Where the simulation keeps the ledger.
    std::vector<core::EnergyRow> energies;  ///< from the start of the isotropic stage
    double shear_began = 0;                 ///< on the clock of `energies` [s]
    double energy_closing_error = 0;  ///< largest change of their sum over the work put in [-]
    std::optional<ShearEnergy> shear_energy;

    bool quasi_static = false;
    std::vector<std::string> warnings;  ///< sentences on what makes the numbers doubtful
};

/// The scene of a test: six walls of the box, friction and stiffness of the config's wall.
core::Scene make_scene(Sample sample, const Config& config);

/// make_scene() as a simulation, its spheres and overlaps checked (`name` stands for them in
/// messages), its contacts with the shear forces of the sample. Throws InputError.
core::Simulation make_simulation(Sample sample, const Config& config,
                                 const kernels::KernelTable& kernels, const std::string& name,
                                 const core::SimulationOptions& options = {});

/// Runs both stages on a simulation made of make_scene(). Throws SimulationError, also where the
/// confining stress was not held, and Interrupted; the simulation then holds the state reached.
/// With a checkpoint it can be saved and resumed; a run that resumes brings a simulation without
/// spheres, for the same kernels.
TestResult run_test(core::Simulation& simulation, const Config& config, core::Monitor& monitor,
                    core::Checkpoint* checkpoint = nullptr);

}  // namespace grainfield::triaxial
