#include "core/kernel_choice.hpp"

#include <fmt/format.h>

#include <string>

#include "core/base/errors.hpp"
#include "kernels/vector/vector_tables.hpp"

namespace grainfield::core {
namespace {

using kernels::InstructionSet;

/// Table of an instruction set that this build has and this CPU runs; else null.
const kernels::KernelTable* usable(InstructionSet isa, Precision precision) {
    if (!kernels::runs_here(isa)) return nullptr;
    if (precision == Precision::mixed) return kernels::mixed_table(isa);
    // In double the plain loops of the reference serve where there are no vectors.
    return isa == InstructionSet::scalar ? &kernels::reference_kernels()
                                         : kernels::double_table(isa);
}

}  // namespace

const kernels::KernelTable& choose_kernels(const SolverOptions& options) {
    if (options.isa) {
        const InstructionSet isa = *options.isa;
        if (const auto* table = usable(isa, options.precision)) return *table;
        std::string allowed = "\"auto\"";
        for (const InstructionSet other : kernels::instruction_sets)
            if (usable(other, options.precision))
                allowed += fmt::format(", \"{}\"", kernels::name(other));
        throw InputError(fmt::format("solver.isa = \"{}\": this {} does not have it; allowed: {}",
                                     kernels::name(isa),
                                     kernels::runs_here(isa) ? "build" : "machine", allowed));
    }
    const kernels::KernelTable* best = nullptr;
    for (const InstructionSet isa : kernels::instruction_sets)
        if (const auto* table = usable(isa, options.precision)) best = table;
    return *best;
}

}  // namespace grainfield::core
