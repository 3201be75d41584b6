#pragma once
// The vector kernels of this build by instruction set, and which of them this CPU can run.

#include "kernels/vector/vector_kernels.hpp"

namespace grainfield::kernels {

/// In ascending order of what they can do.
enum class InstructionSet { scalar, avx2, avx512 };
inline constexpr InstructionSet instruction_sets[] = {InstructionSet::scalar, InstructionSet::avx2,
                                                      InstructionSet::avx512};
const char* name(InstructionSet isa);

/// Kernels in mixed precision (float lanes) and in double. Null where this build has none for the
/// instruction set.
const VectorKernels<float>* float_kernels(InstructionSet isa);
const VectorKernels<double>* double_kernels(InstructionSet isa);

/// True if this CPU and operating system run the instruction set.
bool runs_here(InstructionSet isa);

/// The table of vector kernels, or null where this build has none.
const KernelTable* mixed_table(InstructionSet isa);
const KernelTable* double_table(InstructionSet isa);

}  // namespace grainfield::kernels
