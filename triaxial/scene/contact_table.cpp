#include "triaxial/scene/contact_table.hpp"

#include "kernels/contact_law.hpp"

namespace grainfield::triaxial {

std::vector<ContactRow> contact_table(const core::Simulation& simulation) {
    const core::ParticleStore& s = simulation.spheres();
    std::vector<ContactRow> rows;
    for (const auto& [i, j, shear, force] : simulation.contacts().touching()) {
        double overlap = 0, k = 0;
        if (j >= 0) {
            const double reach = s.radius[i] + s.radius[j];
            overlap = reach - (s.position[j] - s.position[i]).norm();
            k = kernels::contact_stiffness(0.5 * reach, s.normal_stiffness[i],
                                           s.normal_stiffness[j]);
        } else {
            const core::Wall& wall = simulation.walls()[static_cast<std::size_t>(-1 - j)];
            overlap = s.radius[i] - wall.normal.dot(s.position[i] - wall.point);
            k = kernels::contact_stiffness(s.radius[i], s.normal_stiffness[i],
                                           wall.normal_stiffness);
        }
        rows.push_back({i, j, overlap, k * overlap, shear, k});
    }
    return rows;
}

}  // namespace grainfield::triaxial
