#include "randomfield/memory_limit.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace grainfield::randomfield {

void require_memory(const GridSpec& grid, double bytes, const char* work) {
    const double memory = memory_of_process();
    if (bytes <= memory) return;
    throw InputError(fmt::format(
        "random field: {} x {} x {} cells with {} need {:.3g} GB of memory: at most {:.3g} GB are "
        "allowed, all that there is; lower packing.blocks to at most {:.0f} cells",
        grid.cells[0], grid.cells[1], grid.cells[2], work, 1e-9 * bytes, 1e-9 * memory,
        static_cast<double>(grid.size()) * memory / bytes));
}

void require_memory(const GridSpec& grid, double bytes, std::uint64_t count, const char* work) {
    const double memory = memory_of_process();
    if (bytes <= memory) return;
    throw InputError(fmt::format(
        "random field: {} realizations of {} x {} x {} cells {} need {:.3g} GB of memory: at most "
        "{:.3g} GB are allowed, all that there is; lower --realizations to at most {:.0f}, or "
        "packing.blocks, or write a .csv file, which holds one at a time",
        count, grid.cells[0], grid.cells[1], grid.cells[2], work, 1e-9 * bytes, 1e-9 * memory,
        static_cast<double>(count) * memory / bytes));
}

}  // namespace grainfield::randomfield
