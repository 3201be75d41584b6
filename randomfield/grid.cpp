#include "randomfield/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace grainfield::randomfield {

std::size_t GridSpec::index_of_block(const CellCount& block) const {
    for (std::size_t d = 0; d < 3; ++d) {
        if (block[d] < 0 || block[d] >= cells[d]) {
            throw InputError(
                fmt::format("block ({}, {}, {}) lies outside the random field's {} x {} x {} cells",
                            block[0], block[1], block[2], cells[0], cells[1], cells[2]));
        }
    }
    return index(block[0], block[1], block[2]);
}

std::size_t GridSpec::index_at(const Vec3& offset) const {
    CellCount cell{};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto axis = static_cast<Eigen::Index>(d);
        // Clamped before the conversion: far points would not fit an integer.
        cell[d] = static_cast<std::int32_t>(
            std::clamp(std::floor(offset[axis] / cell_size[axis]), 0.0, cells[d] - 1.0));
    }
    return index(cell[0], cell[1], cell[2]);
}

void GridSpec::validate() const {
    double total = 1.0;
    for (std::size_t d = 0; d < 3; ++d) {
        const double edge = cell_size[static_cast<Eigen::Index>(d)];
        if (cells[d] < 1) {
            throw InputError(
                fmt::format("random field: number of cells = [{}, {}, {}]: each must be at least 1",
                            cells[0], cells[1], cells[2]));
        }
        if (!(edge > 0.0) || !std::isfinite(edge)) {
            throw InputError(fmt::format(
                "random field: cell size = [{}, {}, {}] m: each must be positive and finite",
                cell_size[0], cell_size[1], cell_size[2]));
        }
        total *= cells[d];
    }
    constexpr double most = 1e9;  // 8 GB a column; 32-bit indices elsewhere still hold it
    if (total > most) {
        throw InputError(fmt::format(
            "random field: {} x {} x {} cells are more than the {:.0e} that are allowed", cells[0],
            cells[1], cells[2], most));
    }
}

}  // namespace grainfield::randomfield
