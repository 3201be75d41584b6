#pragma once
// The grid of a random field: equal cells, x fastest.

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/vec3.hpp"

namespace grainfield::randomfield {

using CellCount = std::array<std::int32_t, 3>;

struct GridSpec {
    CellCount cells{6, 12, 6};         ///< number of cells in x, y, z [-]
    Vec3 cell_size{0.25, 0.25, 0.25};  ///< edges of one cell [m]

    /// Number of cells [-].
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
               static_cast<std::size_t>(cells[2]);
    }
    /// Index of cell (i, j, k): i + nx (j + ny k) [-].
    [[nodiscard]] std::size_t index(std::int32_t i, std::int32_t j, std::int32_t k) const {
        return static_cast<std::size_t>(i) +
               static_cast<std::size_t>(cells[0]) *
                   (static_cast<std::size_t>(j) +
                    static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(k));
    }
    /// The cell (i, j, k) at an index.
    [[nodiscard]] CellCount cell_at(std::size_t index) const {
        const auto i = static_cast<std::int64_t>(index);
        return {static_cast<std::int32_t>(i % cells[0]),
                static_cast<std::int32_t>(i / cells[0] % cells[1]),
                static_cast<std::int32_t>(i / cells[0] / cells[1])};
    }
    /// Index of the cell of a block (i, j, k), Tran et al.'s mapping of a sphere to the field: the
    /// sphere keeps the block it was made in. InputError where the grid has no such block.
    [[nodiscard]] std::size_t index_of_block(const CellCount& block) const;
    /// Index of the cell that holds a point, for spheres without a block; `offset` is from the
    /// grid's lower corner [m]. Points outside belong to the nearest cell.
    [[nodiscard]] std::size_t index_at(const Vec3& offset) const;

    /// Throws InputError where a count or an edge is not positive (or a product overflows).
    void validate() const;
};

}  // namespace grainfield::randomfield
