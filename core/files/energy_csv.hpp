#pragma once
// Columns of energy.csv (docs/interface.md, "Files").

#include <array>

#include "core/scene/energy.hpp"

namespace grainfield::core {

inline constexpr const char* energy_header =
    "time_s,kinetic_J,rotational_J,elastic_normal_J,elastic_shear_J,friction_work_J,"
    "damping_work_J,external_work_J,gravity_J";

/// A row without its time: terms whose sum stays constant, so the work put in has a minus [J].
inline std::array<double, 8> energy_columns(const Energy& e) {
    // 0 - w, not -w: a wall that did no work shows as 0, not as -0.
    return {e.kinetic,       e.rotational,   e.elastic_normal,      e.elastic_shear,
            e.friction_work, e.damping_work, 0.0 - e.external_work, e.gravity};
}

/// energy_columns() undone.
inline Energy energy_of_columns(const std::array<double, 8>& c) {
    return {.kinetic = c[0],
            .rotational = c[1],
            .elastic_normal = c[2],
            .elastic_shear = c[3],
            .friction_work = c[4],
            .damping_work = c[5],
            .external_work = -c[6],
            .gravity = c[7]};
}

}  // namespace grainfield::core
