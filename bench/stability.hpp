#pragma once
// How far the solver can be trusted: the largest stable step, overlaps at the start, long rest, and
// loading rates. Each part writes a CSV and a picture.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/simulation.hpp"
#include "kernels/contact_kernels.hpp"
#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {

inline constexpr double confining_stress = 100e3;  // of the samples and of the tests [Pa]

/// What the parts work with.
struct StabilityRun {
    core::Scene small;             ///< one block, some hundred spheres, at 100 kPa
    core::Scene large;             ///< 2 x 4 x 2 blocks, some thousand spheres, at 100 kPa
    std::filesystem::path folder;  ///< for CSV files and pictures
    bool quick = false;            ///< a smoke test: few cases, few steps
};

void largest_stable_step(const StabilityRun& run);  // stability_step.{csv,png}
void start_overlaps(const StabilityRun& run);       // stability_overlap.{csv,png}
void collisions(const StabilityRun& run);           // stability_collisions.{csv,png}
void long_rest(const StabilityRun& run);            // stability_rest.{csv,png}
void strain_rates(const StabilityRun& run);         // stability_rate.{csv,png}

// What they share (stability_samples.cpp).

/// The kernels whose results are compared: reference, and the widest vectors in double and mixed.
struct NamedKernels {
    std::string name;  ///< "reference", "double", "mixed"
    const kernels::KernelTable* table;
};
std::vector<NamedKernels> compared_kernels();
const kernels::KernelTable& double_kernels();

/// A line on stderr.
void say(std::string_view line);

/// Another simulation in the same state, shear forces included, on other kernels or with a ledger.
core::Simulation copy_of(const core::Simulation& simulation, const kernels::KernelTable& kernels,
                         const core::SimulationOptions& options = {});

/// Of translation and rotation, with the velocities of mid-step [J].
double kinetic_energy(const core::Simulation& simulation);

/// A sample of lognormal stiffness, drawn for each sphere, whose largest is `contrast` times its
/// smallest and whose mean is the scene's; brought to the confining stress and to complete rest
/// between still walls; without the spheres that carry next to nothing, and with so much friction
/// that every contact sticks (stability_network.cpp).
core::Simulation still_network(core::Scene scene, double contrast);

/// The sample brought to the confining stress again and again until it keeps it between still
/// walls; no sphere moves (stability_rest.cpp).
core::Simulation settled(const core::Scene& scene);

/// A CSV and the picture of the template `name` with these variables, both under that name in the
/// run's folder.
void write_results(const StabilityRun& run, std::string_view name, std::string_view csv,
                   triaxial::report::PictureSize size,
                   const triaxial::report::GnuplotVariables& variables);

}  // namespace grainfield::bench
