#pragma once
// `triaxial --repeats N`: the same test from starts 1e-12 m apart.

#include <filesystem>

#include "triaxial/cli/triaxial_run.hpp"

namespace grainfield::triaxial {

/// Runs the repeats one after the other, writes what they scatter by and prints it. Results of a
/// repeat stand in repeatK.part until the series has all of them: what an earlier run has in `out`
/// stays until then. The run goes on with the repeat of its checkpoint. Throws SimulationError
/// naming the repeat that failed; the folders of those before it stay.
void run_repeats(Run& run, const std::filesystem::path& out, const kernels::KernelTable& kernels,
                 core::Checkpoint& checkpoint, Session& session);

/// What an earlier series left unfinished goes: another one begins.
void drop_repeats_in_progress(const std::filesystem::path& out);

}  // namespace grainfield::triaxial
