#pragma once
// Local Average Subdivision in three dimensions as published (Fenton & Vanmarcke 1990);
// las_generator does better at less cost.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "randomfield/generators/cholesky_generator.hpp"
#include "randomfield/generators/subdivision_stencil.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// Stage 0 is an exact field on a coarse grid; each stage halves the cells, every direction that
/// still has more than one. Where a count is odd the stage's grid is one cell larger than needed
/// and cut. Linear in its normals, Z = M U, with E[Z Z^T] = M M^T close to the exact covariance but
/// not equal to it: the noise of a stage is independent between parents (see field_error.hpp). For
/// 3 x 6 x 3 -> 6 x 12 x 6 cells at Tran et al.'s anisotropy covariances are off by up to 0.145,
/// 0.396, 0.201, 0.112, 0.012 gamma at theta_y = 0.01, 0.1, 0.5, 1, 10 m; variances are exact. A
/// second stage takes the first one's covariances for exact, and variances drift as well: by up to
/// 0.27 gamma from 2 x 3 x 2 cells. So stage 0 should be as large as it may.
class LasClassicGenerator final : public Generator {
  public:
    /// Uses the fewest subdivisions whose stage 0 has no more than stage0_cells cells; a grid that
    /// small is not subdivided at all, and the field is exact. InputError as CholeskyGenerator.
    LasClassicGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                        std::int64_t stage0_cells = 512);

    /// Stage 0, then each stage, parent by parent.
    [[nodiscard]] std::size_t normals() const override { return normals_; }
    [[nodiscard]] bool exact() const override { return stages_.empty(); }
    /// Number of subdivisions; 0 means that the field is exact.
    [[nodiscard]] std::size_t subdivisions() const override { return stages_.size(); }
    /// Cells of the grid after a number of subdivisions, 0 ... subdivisions().
    [[nodiscard]] const CellCount& stage_cells(std::size_t stage) const;

    void apply(std::span<const double> normals, std::span<double> field) const override;
    /// The fields of all stages, stage 0 first: what apply() goes through.
    [[nodiscard]] std::vector<std::vector<double>> apply_stages(
        std::span<const double> normals) const;

  private:
    struct Stage {
        CellCount parents{};   ///< cells before [-]
        CellCount children{};  ///< cells after, cut to what is needed [-]
        CellCount split{};     ///< 2 where halved, else 1 [-]
        std::size_t children_each = 0;
        std::array<SubdivisionStencil, 64> stencils;
    };

    void subdivide(const Stage& stage, std::span<const double> normals,
                   std::span<const double> parents, std::span<double> children) const;

    std::vector<Stage> stages_;
    CholeskyGenerator stage0_;
    std::size_t normals_ = 0;
};

}  // namespace grainfield::randomfield
