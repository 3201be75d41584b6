#include "randomfield/verification/field_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"

namespace grainfield::randomfield {
namespace {

void check_size(const GridSpec& grid, std::size_t most) {
    if (grid.size() > most) {
        throw InputError(
            fmt::format("random field: the covariance matrix of {} x {} x {} = {} cells is not "
                        "computed: at most {} cells are allowed",
                        grid.cells[0], grid.cells[1], grid.cells[2], grid.size(), most));
    }
}

}  // namespace

Eigen::MatrixXd linear_map(const Generator& generator) {
    check_size(generator.grid(), max_slow_error_cells);
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
    check_size(grid, max_error_cells);
    const LocalAverageCovariance of_lag(grid.cell_size, correlation, grid.cells);
    const auto n = static_cast<Eigen::Index>(grid.size());
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index b = 0; b < n; ++b) {
        const CellCount q = grid.cell_at(static_cast<std::size_t>(b));
        for (Eigen::Index a = 0; a < n; ++a) {
            const CellCount p = grid.cell_at(static_cast<std::size_t>(a));
            covariance(a, b) = of_lag(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        }
    }
    return covariance;
}

CovarianceError covariance_error(const Generator& generator) {
    const GridSpec& grid = generator.grid();
    if (const auto known = generator.known_error())
        return {.covariance = *known,
                .variance = *known,
                .variances = std::vector<double>(grid.size(), 1.0)};
    const Eigen::MatrixXd map = linear_map(generator);
    const LocalAverageCovariance of_lag(grid.cell_size, generator.correlation(), grid.cells);
    const Eigen::Index n = map.rows();
    constexpr Eigen::Index block = 256;
    CovarianceError error;
    error.variances.resize(grid.size());
    Eigen::MatrixXd product;
    for (Eigen::Index first = 0; first < n; first += block) {
        const Eigen::Index rows = std::min(block, n - first);
        // Symmetric: the columns up to the block's last row do.
        product.noalias() = map.topRows(first + rows) * map.middleRows(first, rows).transpose();
        for (Eigen::Index b = 0; b < rows; ++b) {
            const CellCount q = grid.cell_at(static_cast<std::size_t>(first + b));
            for (Eigen::Index a = 0; a <= first + b; ++a) {
                const CellCount p = grid.cell_at(static_cast<std::size_t>(a));
                const double exact = of_lag(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
                error.covariance = std::max(error.covariance, std::abs(product(a, b) - exact));
            }
            const double variance = product(first + b, b);
            error.variance = std::max(error.variance, std::abs(variance - generator.gamma()));
            error.variances[static_cast<std::size_t>(first + b)] = variance / generator.gamma();
        }
    }
    error.covariance /= generator.gamma();
    error.variance /= generator.gamma();
    return error;
}

}  // namespace grainfield::randomfield
