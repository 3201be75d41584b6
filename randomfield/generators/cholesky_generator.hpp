#pragma once
// The exact reference: Z = L U with L L^T the covariance matrix of the cells' local averages.

#include <span>

#include "randomfield/generators/generator.hpp"
#include "randomfield/generators/lower_factor.hpp"

namespace grainfield::randomfield {

class CholeskyGenerator final : public Generator {
  public:
    /// Factors the covariance of the grid's cells. InputError for more cells than
    /// LowerFactor::max_size, or where no factor exists.
    CholeskyGenerator(const GridSpec& grid, const CorrelationModel& correlation);

    /// Number of standard normals a field takes: one a cell.
    [[nodiscard]] std::size_t normals() const override { return factor_.size(); }
    [[nodiscard]] bool exact() const override { return true; }
    void apply(std::span<const double> normals, std::span<double> field) const override {
        factor_.multiply(normals, field);
    }

  private:
    LowerFactor factor_;
};

}  // namespace grainfield::randomfield
