#pragma once
// The exact reference: Z = L U with L L^T the covariance matrix of the cells' local averages.

#include <span>

#include "randomfield/grid.hpp"
#include "randomfield/lower_factor.hpp"

namespace grainfield::randomfield {

class CholeskyGenerator {
  public:
    /// Factors the covariance of the grid's cells for the correlation lengths theta [m], all > 0.
    /// InputError for more cells than LowerFactor::max_size, or where no factor exists.
    CholeskyGenerator(const GridSpec& grid, const Vec3& correlation_length);

    /// Number of standard normals a field takes: one a cell.
    [[nodiscard]] std::size_t normals() const { return factor_.size(); }
    /// Variance of one cell [-].
    [[nodiscard]] double gamma() const { return gamma_; }
    /// field = M normals, of normals() and of one number a cell. Safe from many threads.
    void apply(std::span<const double> normals, std::span<double> field) const {
        factor_.multiply(normals, field);
    }

  private:
    double gamma_ = 0.0;
    LowerFactor factor_;
};

}  // namespace grainfield::randomfield
