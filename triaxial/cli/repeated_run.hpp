#pragma once
// `triaxial --repeats N`: the same test from starts 1e-12 m apart.

#include <filesystem>

#include "triaxial/cli/triaxial_run.hpp"

namespace grainfield::triaxial {

/// Runs the repeats one after the other, each into its folder in `out`, writes what they scatter by
/// and prints it. The run goes on with the repeat of its checkpoint. Throws SimulationError naming
/// the repeat that failed; the folders of those before it stay.
void run_repeats(Run& run, const std::filesystem::path& out, const kernels::KernelTable& kernels,
                 core::Checkpoint& checkpoint, Session& session);

}  // namespace grainfield::triaxial
