#include "randomfield/block_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "randomfield/marginals/property_limits.hpp"
#include "randomfield/memory_limit.hpp"

namespace grainfield::randomfield {
namespace {

FieldOptions checked(const FieldOptions& options, const GridSpec& grid) {
    options.validate();
    grid.validate();
    // At most at once: three buffers of the generator, G of both properties, and both properties.
    require_memory(grid, 7.0 * static_cast<double>(grid.size()) * sizeof(double),
                   "one realization");
    return options;
}

/// Data may lift a normal distribution, which has no bounds of its own, beyond what the property
/// can be.
void check_reach(const FieldOptions& options, const RowMarginals& rows,
                 const Conditioning* conditioning) {
    const Property property = rows.property();
    const MarginalKind kind =
        (property == Property::friction_angle ? options.friction : options.stiffness).kind;
    if (conditioning == nullptr || !options.random(property) || kind != MarginalKind::normal)
        return;
    const PropertyLimits limits = limits_of(property);
    const GridSpec& grid = rows.grid();
    const std::vector<double> mean = conditioning->mean(property);
    const std::vector<double> variance = conditioning->variance(property);
    for (std::size_t c = 0; c < mean.size(); ++c) {
        const CellCount cell = grid.cell_at(c);
        for (const double side : {-most_deviations, most_deviations}) {
            const double value = rows.row(cell[1])(mean[c] + side * std::sqrt(variance[c]));
            if (limits.contains(value)) continue;
            throw InputError(fmt::format(
                "{}: with these values {}.marginal = \"normal\" reaches {:.4g} {} at {:+g} "
                "standard deviations in cell ({}, {}, {}), allowed is {}: choose "
                "\"truncated-normal\" or \"beta\", a smaller cov, or other values",
                options.data, limits.key, value, limits.unit, side, cell[0], cell[1], cell[2],
                limits.text));
        }
    }
}

/// The property that a data file is about where its header does not say so.
std::optional<Property> only_property(const FieldOptions& options) {
    if (options.variable == Variable::friction) return Property::friction_angle;
    if (options.variable == Variable::stiffness) return Property::normal_stiffness;
    return std::nullopt;
}

std::shared_ptr<const Conditioning> make_conditioning(const FieldOptions& options,
                                                      const Generator& generator,
                                                      const RowMarginals& friction,
                                                      const RowMarginals& stiffness) {
    if (options.data.empty()) return nullptr;
    if (options.variable == Variable::none)
        throw InputError(
            fmt::format("field.data = \"{}\": field.variable = \"none\" leaves no random property "
                        "to condition; allowed are \"friction\", \"stiffness\" and \"both\"",
                        options.data));
    const auto marginals = [&](Property property) -> const RowMarginals* {
        if (!options.random(property)) return nullptr;
        return property == Property::friction_angle ? &friction : &stiffness;
    };
    const GridSpec& grid = generator.grid();
    const auto measurements = read_measurements(options.data, grid, only_property(options));
    const LocalAverageCovariance covariance(grid.cell_size, generator.correlation(), grid.cells);
    return std::make_shared<const Conditioning>(
        grid, covariance, options.cross_correlation,
        cell_data(options.data, measurements, grid, covariance, options.cross_correlation,
                  marginals, options.data_deviations),
        options.data);
}

}  // namespace

void BlockField::map(std::span<const double> column, std::span<const std::size_t> cell,
                     std::span<double> out) {
    if (column.empty()) return;
    for (std::size_t s = 0; s < cell.size(); ++s) out[s] = column[cell[s]];
}

FieldGenerator::FieldGenerator(const GridSpec& grid, const FieldOptions& options)
    : options_(checked(options, grid)),
      generator_(make_generator(grid, {options.correlation_length, options.correlation},
                                options.method, options.stage0_cells)),
      friction_(options.friction, Property::friction_angle, grid, generator_->gamma()),
      stiffness_(options.stiffness, Property::normal_stiffness, grid, generator_->gamma()),
      conditioning_(make_conditioning(options, *generator_, friction_, stiffness_)) {
    check_reach(options_, friction_, conditioning_.get());
    check_reach(options_, stiffness_, conditioning_.get());
}

BlockField FieldGenerator::gaussian(std::uint64_t realization) const {
    BlockField field;
    field.grid = grid();
    const auto draw_one = [&](core::Stream stream) {
        std::vector<double> g(grid().size());
        generator_->draw(core::RandomStream(options_.seed, stream), realization, g);
        return g;
    };
    if (options_.variable == Variable::stiffness) {
        field.G = draw_one(core::Stream::field_stiffness);
        return field;
    }
    field.G = draw_one(core::Stream::field_friction);
    if (options_.variable != Variable::both) return field;
    field.G_stiffness = draw_one(core::Stream::field_stiffness);
    const double rho = options_.cross_correlation;
    if (rho == 0.0) return field;
    const double rest = std::sqrt((1.0 - rho) * (1.0 + rho));
    for (std::size_t c = 0; c < field.G.size(); ++c)
        field.G_stiffness[c] = rho * field.G[c] + rest * field.G_stiffness[c];
    return field;
}

void FieldGenerator::condition(BlockField& field, std::uint64_t realization) const {
    if (!conditioning_) return;
    std::vector<double> errors(conditioning_->data().size());
    core::RandomStream(options_.seed, core::Stream::field_data).normals(realization, 0, errors);
    if (options_.variable == Variable::stiffness) {
        conditioning_->apply({}, field.G, errors);
    } else {
        conditioning_->apply(field.G, field.G_stiffness, errors);
    }
}

void FieldGenerator::transform(BlockField& field) const {
    if (options_.random(Property::friction_angle)) field.friction_angle = friction_.values(field.G);
    if (options_.random(Property::normal_stiffness))
        field.normal_stiffness =
            stiffness_.values(options_.variable == Variable::both ? field.G_stiffness : field.G);
}

BlockField FieldGenerator::draw(std::uint64_t realization) const {
    BlockField field = gaussian(realization);
    condition(field, realization);
    transform(field);
    return field;
}

BlockField FieldGenerator::draw_unconditional(std::uint64_t realization) const {
    BlockField field = gaussian(realization);
    transform(field);
    return field;
}

double FieldGenerator::stiffness_mean_ratio() const {
    if (!conditioning_ || !options_.random(Property::normal_stiffness))
        return stiffness_.mean_ratio();
    const std::vector<double> mean = conditioning_->mean(Property::normal_stiffness);
    const std::vector<double> variance = conditioning_->variance(Property::normal_stiffness);
    double sum = 0.0;
    for (std::size_t c = 0; c < mean.size(); ++c)
        sum += stiffness_.row(grid().cell_at(c)[1]).mean_given(mean[c], variance[c]);
    return sum / static_cast<double>(mean.size()) / stiffness_.point_mean();
}

double FieldGenerator::covariance_error() const {
    return randomfield::covariance_error(*generator_).covariance;
}

}  // namespace grainfield::randomfield
