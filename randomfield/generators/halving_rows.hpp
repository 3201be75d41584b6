#pragma once
// The rows of local average subdivision (randomfield/generators/halving.hpp), in the widest vectors
// of this machine. Every number is one sum in the order given, multiplied and rounded term by term:
// the same bits on every instruction set.

#include <cstddef>
#include <span>

namespace grainfield::randomfield {

/// Rows are drawn and stored in groups of so many numbers, each on a cache line of its own.
inline constexpr std::size_t row_group = 8;

/// The place in memory of a row of n cells: those of even index, then those of odd index, either
/// filled up with zeros to whole groups, with a group of zeros in front and one behind. So a
/// neighbour along the row may be read where there is none: it is zero.
struct RowLayout {
    explicit RowLayout(std::size_t n)
        : even((n + 1) / 2),
          odd(n / 2),
          odd_at(even_at + filled(even) + row_group),
          size(odd_at + filled(odd) + row_group) {}

    static constexpr std::size_t filled(std::size_t n) {
        return (n + row_group - 1) / row_group * row_group;
    }
    /// Of cell i, from the start of the row [numbers].
    [[nodiscard]] std::size_t place(std::size_t i) const {
        return (i % 2 == 0 ? even_at : odd_at) + i / 2;
    }
    static constexpr std::size_t even_at = row_group;
    std::size_t even, odd;  ///< cells of even and of odd index [-]
    std::size_t odd_at;     ///< where those of odd index begin [numbers]
    std::size_t size;       ///< from one row to the next [numbers]
};

/// Groups of a row that are drawn by the same terms.
struct RowPiece {
    std::size_t at = 0;            ///< where the first group stands in the row [numbers]
    std::size_t groups = 0;        ///< [-]
    std::size_t first_normal = 0;  ///< of the row's [-]
    std::size_t cells = 0;         ///< in the groups, which may not be full [-]
    bool alike = false;            ///< one weight a term, or, in one group, one for each number
    std::span<const std::ptrdiff_t> parents;  ///< where each term's row of numbers begins, from the
    std::span<const std::ptrdiff_t> details;  ///< start of the row drawn [numbers]
    const double* weights = nullptr;  ///< of the normal, then of the terms, in order; those of one
                                      ///< group aligned to cache lines [-]
};

/// Rows of one kind, drawn together: `count` (1, 2 or 4) of n cells. All pointers are to the
/// first one.
struct RowsToDraw {
    std::size_t n = 0, count = 0;     ///< [-]
    const double* normals = nullptr;  ///< of the first cell; n a row
    std::size_t normals_apart = 0;    ///< from one row's normals to the next one's [numbers]
    const double* parents = nullptr;
    double* details = nullptr;
    std::size_t apart = 0;  ///< from one row to the next, parents and details [numbers]
    double *front = nullptr, *behind = nullptr;  ///< of the children; null where there are none
    std::size_t children_apart = 0;              ///< from one row of either to the next [numbers]
};

/// Draws details, e = sum of weights times normal, parents and details, and children, p + e in
/// front and p - e behind. The details read are none of those written in the same piece.
void draw_rows(std::span<const RowPiece> pieces, const RowsToDraw& rows);

/// Children of a row of n cells that are halved along it: p + e and p - e in turns, `halves` of
/// them, 2 n or 2 n - 1, in a row of their own.
void halve_along_row(std::size_t n, std::size_t halves, const double* parents,
                     const double* details, double* children);

/// The n cells of a row in their order.
void row_in_order(std::size_t n, const double* row, double* in_order);

/// table[i stride + r] = cell i of the r-th of `rows` rows of n cells, `apart` numbers from each
/// other: rows become columns.
void rows_to_columns(std::size_t n, std::size_t rows, std::size_t apart, const double* row,
                     std::size_t stride, double* table);

}  // namespace grainfield::randomfield
