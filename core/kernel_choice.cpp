#include "core/kernel_choice.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace grainfield::core {

const kernels::KernelTable& choose_kernels(const SolverOptions& options) {
    if (options.isa == Isa::avx2 || options.isa == Isa::avx512)
        throw InputError(
            fmt::format("solver.isa = \"{}\": not in this build; allowed: \"auto\", \"scalar\"",
                        options.isa == Isa::avx2 ? "avx2" : "avx512"));
    return kernels::reference_kernels();
}

}  // namespace grainfield::core
