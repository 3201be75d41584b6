#include "randomfield/generators/las_generator.hpp"

#include <algorithm>
#include <utility>

#include "core/base/aligned.hpp"
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
        require_memory(grid, 4.0 * static_cast<double>(grid.size()) * sizeof(double),
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
        if (halved.empty()) return;
        reorder_axes();
        // Parents, details and children in rows, normals and field; with what FieldGenerator holds
        // beside them more. The rows of flat grids that are short take more than their cells.
        const double rows =
            static_cast<double>(RowGrid(grids.back().cells).size()) +
            2.0 * static_cast<double>(RowGrid(grids[halved.size() - 1].cells).size());
        require_memory(grid, (rows + 2.0 * static_cast<double>(grid.size())) * sizeof(double),
                       "field.method = \"las\"");
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

// Calls visit(grid, rows) for the grid of every stage.
template <class Visit>
void LasGenerator::run(const NormalSource& normals, const Visit& visit) const {
    // Kept from field to field: fresh memory of this size would cost as much as the field.
    thread_local core::Aligned<double> buffers[3];
    const auto buffer = [&](std::size_t b, std::size_t size) {
        if (buffers[b].size() < size) buffers[b].resize(size);
        return std::span<double>(buffers[b]).first(size);
    };
    const RowGrid first(stages_.front().parents());
    const std::span<double> plain = buffer(2, stage0_.normals());
    const std::span<double> rest = buffer(1, plain.size());
    stage0_.apply({normals.get(0, rest), plain.size()}, plain);
    const std::span<double> rows = buffer(0, first.size());
    std::fill(rows.begin(), rows.end(), 0.0);
    const auto n0 = static_cast<std::size_t>(first.cells[0]);
    for (std::size_t c = 0; c < plain.size(); ++c) {
        rows[c / n0 * first.row.size + first.row.place(c % n0)] = plain[c];
    }
    visit(first, rows);
    std::size_t used = plain.size();
    std::size_t from = 0;  // the buffers of parents and of children take turns
    for (const Halving& stage : stages_) {
        const RowGrid parents(stage.parents()), children(stage.children());
        const std::span<double> halves = buffer(1 - from, children.size());
        stage.make_children(normals, used, buffer(from, parents.size()), buffer(2, parents.size()),
                            halves);
        used += stage.size();
        from = 1 - from;
        visit(children, halves);
    }
}

// From rows of the stages to the order of GridSpec::index().
void LasGenerator::unpack(const RowGrid& from, std::span<const double> rows,
                          std::span<double> field) const {
    std::array<std::size_t, 3> of_field{}, stride{};
    for (std::size_t d = 0; d < 3; ++d) {
        of_field[axis_[d]] = static_cast<std::size_t>(from.cells[d]);
    }
    for (std::size_t d = 0; d < 3; ++d) {
        stride[d] = axis_[d] == 0 ? 1 : axis_[d] == 1 ? of_field[0] : of_field[0] * of_field[1];
    }
    const auto n0 = static_cast<std::size_t>(from.cells[0]);
    // The axis along which the field is contiguous, and the third one, over which threads work.
    const std::size_t contiguous = axis_[0] == 0 || axis_[1] == 0 ? 1 : 2, third = 3 - contiguous;
#pragma omp parallel for schedule(static) if (field.size() >= 32768)
    for (std::int32_t s = 0; s < from.cells[third]; ++s) {
        const auto row_at = [&](std::int32_t r) {
            return rows.data() + (contiguous == 1 ? from.at(r, s) : from.at(s, r));
        };
        double* to = field.data() + static_cast<std::size_t>(s) * stride[third];
        if (axis_[0] == 0) {
            for (std::int32_t r = 0; r < from.cells[contiguous]; ++r) {
                row_in_order(n0, row_at(r), to + static_cast<std::size_t>(r) * stride[contiguous]);
            }
        } else {
            rows_to_columns(n0, of_field[0], from.at(contiguous == 1, contiguous == 2), row_at(0),
                            stride[0], to);
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
    run(NormalSource(normals), [&](const RowGrid& cells, std::span<const double> rows) {
        fields.emplace_back(GridSpec{cells.cells, {}}.size());
        unpack(cells, rows, fields.back());
    });
    return fields;
}

void LasGenerator::apply(std::span<const double> normals, std::span<double> field) const {
    if (stages_.empty()) return stage0_.apply(normals, field);
    make(NormalSource(normals), field);
}

void LasGenerator::draw(const core::RandomStream& random, std::uint64_t realization,
                        std::span<double> field) const {
    if (stages_.empty()) return Generator::draw(random, realization, field);
    make(NormalSource(random, realization), field);
}

void LasGenerator::make(const NormalSource& normals, std::span<double> field) const {
    run(normals, [&](const RowGrid& cells, std::span<const double> rows) {
        if (cells.cells == stages_.back().children()) unpack(cells, rows, field);
    });
}

}  // namespace grainfield::randomfield
