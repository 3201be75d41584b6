#include "randomfield/generators/generator.hpp"

#include <vector>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/generators/cholesky_generator.hpp"
#include "randomfield/generators/circulant_generator.hpp"
#include "randomfield/generators/las_classic_generator.hpp"
#include "randomfield/generators/las_generator.hpp"

namespace grainfield::randomfield {
namespace {

double gamma_of(const GridSpec& grid, const CorrelationModel& correlation) {
    grid.validate();
    correlation.validate();
    return LocalAverageCovariance(grid.cell_size, correlation, {1, 1, 1}).gamma();
}

}  // namespace

Generator::Generator(const GridSpec& grid, const CorrelationModel& correlation)
    : grid_(grid), correlation_(correlation), gamma_(gamma_of(grid, correlation)) {}

void Generator::draw(const core::RandomStream& random, std::uint64_t realization,
                     std::span<double> field) const {
    thread_local std::vector<double> normals;
    normals.resize(this->normals());
    random.normals(realization, 0, normals);
    apply(normals, field);
}

std::unique_ptr<const Generator> make_generator(const GridSpec& grid,
                                                const CorrelationModel& correlation, Method method,
                                                std::optional<std::int64_t> stage0_cells) {
    const std::int64_t stage0 = stage0_cells.value_or(LasGenerator::default_stage0_cells);
    switch (method) {
        case Method::las:
            return std::make_unique<LasGenerator>(grid, correlation, stage0);
        case Method::las_classic:
            return std::make_unique<LasClassicGenerator>(grid, correlation, stage0);
        case Method::cholesky:
            return std::make_unique<CholeskyGenerator>(grid, correlation);
        case Method::circulant:
            return std::make_unique<CirculantGenerator>(grid, correlation);
    }
    throw InputError("field.method: unknown");
}

}  // namespace grainfield::randomfield
