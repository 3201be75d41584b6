#include "kernels/vector/vector_tables.hpp"

#include <hwy/targets.h>

#include <iterator>

namespace grainfield::kernels {

bool runs_here(InstructionSet isa) {
    switch (isa) {
        case InstructionSet::avx2:
            return (hwy::SupportedTargets() & HWY_AVX2) != 0;
        case InstructionSet::avx512:
            return (hwy::SupportedTargets() & HWY_AVX3) != 0;
        default:
            return true;
    }
}

namespace {

constexpr std::size_t sets = std::size(instruction_sets);

struct Tables {
    KernelTable mixed[sets], full[sets];

    Tables() {
        for (const InstructionSet isa : instruction_sets) {
            const auto k = static_cast<std::size_t>(isa);
            mixed[k] = {isa, "mixed", nullptr, float_kernels(isa), nullptr};
            full[k] = {isa, "double", nullptr, nullptr, double_kernels(isa)};
        }
    }
};

const Tables& tables() {
    static const Tables all;
    return all;
}

}  // namespace

const KernelTable* mixed_table(InstructionSet isa) {
    const KernelTable& table = tables().mixed[static_cast<std::size_t>(isa)];
    return table.mixed ? &table : nullptr;
}

const KernelTable* double_table(InstructionSet isa) {
    const KernelTable& table = tables().full[static_cast<std::size_t>(isa)];
    return table.full ? &table : nullptr;
}

}  // namespace grainfield::kernels
