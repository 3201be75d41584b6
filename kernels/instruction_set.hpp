#pragma once
// The instruction sets that the vector kernels are compiled for.

#include <optional>
#include <string_view>

namespace grainfield::kernels {

/// In ascending order of what they can do. "scalar" is plain code, for any CPU.
enum class InstructionSet { scalar, avx2, avx512 };

inline constexpr InstructionSet instruction_sets[] = {InstructionSet::scalar, InstructionSet::avx2,
                                                      InstructionSet::avx512};

/// Name in configs, results and messages.
constexpr const char* name(InstructionSet isa) {
    return isa == InstructionSet::avx512 ? "avx512"
           : isa == InstructionSet::avx2 ? "avx2"
                                         : "scalar";
}

/// The instruction set of a name; nothing if there is none.
constexpr std::optional<InstructionSet> instruction_set(std::string_view of) {
    for (const InstructionSet isa : instruction_sets)
        if (of == name(isa)) return isa;
    return std::nullopt;
}

/// True if this CPU and operating system run the instruction set.
bool runs_here(InstructionSet isa);

}  // namespace grainfield::kernels
