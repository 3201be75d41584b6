#include "triaxial/scene/contact_table.hpp"

#include "kernels/contact_law.hpp"

namespace grainfield::triaxial {

std::vector<ContactRow> contact_table(const core::Simulation& simulation) {
    const core::ParticleStore& s = simulation.spheres();
    const core::ContactList& contacts = simulation.contacts();
    const auto pairs = contacts.pairs();
    const auto wall_pairs = contacts.wall_pairs();
    std::vector<ContactRow> rows;
    const auto add = [&](std::size_t c, std::int32_t i, std::int32_t j, double overlap, double k) {
        rows.push_back({i, j, overlap, k * overlap, contacts.shear(c), k});
    };
    for (std::size_t c = 0; c < pairs.size(); ++c) {
        if (!contacts.touching(c)) continue;
        const auto [i, j] = pairs[c];
        const double reach = s.radius[i] + s.radius[j];
        add(c, i, j, reach - (s.position[j] - s.position[i]).norm(),
            kernels::contact_stiffness(0.5 * reach, s.normal_stiffness[i], s.normal_stiffness[j]));
    }
    for (std::size_t k = 0; k < wall_pairs.size(); ++k) {
        const std::size_t c = pairs.size() + k;
        if (!contacts.touching(c)) continue;
        const auto [w, i] = wall_pairs[k];
        const core::Wall& wall = simulation.walls()[w];
        add(c, i, -1 - w, s.radius[i] - wall.normal.dot(s.position[i] - wall.point),
            kernels::contact_stiffness(s.radius[i], s.normal_stiffness[i], wall.normal_stiffness));
    }
    return rows;
}

}  // namespace grainfield::triaxial
