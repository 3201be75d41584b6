#pragma once
// The touching contacts, one row each.

#include <cstdint>
#include <vector>

#include "core/simulation.hpp"

namespace grainfield::triaxial {

struct ContactRow {
    std::int32_t i, j;        ///< spheres i < j, or sphere i and wall -1-j [-]
    double overlap;           ///< [m]
    double normal_force;      ///< compression positive [N]
    Vec3 shear_force;         ///< on i [N]
    double normal_stiffness;  ///< K_n, Eq. (4) of Tran et al. [N/m]
};

/// Contacts between spheres sorted by i, then j; then those with walls, by wall, then sphere.
/// compute_forces() must have been called at the present positions.
std::vector<ContactRow> contact_table(const core::Simulation& simulation);

}  // namespace grainfield::triaxial
