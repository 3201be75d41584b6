#include "randomfield/field_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "randomfield/marginals/marginals.hpp"
#include "randomfield/marginals/property_limits.hpp"

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
            "must be in [-1, 1]: beyond, [[1, rho], [rho, 1]] is no correlation matrix");
    require(positive(data_deviations), "field.data_deviations", fmt::format("{}", data_deviations),
            "must be positive and finite");
    randomfield::validate(friction, Property::friction_angle, "field.friction");
    randomfield::validate(stiffness, Property::normal_stiffness, "field.stiffness");
}

std::vector<std::string> unused_keys(const FieldOptions& options) {
    std::vector<std::string> lines;
    const FieldOptions defaults;
    for (const Property property : {Property::friction_angle, Property::normal_stiffness}) {
        if (!options.random(property)) continue;
        const bool friction = property == Property::friction_angle;
        const MarginalOptions& set = friction ? options.friction : options.stiffness;
        const MarginalOptions& usual = friction ? defaults.friction : defaults.stiffness;
        const bool bounded = set.kind == MarginalKind::bounded;
        const bool window =
            bounded || set.kind == MarginalKind::truncated_normal || set.kind == MarginalKind::beta;
        const auto check = [&](const char* name, bool used, bool changed) {
            if (!used && changed)
                lines.push_back(fmt::format("{}.{} has no effect with {}.marginal = \"{}\"",
                                            limits_of(property).key, name, limits_of(property).key,
                                            name_of(set.kind)));
        };
        check("minimum", window, set.minimum && set.minimum != usual.minimum);
        check("maximum", window, set.maximum && set.maximum != usual.maximum);
        check("s", bounded, set.s != usual.s);
        check("mean", !bounded, set.mean != usual.mean);
        check("cov", !bounded, set.cov != usual.cov);
    }
    return lines;
}

void FieldOptions::validate(const GridSpec& grid) const {
    validate();
    randomfield::validate(friction, Property::friction_angle, "field.friction", grid);
    randomfield::validate(stiffness, Property::normal_stiffness, "field.stiffness", grid);
}

}  // namespace grainfield::randomfield
