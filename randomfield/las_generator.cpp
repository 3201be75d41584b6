#include "randomfield/las_generator.hpp"

#include <algorithm>
#include <utility>

#include "randomfield/memory_limit.hpp"

namespace grainfield::randomfield {

// The grids of all stages, stage 0 first, and the axis along which each is halved. Axes as in the
// stages: the first one is contiguous in memory.
struct LasGenerator::Plan {
    std::vector<GridSpec> grids;
    std::vector<std::size_t> halved;
    std::array<std::size_t, 3> axis{0, 1, 2};
    CorrelationModel correlation;

    Plan(const GridSpec& grid, const CorrelationModel& model, std::int64_t stage0_cells)
        : correlation(model) {
        grid.validate();
        model.validate();
        // Three buffers, normals and field; with what FieldGenerator holds beside them more.
        require_memory(grid, 5.0 * static_cast<double>(grid.size()) * sizeof(double),
                       "field.method = \"las\"");
        grids.push_back(grid);
        while (static_cast<std::int64_t>(grids.back().size()) >
               std::max<std::int64_t>(1, stage0_cells)) {
            GridSpec coarse = grids.back();
            std::size_t along = 0;  // the longest correlation, counted in cells
            double longest = -1.0;
            for (std::size_t d = 0; d < 3; ++d) {
                const auto a = static_cast<Eigen::Index>(d);
                const double cells = model.length[a] / coarse.cell_size[a];
                if (coarse.cells[d] == 1 || cells <= longest) continue;
                longest = cells;
                along = d;
            }
            coarse.cells[along] = (coarse.cells[along] + 1) / 2;
            coarse.cell_size[static_cast<Eigen::Index>(along)] *= 2.0;
            grids.push_back(coarse);
            halved.push_back(along);
        }
        std::reverse(grids.begin(), grids.end());
        std::reverse(halved.begin(), halved.end());
        if (!halved.empty()) reorder_axes();
    }

  private:
    // Rows along the axis that is longest from the start: long vectors in all stages.
    void reorder_axes() {
        const CellCount first = grids.front().cells;
        const auto longest =
            static_cast<std::size_t>(std::max_element(first.begin(), first.end()) - first.begin());
        std::swap(axis[0], axis[longest]);
        for (GridSpec& grid : grids) {
            std::swap(grid.cells[0], grid.cells[longest]);
            std::swap(grid.cell_size[0], grid.cell_size[static_cast<Eigen::Index>(longest)]);
        }
        std::swap(correlation.length[0], correlation.length[static_cast<Eigen::Index>(longest)]);
        for (std::size_t& along : halved) {
            along = along == 0 ? longest : along == longest ? 0 : along;
        }
    }
};

LasGenerator::LasGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                           std::int64_t stage0_cells)
    : LasGenerator(grid, correlation, Plan(grid, correlation, stage0_cells)) {}

LasGenerator::LasGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                           const Plan& plan)
    : Generator(grid, correlation),
      axis_(plan.axis),
      stage0_(plan.grids.front(), plan.correlation),
      normals_(stage0_.normals()) {
    for (std::size_t s = 0; s < plan.halved.size(); ++s) {
        stages_.emplace_back(plan.grids[s], plan.grids[s + 1].cells, plan.halved[s],
                             plan.correlation);
        normals_ += stages_.back().size();
    }
}

double LasGenerator::stated_error() const {
    if (exact()) return Generator::stated_error();
    switch (correlation().kind) {
        case Correlation::markov:
            return 0.05;
        case Correlation::separable_markov:
            return 0.15;
        case Correlation::gaussian:
            return 0.105;
        case Correlation::spherical:
            return 0.11;
        case Correlation::matern32:
            return 0.065;
        case Correlation::matern52:
            return 0.075;
    }
    return Generator::stated_error();
}

CellCount LasGenerator::stage_cells(std::size_t stage) const {
    if (stages_.empty()) return grid().cells;
    const CellCount& cells =
        stage == stages_.size() ? stages_.back().children() : stages_.at(stage).parents();
    CellCount of_field{};
    for (std::size_t d = 0; d < 3; ++d) of_field[axis_[d]] = cells[d];
    return of_field;
}

