#pragma once
// Karhunen-Loeve modes of a grid's cells: the directions in which its fields vary most.

#include <Eigen/Core>

#include "randomfield/covariance/correlation.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// C = sum over m of variance_m shape_m shape_m^T, C the exact covariance of the cells. A field is
/// sum over m of sqrt(variance_m) u_m shape_m with independent standard normals u.
struct KarhunenLoeveModes {
    Eigen::VectorXd variance;  ///< eigenvalues, largest first; their sum is cells x gamma [-]
    Eigen::MatrixXd shape;  ///< one mode a column, of unit length, cells at GridSpec::index() [-]

    /// Share of the total variance that the first `count` modes hold, in [0, 1] [-].
    [[nodiscard]] double share(Eigen::Index count) const;
};

/// All modes. The entry of largest magnitude of a shape (the first of those that tie to 1e-9) is
/// positive. Modes of equal variance, as symmetric grids have them, are some orthogonal pair.
/// InputError above max_error_cells, or where grid or correlation lengths are not valid.
KarhunenLoeveModes karhunen_loeve_modes(const GridSpec& grid, const CorrelationModel& correlation);

}  // namespace grainfield::randomfield
