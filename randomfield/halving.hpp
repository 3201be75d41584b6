#pragma once
// One stage of local average subdivision: a grid of cells, each halved along one axis.
//
// In memory a grid is rows along axis 0, and a row is its cells of even index, then those of odd
// index: so all that is drawn at once (one parity class, see detail_stencil.hpp) is contiguous.

#include <span>
#include <vector>

#include "kernels/vector/row_sums.hpp"
#include "randomfield/detail_stencil.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// Where cell i of a row of n cells stands: even cells first.
inline std::int32_t place_in_row(std::int32_t i, std::int32_t n) {
    return i % 2 == 0 ? i / 2 : (n + 1) / 2 + i / 2;
}

class Halving {
  public:
    /// `parents`: the grid before, cells and their size [m]. `children`: cells after, 2 n or
    /// 2 n - 1 along the axis. InputError where the covariances cannot be factored.
    Halving(const GridSpec& parents, const CellCount& children, std::size_t axis,
            const CorrelationModel& correlation);

    [[nodiscard]] const CellCount& parents() const { return parents_; }
    [[nodiscard]] const CellCount& children() const { return children_; }
    /// Number of parents, of their details and of the normals they take [-].
    [[nodiscard]] std::size_t size() const { return GridSpec{parents_, {}}.size(); }

    /// Draws the details of all parents; all spans of size() numbers, rows as above. The same
    /// bits on any number of threads.
    void draw_details(std::span<const double> normals, std::span<const double> parents,
                      std::span<double> details) const;
    /// P + E and P - E, those that the children's grid holds.
    void make_children(std::span<const double> parents, std::span<const double> details,
                       std::span<double> children) const;

  private:
    // Cells of a row with the same surroundings along it, every second from the first on.
    struct Segment {
        std::int32_t first = 0;
        std::size_t count = 0;
        Surroundings around;
    };
    // A stencil with the places of its terms, from the start of the row.
    struct Weights {
        std::vector<kernels::RowTerm> cells, details;
        double noise = 0.0;
    };

    void draw_row(std::int32_t j, std::int32_t k, const double* normals, const double* parents,
                  double* details) const;

    CellCount parents_, children_;
    std::size_t axis_;
    std::vector<Segment> segments_;              ///< even ones first
    std::vector<std::size_t> row_kind_;          ///< by surroundings along axes 1 and 2
    std::vector<std::vector<Weights>> weights_;  ///< [row kind][segment]
};

}  // namespace grainfield::randomfield
