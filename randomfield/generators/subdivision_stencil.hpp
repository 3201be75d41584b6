#pragma once
// One subdivision of Local Average Subdivision: how a parent's children follow from the parents
// around it (Fenton & Vanmarcke 1990, J. Eng. Mech. 116(8), 1733-1749).

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/vec3.hpp"
#include "randomfield/covariance/correlation.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// Which of the 3 x 3 x 3 parents exist: in each direction the one below and the one above.
struct Neighbourhood {
    std::array<bool, 3> below{};
    std::array<bool, 3> above{};

    /// A number in [0, 64) for tables.
    [[nodiscard]] std::size_t id() const {
        std::size_t bits = 0;
        for (std::size_t d = 0; d < 3; ++d) bits = bits * 4 + (below[d] ? 2u : 0u) + above[d];
        return bits;
    }
};

/// The children of one parent, all but the last: child = sum of weight x parents + sum of
/// noise x normals. The last child follows by conservation: their mean is the parent.
struct SubdivisionStencil {
    static constexpr std::size_t max_children = 8;

    std::size_t children = 0;                               ///< 2, 4 or 8 [-]
    std::vector<CellCount> neighbours;                      ///< offsets of the parents [-]
    std::vector<std::array<double, max_children>> weights;  ///< [neighbour][child] [-]
    std::array<std::array<double, max_children>, max_children> noise{};  ///< [normal][child] [-]
};

/// Weights and noise from the exact covariances of local averages at the children's size.
/// split[d] is 2 where the direction is halved and 1 where it is not. InputError where the
/// covariances cannot be factored.
SubdivisionStencil subdivision_stencil(const Vec3& child_size, const CellCount& split,
                                       const CorrelationModel& correlation,
                                       const Neighbourhood& neighbourhood);

/// All stencils of a stage with `parents` cells, by Neighbourhood::id(); empty where that
/// neighbourhood does not occur.
std::array<SubdivisionStencil, 64> subdivision_stencils(const Vec3& child_size,
                                                        const CellCount& split,
                                                        const CorrelationModel& correlation,
                                                        const CellCount& parents);

/// The neighbourhood of one parent in a grid of parents.
Neighbourhood neighbourhood_of(const CellCount& parent, const CellCount& parents);

}  // namespace grainfield::randomfield
