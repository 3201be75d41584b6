#pragma once
// What values a property may have at all, and how files and messages call it.

#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "randomfield/marginals/marginal_options.hpp"

namespace grainfield::randomfield {

struct PropertyLimits {
    std::string_view name;  ///< of the column in files
    std::string_view key;   ///< of the config's table
    std::string_view unit;
    std::string_view text;  ///< what is allowed, in words
    double low = 0.0;       ///< [rad or Pa]
    double high = 0.0;      ///< never reached [rad or Pa]
    bool low_allowed = false;

    [[nodiscard]] bool contains(double value) const {
        return std::isfinite(value) && (value > low || (low_allowed && value == low)) &&
               value < high;
    }
};

inline PropertyLimits limits_of(Property property) {
    if (property == Property::friction_angle)
        return {"friction_angle",
                "field.friction",
                "rad",
                "in [0, pi/2)",
                0.0,
                std::numbers::pi / 2.0,
                true};
    return {"normal_stiffness",
            "field.stiffness",
            "Pa",
            "above 0 and finite",
            0.0,
            std::numeric_limits<double>::infinity(),
            false};
}

/// As the config calls it.
constexpr std::string_view name_of(MarginalKind kind) {
    switch (kind) {
        case MarginalKind::bounded:
            return "bounded";
        case MarginalKind::lognormal:
            return "lognormal";
        case MarginalKind::normal:
            return "normal";
        case MarginalKind::truncated_normal:
            return "truncated-normal";
        case MarginalKind::beta:
            return "beta";
        case MarginalKind::weibull:
            return "weibull";
    }
    return "?";
}

}  // namespace grainfield::randomfield
