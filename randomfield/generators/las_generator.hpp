#pragma once
// Local average subdivision with correlated detail: the default way to draw a field.

#include <cstdint>
#include <span>
#include <vector>

#include "randomfield/generators/cholesky_generator.hpp"
#include "randomfield/generators/generator.hpp"
#include "randomfield/generators/halving.hpp"

namespace grainfield::randomfield {

/// Stage 0 is an exact field on a coarse grid; each stage halves the cells along one axis. Linear
/// in its normals, and every stage conserves the averages of the one before exactly. Differs from
/// the published algorithm (LasClassicGenerator) in three things:
/// - the axis with the longest correlation, counted in cells, is coarsened first, so that stage 0
///   keeps the others as fine as its size allows;
/// - cells up to two steps away are looked at, across faces and edges;
/// - details are conditioned on those already drawn next door (detail_stencil.hpp).
/// From 54 cells of stage 0 to Tran et al.'s 6 x 12 x 6, covariances are off by up to 0.013, 0.044,
/// 0.015, 0.008, 0.001 gamma at theta_y = 0.01, 0.1, 0.5, 1, 10 m; as published by 0.145, 0.396,
/// 0.201, 0.112, 0.012.
class LasGenerator final : public Generator {
  public:
    /// Largest stage 0 unless told otherwise: that of Fenton's own program [cells].
    static constexpr std::int64_t default_stage0_cells = 512;

    /// Uses the fewest halvings whose stage 0 has no more than stage0_cells cells; a grid that
    /// small is not subdivided at all, and the field is exact. InputError as CholeskyGenerator.
    LasGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                 std::int64_t stage0_cells = default_stage0_cells);

    void apply(std::span<const double> normals, std::span<double> field) const override;
    /// The normals of some rows at a time, while these are in cache.
    void draw(const core::RandomStream& random, std::uint64_t realization,
              std::span<double> field) const override;
    /// Stage 0, then each stage's parents row by row.
    [[nodiscard]] std::size_t normals() const override { return normals_; }
    [[nodiscard]] bool exact() const override { return stages_.empty(); }
    /// By correlation model, for any number of stages; rounded up from the largest found over
    /// theta_y of 0.01 to 10 m, grids and stages 0 (tests/randomfield/las_test.cpp).
    [[nodiscard]] double stated_error() const override;
    /// Number of halvings.
    [[nodiscard]] std::size_t subdivisions() const override { return stages_.size(); }

    /// Cells of the grid after a number of halvings, 0 ... subdivisions().
    [[nodiscard]] CellCount stage_cells(std::size_t stage) const;
    /// The fields of all stages, stage 0 first: what apply() goes through.
    [[nodiscard]] std::vector<std::vector<double>> apply_stages(
        std::span<const double> normals) const;

  private:
    struct Plan;
    LasGenerator(const GridSpec& grid, const CorrelationModel& correlation, const Plan& plan);
    template <class Visit>
    void run(const NormalSource& normals, const Visit& visit) const;
    void make(const NormalSource& normals, std::span<double> field) const;
    void unpack(const RowGrid& from, std::span<const double> rows, std::span<double> field) const;

    std::array<std::size_t, 3> axis_;  ///< of the field, for each of the stages' axes
    CholeskyGenerator stage0_;
    std::vector<Halving> stages_;
    std::size_t normals_ = 0;
};

}  // namespace grainfield::randomfield
