#include "core/drive/measures.hpp"

#include <Eigen/Eigenvalues>
#include <vector>

#include "core/base/parallel.hpp"
#include "kernels/contact_law.hpp"

namespace grainfield::core {

std::vector<Branch> force_branches(const Simulation& simulation) {
    const ParticleStore& s = simulation.spheres();
    std::vector<Branch> branches;
    for (const TouchingContact& c : simulation.contacts().touching()) {
        const Vec3 x = s.position[c.i];
        if (c.j >= 0) {
            branches.push_back({x, s.position[c.j], -c.force});
        } else {
            const Wall& wall = simulation.walls()[static_cast<std::size_t>(-1 - c.j)];
            const Vec3 foot = x - wall.normal.dot(x - wall.point) * wall.normal;
            branches.push_back({x, foot, -c.force});
        }
    }
    return branches;
}

double kinetic_energy(const Simulation& simulation) {
    const ParticleStore& s = simulation.spheres();
    return sum_over<double>(
        s.size(), [&](std::size_t i) { return 0.5 * s.mass[i] * s.velocity[i].squaredNorm(); });
}

Eigen::Matrix3d mean_stress(const Simulation& simulation, double volume) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Branch& b : force_branches(simulation)) sum += b.force * (b.to - b.from).transpose();
    return sum / volume;
}

Fabric measure_fabric(const Simulation& simulation) {
    const std::vector<TouchingContact> contacts = simulation.contacts().touching();
    const ParticleStore& s = simulation.spheres();
    const std::size_t n = s.size();
    Fabric fabric;
    if (n == 0) return fabric;
    std::vector<int> count(n, 0);
    double normals = 0;
    for (const auto& [i, j, shear, force] : contacts) {
        ++count[i];
        if (j >= 0) ++count[j];
        const Vec3 normal = j >= 0 ? Vec3((s.position[j] - s.position[i]).normalized())
                                   : simulation.walls()[static_cast<std::size_t>(-1 - j)].normal;
        fabric.tensor += normal * normal.transpose();
        normals += 1;
    }
    if (normals > 0) {
        fabric.tensor /= normals;
        const Vec3 values =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(fabric.tensor).eigenvalues();
        fabric.anisotropy = values[2] - values[0];
    }
    // 2C of Thornton is the sum over the spheres, and so are contacts with walls: one each.
    double contacts_of_all = 0, rattlers = 0, rattler_volume = 0, volume = 0, single = 0;
    for (std::size_t i = 0; i < n; ++i) {
        contacts_of_all += count[i];
        const double v = s.radius[i] * s.radius[i] * s.radius[i];
        volume += v;
        if (count[i] > 1) continue;
        single += count[i];
        rattlers += 1;
        rattler_volume += v;
    }
    const auto spheres = static_cast<double>(n);
    fabric.coordination_number = contacts_of_all / spheres;
    fabric.rattler_fraction = rattlers / spheres;
    fabric.rattler_volume_fraction = rattler_volume / volume;
    // Thornton (2000), Z_m = (2C - N1)/(N - N0 - N1).
    if (rattlers < spheres)
        fabric.mechanical_coordination_number = (contacts_of_all - single) / (spheres - rattlers);
    return fabric;
}

double stiffness_sum(const Simulation& simulation, double volume) {
    const ParticleStore& s = simulation.spheres();
    double sum = 0;
    for (const auto& [i, j, shear, force] : simulation.contacts().touching()) {
        if (j < 0) continue;
        sum += kernels::contact_stiffness(0.5 * (s.radius[i] + s.radius[j]), s.normal_stiffness[i],
                                          s.normal_stiffness[j]) *
               (s.position[j] - s.position[i]).squaredNorm();
    }
    return sum / volume;
}

}  // namespace grainfield::core
