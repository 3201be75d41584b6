#include "randomfield/block_field.hpp"

#include "core/random.hpp"

namespace grainfield::randomfield {
namespace {

FieldOptions checked(const FieldOptions& options) {
    options.validate();
    return options;
}

}  // namespace

void BlockField::map(std::span<const double> column, std::span<const std::size_t> cell,
                     std::span<double> out) {
    if (column.empty()) return;
    for (std::size_t s = 0; s < cell.size(); ++s) out[s] = column[cell[s]];
}

FieldGenerator::FieldGenerator(const GridSpec& grid, const FieldOptions& options)
    : options_(checked(options)),
      generator_(make_generator(grid, {options.correlation_length, options.correlation},
                                options.method, options.stage0_cells)),
      stiffness_(options.stiffness, generator_->gamma()) {}

BlockField FieldGenerator::draw(std::uint64_t realization) const {
    BlockField field;
    field.grid = grid();
    std::vector<double> normals(generator_->normals());
    const auto gaussian = [&](core::Stream stream) {
        core::RandomStream(options_.seed, stream).normals(realization, 0, normals);
        std::vector<double> g(grid().size());
        generator_->apply(normals, g);
        return g;
    };
    const bool both = options_.variable == Variable::both;
    if (options_.variable == Variable::stiffness) {
        field.G = gaussian(core::Stream::field_stiffness);
    } else {
        field.G = gaussian(core::Stream::field_friction);
    }
    if (both) field.G_stiffness = gaussian(core::Stream::field_stiffness);

    if (both || options_.variable == Variable::friction) {
        for (const double g : field.G) {
            field.friction_angle.push_back(randomfield::friction_angle(options_.friction, g));
        }
    }
    if (both || options_.variable == Variable::stiffness) {
        for (const double g : both ? field.G_stiffness : field.G) {
            field.normal_stiffness.push_back(stiffness_(g));
        }
    }
    return field;
}

double FieldGenerator::covariance_error() const {
    return randomfield::covariance_error(*generator_).covariance;
}

}  // namespace grainfield::randomfield
