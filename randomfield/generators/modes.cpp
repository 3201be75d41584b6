#include "randomfield/generators/modes.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/base/errors.hpp"
#include "randomfield/verification/field_error.hpp"

namespace grainfield::randomfield {

double KarhunenLoeveModes::share(Eigen::Index count) const {
    return variance.head(count).sum() / variance.sum();
}

KarhunenLoeveModes karhunen_loeve_modes(const GridSpec& grid, const CorrelationModel& correlation) {
    grid.validate();
    correlation.validate();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        exact_covariance(grid, correlation));
    if (solver.info() != Eigen::Success) {
        throw InputError("random field: the Karhunen-Loeve modes of this grid did not converge");
    }
    KarhunenLoeveModes modes;
    // Never negative on paper; by round-off they may be.
    modes.variance = solver.eigenvalues().reverse().cwiseMax(0.0);
    modes.shape = solver.eigenvectors().rowwise().reverse();
    for (Eigen::Index m = 0; m < modes.shape.cols(); ++m) {
        const double largest = modes.shape.col(m).cwiseAbs().maxCoeff();
        Eigen::Index first = 0;
        while (std::abs(modes.shape(first, m)) < (1.0 - 1e-9) * largest) ++first;
        if (modes.shape(first, m) < 0.0) modes.shape.col(m) *= -1.0;
    }
    return modes;
}

}  // namespace grainfield::randomfield