// Calls visit(cells, rows) for the grid of every stage.
template <class Visit>
void LasGenerator::run(std::span<const double> normals, const Visit& visit) const {
    // Kept from field to field: fresh memory of this size would cost as much as the field.
    // Three buffers as large as the last grid, two of which take turns.
    thread_local std::vector<double> buffers[3];
    std::size_t largest = stage0_.normals();
    for (const Halving& stage : stages_) {
        largest = std::max(largest, GridSpec{stage.children(), {}}.size());
    }
    for (std::vector<double>& buffer : buffers) {
        if (buffer.size() < largest) buffer.resize(largest);
    }
    std::span<double> rows = buffers[0], children = buffers[1];
    const std::span<double> details = buffers[2];
    const CellCount& first = stages_.front().parents();
    const auto n0 = static_cast<std::size_t>(first[0]);
    const std::span<double> plain = details.first(stage0_.normals());
    stage0_.apply(normals.first(plain.size()), plain);
    for (std::size_t c = 0; c < plain.size(); ++c) {
        const auto i = static_cast<std::int32_t>(c % n0);
        rows[c - c % n0 + static_cast<std::size_t>(place_in_row(i, first[0]))] = plain[c];
    }
    visit(first, rows.first(plain.size()));
    std::size_t used = plain.size();
    for (const Halving& stage : stages_) {
        stage.draw_details(normals.subspan(used, stage.size()), rows, details);
        stage.make_children(rows, details, children);
        used += stage.size();
        std::swap(rows, children);
        visit(stage.children(), rows.first(GridSpec{stage.children(), {}}.size()));
    }
}

// From rows of the stages to the order of GridSpec::index().
void LasGenerator::unpack(const CellCount& cells, std::span<const double> rows,
                          std::span<double> field) const {
    std::array<std::size_t, 3> of_field{}, stride{};
    for (std::size_t d = 0; d < 3; ++d) of_field[axis_[d]] = static_cast<std::size_t>(cells[d]);
    for (std::size_t d = 0; d < 3; ++d) {
        stride[d] = axis_[d] == 0 ? 1 : axis_[d] == 1 ? of_field[0] : of_field[0] * of_field[1];
    }
    const auto n0 = static_cast<std::size_t>(cells[0]), n1 = static_cast<std::size_t>(cells[1]);
    const std::size_t half = (n0 + 1) / 2;
#pragma omp parallel for schedule(static) if (field.size() >= 32768)
    for (std::int32_t k = 0; k < cells[2]; ++k) {
        const double* plane = rows.data() + static_cast<std::size_t>(k) * n0 * n1;
        double* to = field.data() + static_cast<std::size_t>(k) * stride[2];
        if (axis_[0] == 0) {
            for (std::size_t j = 0; j < n1; ++j) {
                const double* row = plane + j * n0;
                double* line = to + j * stride[1];
                for (std::size_t t = 0; t < n0 / 2; ++t) {
                    line[2 * t] = row[t];
                    line[2 * t + 1] = row[half + t];
                }
                if (n0 % 2 == 1) line[n0 - 1] = row[half - 1];
            }
            continue;
        }
        // A transposition, in tiles that stay in the first cache.
        constexpr std::size_t tile = 16;
        for (std::size_t i0 = 0; i0 < n0; i0 += tile) {
            for (std::size_t j0 = 0; j0 < n1; j0 += tile) {
                for (std::size_t i = i0; i < std::min(n0, i0 + tile); ++i) {
                    const double* column = plane + (i % 2 == 0 ? i / 2 : half + i / 2);
                    double* line = to + i * stride[0];
                    for (std::size_t j = j0; j < std::min(n1, j0 + tile); ++j) {
                        line[j * stride[1]] = column[j * n0];
                    }
                }
            }
        }
    }
}

std::vector<std::vector<double>> LasGenerator::apply_stages(std::span<const double> normals) const {
    std::vector<std::vector<double>> fields;
    if (stages_.empty()) {
        fields.emplace_back(grid().size());
        stage0_.apply(normals, fields.front());
        return fields;
    }
    run(normals, [&](const CellCount& cells, std::span<const double> rows) {
        fields.emplace_back(rows.size());
        unpack(cells, rows, fields.back());
    });
    return fields;
}

void LasGenerator::apply(std::span<const double> normals, std::span<double> field) const {
    if (stages_.empty()) {
        stage0_.apply(normals, field);
        return;
    }
    run(normals, [&](const CellCount& cells, std::span<const double> rows) {
        if (rows.size() == field.size() && cells == stages_.back().children()) {
            unpack(cells, rows, field);
        }
    });
}

}  // namespace grainfield::randomfield
