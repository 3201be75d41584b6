#include "randomfield/generators/cholesky_generator.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"

namespace grainfield::randomfield {
namespace {

// Covariance of all cells with all cells, in the order of GridSpec::index().
std::vector<double> covariance_matrix(const GridSpec& grid, const LocalAverageCovariance& of_lag) {
    const std::size_t n = grid.size();
    const auto [nx, ny, nz] = grid.cells;
    std::vector<double> matrix(n * n);
    double* entry = matrix.data();
    for (std::int32_t kb = 0; kb < nz; ++kb) {
        for (std::int32_t jb = 0; jb < ny; ++jb) {
            for (std::int32_t ib = 0; ib < nx; ++ib) {
                for (std::int32_t k = 0; k < nz; ++k) {
                    for (std::int32_t j = 0; j < ny; ++j) {
                        for (std::int32_t i = 0; i < nx; ++i) {
                            *entry++ = of_lag(i - ib, j - jb, k - kb);
                        }
                    }
                }
            }
        }
    }
    return matrix;
}

LowerFactor factor_of(const GridSpec& grid, const CorrelationModel& correlation) {
    if (grid.size() > LowerFactor::max_size) {
        throw InputError(fmt::format(
            "random field: the exact factor of {} x {} x {} = {} cells does not fit: at "
            "most {} cells are allowed for field.method = \"cholesky\" and for "
            "field.stage0_cells",
            grid.cells[0], grid.cells[1], grid.cells[2], grid.size(), LowerFactor::max_size));
    }
    const LocalAverageCovariance of_lag(grid.cell_size, correlation, grid.cells);
    auto factor = LowerFactor::of(covariance_matrix(grid, of_lag), grid.size());
    if (!factor) {
        const Vec3& theta = correlation.length;
        throw InputError(
            fmt::format("field.correlation_length = [{}, {}, {}] m: no field exists in double "
                        "precision for cells of {} x {} x {} m (variance of a cell {:.3g}); "
                        "allowed is 0.001 of a cell to 1e4 domains",
                        theta[0], theta[1], theta[2], grid.cell_size[0], grid.cell_size[1],
                        grid.cell_size[2], of_lag.gamma()));
    }
    return *std::move(factor);
}

}  // namespace

CholeskyGenerator::CholeskyGenerator(const GridSpec& grid, const CorrelationModel& correlation)
    : Generator(grid, correlation), factor_(factor_of(grid, correlation)) {}

}  // namespace grainfield::randomfield
