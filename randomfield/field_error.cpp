#include "randomfield/field_error.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/errors.hpp"
#include "randomfield/covariance.hpp"

namespace grainfield::randomfield {
namespace {

void check_size(const GridSpec& grid) {
    if (grid.size() > max_error_cells) {
        throw InputError(
            fmt::format("random field: the covariance error of {} cells is not computed: at most "
                        "{} cells are allowed",
                        grid.size(), max_error_cells));
    }
}

}  // namespace

Eigen::MatrixXd linear_map(const Generator& generator) {
    check_size(generator.grid());
    const auto cells = static_cast<Eigen::Index>(generator.grid().size());
    const auto normals = static_cast<Eigen::Index>(generator.normals());
    Eigen::MatrixXd map(cells, normals);
    std::vector<double> unit(generator.normals(), 0.0);
    for (Eigen::Index u = 0; u < normals; ++u) {
        unit[static_cast<std::size_t>(u)] = 1.0;
        generator.apply(unit, {map.col(u).data(), generator.grid().size()});
        unit[static_cast<std::size_t>(u)] = 0.0;
    }
    return map;
}

Eigen::MatrixXd exact_covariance(const GridSpec& grid, const CorrelationModel& correlation) {
    check_size(grid);
    const LocalAverageCovariance of_lag(grid.cell_size, correlation, grid.cells);
    const auto [nx, ny, nz] = grid.cells;
    const auto n = static_cast<Eigen::Index>(grid.size());
    const auto cell = [nx = nx, ny = ny](Eigen::Index index) {
        const auto i = static_cast<std::int32_t>(index);
        return CellCount{i % nx, i / nx % ny, i / nx / ny};
    };
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index b = 0; b < n; ++b) {
        const CellCount q = cell(b);
        for (Eigen::Index a = 0; a < n; ++a) {
            const CellCount p = cell(a);
            covariance(a, b) = of_lag(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        }
    }
    return covariance;
}

CovarianceError covariance_error(const Generator& generator) {
    const Eigen::MatrixXd map = linear_map(generator);
    const Eigen::MatrixXd error =
        map * map.transpose() - exact_covariance(generator.grid(), generator.correlation());
    return {error.cwiseAbs().maxCoeff() / generator.gamma(),
            error.diagonal().cwiseAbs().maxCoeff() / generator.gamma()};
}

}  // namespace grainfield::randomfield
