#include "randomfield/field_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"
#include "randomfield/marginals.hpp"

namespace grainfield::randomfield {
namespace {

void require(bool ok, const std::string& key, const std::string& value, const char* allowed) {
    if (!ok) throw InputError(fmt::format("{} = {}: {}", key, value, allowed));
}

bool positive(double x) {
    return x > 0.0 && std::isfinite(x);
}

}  // namespace

void FieldOptions::validate() const {
    const Vec3& theta = correlation_length;
    require(positive(theta[0]) && positive(theta[1]) && positive(theta[2]),
            "field.correlation_length", fmt::format("[{}, {}, {}]", theta[0], theta[1], theta[2]),
            "each correlation length must be positive and finite (m)");
    require(!stage0_cells || *stage0_cells >= 1, "field.stage0_cells",
            fmt::format("{}", stage0_cells.value_or(1)), "must be at least 1");

    require(std::abs(cross_correlation) <= 1.0, "field.cross_correlation",
            fmt::format("{}", cross_correlation),
            "the correlation matrix [[1, rho], [rho, 1]] is not positive definite: rho must be in "
            "[-1, 1]");
    randomfield::validate(friction, Property::friction_angle, "field.friction");
    randomfield::validate(stiffness, Property::normal_stiffness, "field.stiffness");
}

void FieldOptions::validate(const GridSpec& grid) const {
    validate();
    randomfield::validate(friction, Property::friction_angle, "field.friction", grid);
    randomfield::validate(stiffness, Property::normal_stiffness, "field.stiffness", grid);
}

}  // namespace grainfield::randomfield
