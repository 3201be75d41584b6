#include "randomfield/generators/las_classic_generator.hpp"

#include <algorithm>
#include <utility>

namespace grainfield::randomfield {
namespace {

// The grid whose cells are 2 x 2 x 2 of this one's; a direction of one cell stays as it is.
GridSpec coarser(const GridSpec& fine) {
    GridSpec coarse = fine;
    for (std::size_t d = 0; d < 3; ++d) {
        if (fine.cells[d] == 1) continue;
        coarse.cells[d] = (fine.cells[d] + 1) / 2;
        coarse.cell_size[static_cast<Eigen::Index>(d)] *= 2.0;
    }
    return coarse;
}

// The grids of all stages, stage 0 first.
std::vector<GridSpec> grids_of_stages(const GridSpec& grid, std::int64_t stage0_cells) {
    std::vector<GridSpec> grids{grid};
    while (static_cast<std::int64_t>(grids.back().size()) >
           std::max<std::int64_t>(1, stage0_cells)) {
        grids.push_back(coarser(grids.back()));
    }
    std::reverse(grids.begin(), grids.end());
    return grids;
}

}  // namespace

LasClassicGenerator::LasClassicGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                                         std::int64_t stage0_cells)
    : Generator(grid, correlation),
      stage0_(grids_of_stages(grid, stage0_cells).front(), correlation) {
    normals_ = stage0_.normals();
    const std::vector<GridSpec> grids = grids_of_stages(grid, stage0_cells);
    for (std::size_t s = 1; s < grids.size(); ++s) {
        Stage stage;
        stage.parents = grids[s - 1].cells;
        stage.children = grids[s].cells;
        stage.children_each = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            stage.split[d] = stage.children[d] > 1 ? 2 : 1;
            stage.children_each *= static_cast<std::size_t>(stage.split[d]);
        }
        stage.stencils =
            subdivision_stencils(grids[s].cell_size, stage.split, correlation, stage.parents);
        normals_ += grids[s - 1].size() * (stage.children_each - 1);
        stages_.push_back(std::move(stage));
    }
}

const CellCount& LasClassicGenerator::stage_cells(std::size_t stage) const {
    return stage == stages_.size() ? grid().cells : stages_.at(stage).parents;
}

void LasClassicGenerator::subdivide(const Stage& stage, std::span<const double> normals,
                                    std::span<const double> parents,
                                    std::span<double> children) const {
    constexpr std::size_t kMax = SubdivisionStencil::max_children;
    const GridSpec coarse{stage.parents, grid().cell_size};
    const GridSpec fine{stage.children, grid().cell_size};
    const std::size_t noisy = stage.children_each - 1;
    // Each parent writes its own children only, and always by the same sums.
#pragma omp parallel for schedule(static) if (coarse.size() > 4096)
    for (std::int32_t k = 0; k < stage.parents[2]; ++k) {
        for (std::int32_t j = 0; j < stage.parents[1]; ++j) {
            for (std::int32_t i = 0; i < stage.parents[0]; ++i) {
                const SubdivisionStencil& stencil =
                    stage.stencils[neighbourhood_of({i, j, k}, stage.parents).id()];
                const std::size_t parent = coarse.index(i, j, k);
                std::array<double, kMax> child{};
                for (std::size_t n = 0; n < stencil.neighbours.size(); ++n) {
                    const CellCount& at = stencil.neighbours[n];
                    const double z = parents[coarse.index(i + at[0], j + at[1], k + at[2])];
                    const auto& weight = stencil.weights[n];
                    for (std::size_t c = 0; c < kMax; ++c) child[c] += weight[c] * z;
                }
                for (std::size_t n = 0; n < noisy; ++n) {
                    const double u = normals[parent * noisy + n];
                    for (std::size_t c = 0; c < kMax; ++c) child[c] += stencil.noise[n][c] * u;
                }
                // Conservation: the mean of the children is the parent.
                double last = static_cast<double>(stage.children_each) * parents[parent];
                for (std::size_t c = 0; c < noisy; ++c) last -= child[c];
                child[noisy] = last;

                std::size_t c = 0;
                for (std::int32_t dk = 0; dk < stage.split[2]; ++dk) {
                    for (std::int32_t dj = 0; dj < stage.split[1]; ++dj) {
                        for (std::int32_t di = 0; di < stage.split[0]; ++di, ++c) {
                            const std::int32_t ci = stage.split[0] * i + di;
                            const std::int32_t cj = stage.split[1] * j + dj;
                            const std::int32_t ck = stage.split[2] * k + dk;
                            if (ci < fine.cells[0] && cj < fine.cells[1] && ck < fine.cells[2]) {
                                children[fine.index(ci, cj, ck)] = child[c];
                            }
                        }
                    }
                }
            }
        }
    }
}

std::vector<std::vector<double>> LasClassicGenerator::apply_stages(
    std::span<const double> normals) const {
    std::vector<std::vector<double>> fields(1, std::vector<double>(stage0_.normals()));
    stage0_.apply(normals.first(stage0_.normals()), fields[0]);
    std::size_t used = stage0_.normals();
    for (const Stage& stage : stages_) {
        const std::size_t count = fields.back().size() * (stage.children_each - 1);
        std::vector<double> children(GridSpec{stage.children, grid().cell_size}.size());
        subdivide(stage, normals.subspan(used, count), fields.back(), children);
        fields.push_back(std::move(children));
        used += count;
    }
    return fields;
}

void LasClassicGenerator::apply(std::span<const double> normals, std::span<double> field) const {
    if (stages_.empty()) {
        stage0_.apply(normals, field);
        return;
    }
    const auto fields = apply_stages(normals);
    std::copy(fields.back().begin(), fields.back().end(), field.begin());
}

}  // namespace grainfield::randomfield
