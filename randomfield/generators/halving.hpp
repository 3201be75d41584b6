#pragma once
// One stage of local average subdivision: a grid of cells, each halved along one axis.
//
// In memory a grid is rows along axis 0, and a row is its cells of even index, then those of odd
// index: so all that is drawn at once (one parity class, see detail_stencil.hpp) is contiguous.

#include <span>
#include <vector>

#include "core/base/aligned.hpp"
#include "core/base/random.hpp"
#include "randomfield/generators/detail_stencil.hpp"
#include "randomfield/generators/halving_rows.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// A grid of cells as the stages keep it: row (j, k) is the (j + k cells[1])-th.
struct RowGrid {
    explicit RowGrid(const CellCount& of_cells)
        : cells(of_cells), row(static_cast<std::size_t>(of_cells[0])) {}

    /// Where row (j, k) begins [numbers].
    [[nodiscard]] std::size_t at(std::int32_t j, std::int32_t k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells[1]) +
                static_cast<std::size_t>(j)) *
               row.size;
    }
    /// Of the whole grid [numbers].
    [[nodiscard]] std::size_t size() const { return at(0, cells[2]); }

    CellCount cells;
    RowLayout row;
};

/// The normals of a field: given, or drawn where and when they are needed.
class NormalSource {
  public:
    explicit NormalSource(std::span<const double> given) : given_(given) {}
    NormalSource(const core::RandomStream& random, std::uint64_t realization)
        : random_(&random), realization_(realization) {}

    /// Those from `first` on; `room` is for as many, and theirs where they are drawn. For any
    /// number of threads at once, each with room of its own.
    [[nodiscard]] const double* get(std::size_t first, std::span<double> room) const {
        if (random_ == nullptr) return given_.data() + first;
        random_->normals(realization_, first, room);
        return room.data();
    }
    [[nodiscard]] bool given() const { return random_ == nullptr; }

  private:
    std::span<const double> given_;
    const core::RandomStream* random_ = nullptr;
    std::uint64_t realization_ = 0;
};

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

    /// Draws the details E of all parents from size() normals, row by row in order, those from
    /// `first` on, and makes the children, P + E and P - E. The other spans are of RowGrids:
    /// parents, as many details, and children. The same bits on any number of threads.
    void make_children(const NormalSource& normals, std::size_t first,
                       std::span<const double> parents, std::span<double> details,
                       std::span<double> children) const;

  private:
    // What is drawn alike in all rows with the same surroundings.
    struct RowKind {
        std::vector<RowPiece> pieces;  // of the even cells first
        std::vector<std::vector<std::ptrdiff_t>> places;
        std::vector<core::Aligned<double>> weights;
    };

    RowKind make_kind(const DetailCovariance& covariance, const Surroundings& along1,
                      const Surroundings& along2) const;
    [[nodiscard]] std::size_t kind_of(std::int32_t j, std::int32_t k) const {
        return row_kinds_[0][static_cast<std::size_t>(j)] * kinds_along2_ +
               row_kinds_[1][static_cast<std::size_t>(k)];
    }
    // `count` rows from (j, k) on, every second one across the slabs' axis, all of one kind.
    // `normals` are those of the slab.
    void make_rows(std::int32_t j, std::int32_t k, std::int32_t count, const double* normals,
                   const double* parents, double* details, double* children) const;
    void make_slab(std::int32_t slab, const double* normals, const double* parents, double* details,
                   double* children) const;
    const double* normals_of_slab(std::int32_t slab, const NormalSource& normals,
                                  std::size_t first) const;

    CellCount parents_, children_;
    std::size_t axis_;
    std::size_t slab_axis_;                  ///< 1 or 2, the longer one
    std::vector<std::size_t> row_kinds_[2];  ///< of rows, by their place along axes 1 and 2
    std::vector<RowKind> kinds_;             ///< [along 1][along 2]
    std::size_t kinds_along2_ = 0;
};

}  // namespace grainfield::randomfield
