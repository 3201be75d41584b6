#pragma once
// A scene: spheres, plane walls, what acts on them. What it does not contain costs nothing.

#include <optional>
#include <string>
#include <vector>

#include "core/scene/particle_store.hpp"
#include "core/solver_options.hpp"

namespace grainfield::core {

/// A plane wall, fixed or moving at a given velocity.
struct Wall {
    Vec3 point = Vec3::Zero();      ///< on the plane [m]
    Vec3 normal = Vec3::UnitY();    ///< unit, towards the spheres [-]
    Vec3 velocity = Vec3::Zero();   ///< [m/s]
    double friction_angle = 0;      ///< [rad]
    double normal_stiffness = 9e8;  ///< k_n of the wall as a body [Pa]
    double stiffness_ratio = 0.1;   ///< k_s/k_n of the wall [-]
};

struct Scene {
    ParticleStore spheres;
    std::vector<Wall> walls;
    Vec3 gravity = Vec3::Zero();   ///< [m/s2]
    double stiffness_ratio = 0.1;  ///< k_s/k_n of the spheres [-]
    Damping damping;
};

/// Walls of a box in the order x low, x high, y low, y high, z low, z high; each with the
/// properties of `like`.
std::vector<Wall> box_walls(const Box& box, const Wall& like);

/// Throws InputError unless the scene can be started: radii and masses positive, everything
/// finite, no centre behind a wall by more than 10 % of its radius past touching, no two spheres
/// overlapping by more than 10 % of the smaller radius. `source` names the input in the message.
void check_start(const Scene& scene, const std::string& source);

}  // namespace grainfield::core
