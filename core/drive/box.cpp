#include "core/drive/box.hpp"

#include <numeric>

#include "core/drive/servo.hpp"

namespace grainfield::core {

Vec3 box_dimensions(const Simulation& simulation) {
    const auto walls = simulation.walls();
    Vec3 size;
    for (int a = 0; a < 3; ++a) size[a] = walls[2 * a + 1].point[a] - walls[2 * a].point[a];
    return size;
}

double wall_area(const Vec3& dimensions, int axis) {
    return dimensions[(axis + 1) % 3] * dimensions[(axis + 2) % 3];
}

double axis_stress(const Simulation& simulation, int axis) {
    const auto low = static_cast<std::size_t>(2 * axis);
    return 0.5 * (wall_compression(simulation, low) + wall_compression(simulation, low + 1)) /
           wall_area(box_dimensions(simulation), axis);
}

double most_kinetic_energy(const Simulation& simulation, double rate, double stress) {
    const auto& mass = simulation.spheres().mass;
    const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
    const Vec3 size = box_dimensions(simulation);
    // Velocities from 0 to rate * size along each axis.
    const double imposed = total * rate * rate * size.squaredNorm() / 6;
    const double fall = total * simulation.scene().gravity.cwiseAbs().dot(size);
    return 10 * imposed + fall + 0.01 * stress * size.prod();
}

}  // namespace grainfield::core
