#pragma once
// What the tests of the random field share.

#include <string>

#include "core/base/errors.hpp"
#include "randomfield/block_field.hpp"

namespace grainfield::randomfield {

inline constexpr auto friction = Property::friction_angle;
inline constexpr auto stiffness = Property::normal_stiffness;

/// Tran et al.'s anisotropy: theta_x = theta_z = 10 theta_y.
inline Vec3 paper_theta(double theta_y) {
    return {10.0 * theta_y, theta_y, 10.0 * theta_y};
}

/// The message of the InputError that the action throws; "" if it throws none.
template <class Action>
std::string input_error(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace grainfield::randomfield
