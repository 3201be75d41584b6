#include "randomfield/generators/subdivision_stencil.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/generators/lower_factor.hpp"

namespace grainfield::randomfield {
namespace {

LowerFactor factor(std::vector<double> matrix, std::size_t size, double scale,
                   const CorrelationModel& correlation) {
    auto result = LowerFactor::of(std::move(matrix), size, scale);
    if (!result) {
        throw InputError(
            fmt::format("field.correlation_length = [{}, {}, {}] m: the subdivision of this grid "
                        "cannot be computed in double precision; use field.method = \"cholesky\"",
                        correlation.length[0], correlation.length[1], correlation.length[2]));
    }
    return *std::move(result);
}

// Covariances of children and parents, all from the children's: a parent is the mean of its own.
class FamilyCovariance {
  public:
    FamilyCovariance(const Vec3& child_size, const CellCount& split,
                     const CorrelationModel& correlation)
        // Parents at most 2 apart: their children at most 3 split - 1 cells apart.
        : of_lag_(child_size, correlation, {3 * split[0], 3 * split[1], 3 * split[2]}) {
        for (std::int32_t k = 0; k < split[2]; ++k) {
            for (std::int32_t j = 0; j < split[1]; ++j) {
                for (std::int32_t i = 0; i < split[0]; ++i) children_.push_back({i, j, k});
            }
        }
        split_ = split;
    }

    [[nodiscard]] std::size_t children() const { return children_.size(); }
    [[nodiscard]] double gamma() const { return of_lag_.gamma(); }

    // Child a of the parent at the origin with child b of the parent at `offset`.
    [[nodiscard]] double child_child(std::size_t a, const CellCount& offset, std::size_t b) const {
        const CellCount& p = children_[a];
        const CellCount& q = children_[b];
        return of_lag_(split_[0] * offset[0] + q[0] - p[0], split_[1] * offset[1] + q[1] - p[1],
                       split_[2] * offset[2] + q[2] - p[2]);
    }
    [[nodiscard]] double child_parent(std::size_t a, const CellCount& offset) const {
        double sum = 0.0;
        for (std::size_t b = 0; b < children(); ++b) sum += child_child(a, offset, b);
        return sum / static_cast<double>(children());
    }
    [[nodiscard]] double parent_parent(const CellCount& offset) const {
        double sum = 0.0;
        for (std::size_t a = 0; a < children(); ++a) sum += child_parent(a, offset);
        return sum / static_cast<double>(children());
    }

  private:
    LocalAverageCovariance of_lag_;
    CellCount split_{};
    std::vector<CellCount> children_;
};

std::vector<CellCount> neighbour_offsets(const Neighbourhood& around) {
    std::vector<CellCount> offsets;
    for (std::int32_t k = around.below[2] ? -1 : 0; k <= (around.above[2] ? 1 : 0); ++k) {
        for (std::int32_t j = around.below[1] ? -1 : 0; j <= (around.above[1] ? 1 : 0); ++j) {
            for (std::int32_t i = around.below[0] ? -1 : 0; i <= (around.above[0] ? 1 : 0); ++i) {
                offsets.push_back({i, j, k});
            }
        }
    }
    return offsets;
}

SubdivisionStencil stencil_of(const FamilyCovariance& covariance,
                              const CorrelationModel& correlation, const Neighbourhood& around) {
    SubdivisionStencil stencil;
    stencil.children = covariance.children();
    stencil.neighbours = neighbour_offsets(around);
    const std::size_t np = stencil.neighbours.size();
    const std::size_t nc = stencil.children - 1;  // those with noise of their own

    // R = covariance of the parents = L L^T.
    std::vector<double> parents(np * np);
    for (std::size_t a = 0; a < np; ++a) {
        for (std::size_t b = 0; b < np; ++b) {
            const CellCount& p = stencil.neighbours[a];
            const CellCount& q = stencil.neighbours[b];
            parents[a + b * np] = covariance.parent_parent({q[0] - p[0], q[1] - p[1], q[2] - p[2]});
        }
    }
    const LowerFactor l = factor(std::move(parents), np, covariance.gamma(), correlation);

    // Best linear estimate of child c: weights R^-1 s_c, s_c = its covariance with the parents.
    std::vector<std::vector<double>> half(nc);  // w_c = L^-1 s_c
    stencil.weights.assign(np, {});
    for (std::size_t c = 0; c < nc; ++c) {
        half[c].resize(np);
        for (std::size_t p = 0; p < np; ++p) {
            half[c][p] = covariance.child_parent(c, stencil.neighbours[p]);
        }
        l.solve_lower(half[c]);
        std::vector<double> weights = half[c];
        l.solve_upper(weights);
        for (std::size_t p = 0; p < np; ++p) stencil.weights[p][c] = weights[p];
    }

    // What the estimate leaves is the noise: B_cd = C_cd - s_c^T R^-1 s_d = C_cd - w_c^T w_d.
    // Where the parents determine the children to round-off it is round-off of C: hence the scale.
    std::vector<double> rest(nc * nc);
    for (std::size_t c = 0; c < nc; ++c) {
        for (std::size_t d = 0; d < nc; ++d) {
            double sum = covariance.child_child(c, {0, 0, 0}, d);
            for (std::size_t p = 0; p < np; ++p) sum -= half[c][p] * half[d][p];
            rest[c + d * nc] = sum;
        }
    }
    const LowerFactor noise = factor(std::move(rest), nc, covariance.gamma(), correlation);
    for (std::size_t n = 0; n < nc; ++n) {
        for (std::size_t c = n; c < nc; ++c) stencil.noise[n][c] = noise(c, n);
    }
    return stencil;
}

}  // namespace

SubdivisionStencil subdivision_stencil(const Vec3& child_size, const CellCount& split,
                                       const CorrelationModel& correlation,
                                       const Neighbourhood& neighbourhood) {
    return stencil_of(FamilyCovariance(child_size, split, correlation), correlation, neighbourhood);
}

Neighbourhood neighbourhood_of(const CellCount& parent, const CellCount& parents) {
    Neighbourhood around;
    for (std::size_t d = 0; d < 3; ++d) {
        around.below[d] = parent[d] > 0;
        around.above[d] = parent[d] + 1 < parents[d];
    }
    return around;
}

std::array<SubdivisionStencil, 64> subdivision_stencils(const Vec3& child_size,
                                                        const CellCount& split,
                                                        const CorrelationModel& correlation,
                                                        const CellCount& parents) {
    const FamilyCovariance covariance(child_size, split, correlation);
    std::array<SubdivisionStencil, 64> stencils;
    // First, second (if any) and last cell of each direction see every neighbourhood there is.
    const auto next = [](std::int32_t i, std::int32_t n) {
        return i == 0 && n > 2 ? 1 : i < n - 1 ? n - 1 : n;
    };
    for (std::int32_t k = 0; k < parents[2]; k = next(k, parents[2])) {
        for (std::int32_t j = 0; j < parents[1]; j = next(j, parents[1])) {
            for (std::int32_t i = 0; i < parents[0]; i = next(i, parents[0])) {
                const Neighbourhood around = neighbourhood_of({i, j, k}, parents);
                stencils[around.id()] = stencil_of(covariance, correlation, around);
            }
        }
    }
    return stencils;
}

}  // namespace grainfield::randomfield
