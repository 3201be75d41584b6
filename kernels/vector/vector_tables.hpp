#pragma once
// The vector kernels of this build by instruction set.

#include "kernels/instruction_set.hpp"
#include "kernels/vector/vector_kernels.hpp"

namespace grainfield::kernels {

/// Kernels in mixed precision (float lanes) and in double. Null where this build has none for the
/// instruction set.
const VectorKernels<float>* float_kernels(InstructionSet isa);
const VectorKernels<double>* double_kernels(InstructionSet isa);

/// The table of vector kernels, or null where this build has none.
const KernelTable* mixed_table(InstructionSet isa);
const KernelTable* double_table(InstructionSet isa);

}  // namespace grainfield::kernels
