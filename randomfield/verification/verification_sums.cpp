#include "randomfield/verification/verification_sums.hpp"

namespace grainfield::randomfield {

double mean_product(std::span<const double> g, const GridSpec& grid, std::size_t axis,
                    std::int32_t lag) {
    std::size_t stride = 1;  // from a cell to the next along the axis
    for (std::size_t d = 0; d < axis; ++d) stride *= static_cast<std::size_t>(grid.cells[d]);
    const std::size_t line = stride * static_cast<std::size_t>(grid.cells[axis]);
    const std::size_t ahead = stride * static_cast<std::size_t>(lag);
    double sum = 0.0;
    for (std::size_t first = 0; first < g.size(); first += line)
        for (std::size_t i = first; i + ahead < first + line; ++i) sum += g[i] * g[i + ahead];
    return sum / static_cast<double>(g.size() / line * (line - ahead));
}

}  // namespace grainfield::randomfield
