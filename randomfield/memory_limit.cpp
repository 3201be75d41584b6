#include "randomfield/memory_limit.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "core/errors.hpp"

namespace grainfield::randomfield {

void require_memory(const GridSpec& grid, double bytes, const char* method) {
    const double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (bytes <= memory) return;
    throw InputError(fmt::format(
        "random field: {} x {} x {} cells with field.method = \"{}\" need {:.3g} GB of memory: at "
        "most {:.3g} GB are allowed, all that this machine has",
        grid.cells[0], grid.cells[1], grid.cells[2], method, 1e-9 * bytes, 1e-9 * memory));
}

}  // namespace grainfield::randomfield
