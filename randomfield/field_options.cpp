#include "randomfield/field_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"

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

    const double half_pi = std::numbers::pi / 2.0;
    require(friction.minimum >= 0.0 && friction.minimum < half_pi, "field.friction.minimum",
            fmt::format("{}", friction.minimum), "must be in [0, pi/2) (rad)");
    require(friction.maximum > friction.minimum && friction.maximum < half_pi,
            "field.friction.maximum", fmt::format("{}", friction.maximum),
            "must be above field.friction.minimum and below pi/2 (rad)");
    require(positive(friction.s), "field.friction.s", fmt::format("{}", friction.s),
            "must be positive and finite");

    require(positive(stiffness.mean), "field.stiffness.mean", fmt::format("{}", stiffness.mean),
            "must be positive and finite (Pa)");
    require(positive(stiffness.cov), "field.stiffness.cov", fmt::format("{}", stiffness.cov),
            "must be positive and finite");
}

}  // namespace grainfield::randomfield
