// The vector kernels in float, once for each instruction set.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/vector/float_kernels.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

#include "kernels/vector/tables-inl.hpp"

#if HWY_ONCE
#include "kernels/vector/vector_tables.hpp"

namespace grainfield::kernels {

const VectorKernels<float>* float_kernels(InstructionSet isa) {
    switch (isa) {
#if HWY_TARGETS & HWY_AVX3
        case InstructionSet::avx512:
            return &N_AVX3::vector_kernels<float>();
#endif
#if HWY_TARGETS & HWY_AVX2
        case InstructionSet::avx2:
            return &N_AVX2::vector_kernels<float>();
#endif
        case InstructionSet::scalar:
            return &HWY_STATIC_DISPATCH(vector_kernels<float>)();
        default:
            return nullptr;
    }
}

}  // namespace grainfield::kernels
#endif
