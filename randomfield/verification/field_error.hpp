#pragma once
// How far a generator's covariance is from the exact one. A generator is linear in its normals,
// Z = M U, so this needs no sampling: the error is M M^T - C.

#include <Eigen/Core>
#include <vector>

#include "randomfield/generators/generator.hpp"

namespace grainfield::randomfield {

/// Largest grid that is looked at without being asked to: a second or two [cells].
inline constexpr std::size_t max_error_cells = 2048;
/// Largest grid of covariance_error(): a minute or two and 0.6 GB [cells].
inline constexpr std::size_t max_slow_error_cells = 8192;

/// M, one row a cell and one column a normal. InputError above max_slow_error_cells.
Eigen::MatrixXd linear_map(const Generator& generator);

/// C, the exact covariance of the grid's cells. InputError above max_error_cells.
Eigen::MatrixXd exact_covariance(const GridSpec& grid, const CorrelationModel& correlation);

/// In units of gamma, the variance of one cell.
struct CovarianceError {
    double covariance = 0.0;        ///< largest |M M^T - C| [-]
    double variance = 0.0;          ///< largest on the diagonal [-]
    std::vector<double> variances;  ///< (M M^T)_cc of every cell, 1 where exact [-]
};

/// M M^T - C by blocks of rows: no square matrix but M is held. InputError above
/// max_slow_error_cells.
CovarianceError covariance_error(const Generator& generator);

}  // namespace grainfield::randomfield
