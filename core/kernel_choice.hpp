#pragma once
// Which kernels a run uses.

#include "core/solver_options.hpp"
#include "kernels/contact_kernels.hpp"

namespace grainfield::core {

/// The kernel table for the options: without an instruction set the widest vectors that this build
/// has and this machine runs. "scalar" in double precision is the reference. Throws InputError,
/// naming solver.isa and what is allowed, if an instruction set was asked for by name and is not
/// there.
const kernels::KernelTable& choose_kernels(const SolverOptions& options);

}  // namespace grainfield::core
