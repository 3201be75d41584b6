#include "core/scene/particle_store.hpp"

#include <cmath>
#include <numbers>

namespace grainfield::core {

double sphere_volume(double radius) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

void ParticleStore::resize(std::size_t n) {
    for (Vec3Column* column : {&position, &velocity, &spin}) column->resize(n);
    for (Column<double>* column : {&radius, &mass, &normal_stiffness, &friction_angle})
        column->resize(n, 0.0);
    block.resize(n, no_block);
}

double ParticleStore::solid_volume() const {
    double cubes = 0.0;
    for (double r : radius) cubes += r * r * r;
    return 4.0 / 3.0 * std::numbers::pi * cubes;
}

void ParticleStore::set_density(double density) {
    for (std::size_t i = 0; i < size(); ++i)
        mass[i] = density * 4.0 / 3.0 * std::numbers::pi * radius[i] * radius[i] * radius[i];
}

Box bounding_box(const ParticleStore& spheres) {
    Box box;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Vec3 r = Vec3::Constant(spheres.radius[i]);
        const Vec3 x = spheres.position[i];
        box.lower = i == 0 ? Vec3(x - r) : Vec3(box.lower.cwiseMin(x - r));
        box.upper = i == 0 ? Vec3(x + r) : Vec3(box.upper.cwiseMax(x + r));
    }
    return box;
}

}  // namespace grainfield::core
