#pragma once
// Which kernels a run uses.

#include "core/solver_options.hpp"
#include "kernels/contact_kernels.hpp"

namespace grainfield::core {

/// The kernel table for the options. There is one so far, scalar in double precision: it answers
/// "auto" and "scalar" in both precisions (mixed asks for double where sums are long; double
/// everywhere is no less), and an instruction set that was asked for by name but is not in this
/// build is an InputError that names solver.isa and what is allowed.
const kernels::KernelTable& choose_kernels(const SolverOptions& options);

}  // namespace grainfield::core
