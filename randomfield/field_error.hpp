#pragma once
// How far a generator's covariance is from the exact one. A generator is linear in its normals,
// Z = M U, so this needs no sampling: the error is M M^T - C.

#include <Eigen/Core>

#include "randomfield/generator.hpp"

namespace grainfield::randomfield {

/// Largest grid these dense matrices are made for [cells].
inline constexpr std::size_t max_error_cells = 2048;

/// M, one row a cell and one column a normal. InputError above max_error_cells.
Eigen::MatrixXd linear_map(const Generator& generator);

/// C, the exact covariance of the grid's cells. InputError above max_error_cells.
Eigen::MatrixXd exact_covariance(const GridSpec& grid, const CorrelationModel& correlation);

/// In units of gamma, the variance of one cell.
struct CovarianceError {
    double covariance = 0.0;  ///< largest |M M^T - C| [-]
    double variance = 0.0;    ///< largest on the diagonal [-]
};

CovarianceError covariance_error(const Generator& generator);

}  // namespace grainfield::randomfield
