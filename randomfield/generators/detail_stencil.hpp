#pragma once
// One halving of local average subdivision: how the detail of a cell follows from the cells around
// it and from details already drawn next door.
//
// A cell P halved along one axis has the halves P + E and P - E: conservation holds whatever the
// detail E is. E is drawn from its exact conditional distribution given
// - the cells P within two steps (faces, edges, next faces but one: 25), and
// - the details of the six face neighbours that are drawn before it.
// The second part is what the published algorithm lacks: there details of neighbouring cells are
// independent given the cells, which is wrong along directions of long correlation.
//
// Order of drawing: by parity. Cells with an even index in all directions first; a cell whose index
// is odd in a direction comes after its two neighbours in that direction and is conditioned on
// them. So all cells of one parity class can be drawn at once.

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/vec3.hpp"
#include "randomfield/covariance/correlation.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// Weight of the cell, or of the detail, at an offset.
struct DetailTerm {
    CellCount offset;  ///< [cells]
    double weight;     ///< [-]
};

struct DetailStencil {
    std::vector<DetailTerm> cells;
    std::vector<DetailTerm> details;
    double noise = 0.0;  ///< standard deviation of what is not determined [-]
};

/// What lies around a cell along one axis, as far as its stencil goes.
struct Surroundings {
    std::int32_t below = 0;  ///< cells before it, at most 2 [-]
    std::int32_t above = 0;  ///< cells after it, at most 2 [-]
    bool odd = false;        ///< parity of its index

    static constexpr std::size_t kinds = 18;
    /// A number in [0, kinds).
    [[nodiscard]] std::size_t id() const {
        return static_cast<std::size_t>((below * 3 + above) * 2 + (odd ? 1 : 0));
    }
};
Surroundings surroundings_of(std::int32_t index, std::int32_t cells);

/// Computes stencils from the exact covariances of the cells of one stage.
class DetailCovariance {
  public:
    /// cell_size: of the cells before the halving [m]. `cells`: how many there are.
    DetailCovariance(const Vec3& cell_size, const CellCount& cells, std::size_t axis,
                     const CorrelationModel& correlation);

    /// InputError where the covariances cannot be factored in double precision.
    [[nodiscard]] DetailStencil stencil(const std::array<Surroundings, 3>& around) const;

  private:
    struct Lag {
        double cell_cell, cell_detail, detail_detail;
    };
    [[nodiscard]] const Lag& at(const CellCount& from, const CellCount& to) const;

    std::size_t axis_;
    CorrelationModel correlation_;
    CellCount reach_{};      ///< largest lag [cells]
    std::vector<Lag> lags_;  ///< from -reach to reach in each direction
};

}  // namespace grainfield::randomfield
