// What drivers may change between steps, and the watch over the state.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "core/simulation.hpp"

namespace grainfield::core {

void Simulation::set_wall_velocity(std::size_t wall, const Vec3& velocity) {
    scene_.walls.at(wall).velocity = velocity;
}

void Simulation::set_wall_point(std::size_t wall, const Vec3& point) {
    scene_.walls.at(wall).point = point;
    planes_.at(wall).point = point;
    max_square_displacement_ = HUGE_VAL;  // unless a step follows, it may have met new spheres
}

void Simulation::set_gravity(const Vec3& gravity) {
    scene_.gravity = gravity;
}

void Simulation::set_damping(const Damping& damping) {
    scene_.damping = damping;
}

void Simulation::set_friction_angle(double angle) {
    std::fill(scene_.spheres.friction_angle.begin(), scene_.spheres.friction_angle.end(), angle);
    refresh_properties();
}

void Simulation::set_properties(std::span<const double> normal_stiffness,
                                std::span<const double> friction_angle) {
    std::copy(normal_stiffness.begin(), normal_stiffness.end(),
              scene_.spheres.normal_stiffness.begin());
    std::copy(friction_angle.begin(), friction_angle.end(), scene_.spheres.friction_angle.begin());
    refresh_properties();
}

void Simulation::add_velocity(std::size_t i, const Vec3& velocity) {
    scene_.spheres.velocity.set(i, scene_.spheres.velocity[i] + velocity);
}

void Simulation::scale_velocities(double factor) {
    ParticleStore& s = scene_.spheres;
    for_chunks(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            s.velocity.set(i, factor * s.velocity[i]);
            s.spin.set(i, factor * s.spin[i]);
        }
    });
}

void Simulation::set_walls(std::vector<Wall> walls) {
    scene_.walls = std::move(walls);
    refresh_properties();
    // The walls' candidates have to be found anew; their old history must not be matched by index.
    contacts_.forget_walls();
}

void Simulation::set_inertia_scale(std::span<const double> scale) {
    std::copy(scale.begin(), scale.end(), inertia_scale_.begin());
    refresh_properties();
}

void Simulation::check_state() const {
    const ParticleStore& s = spheres();
    const auto fail = [&](std::size_t i, const std::string& what) {
        throw SimulationError(
            fmt::format("{} (sphere {}, step {}, time {:g} s, at ({:g}, {:g}, {:g}) m)", what, i,
                        steps_, time_, s.position.x[i], s.position.y[i], s.position.z[i]));
    };
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (!s.position[i].allFinite() || !s.velocity[i].allFinite() || !s.spin[i].allFinite())
            fail(i, "a position or velocity is not a number");
        if (!(s.velocity[i].norm() * old_step_ < 0.5 * s.radius[i]))
            fail(i, fmt::format("unstable: a sphere moves {:g} m in a step of {:g} s, more than "
                                "half its radius",
                                s.velocity[i].norm() * old_step_, old_step_));
    }
    const auto pairs = contacts_.pairs();
    for (std::size_t c = 0; c < pairs.size(); ++c) {
        if (!contacts_.touching(c)) continue;
        const auto i = static_cast<std::size_t>(pairs[c].i),
                   j = static_cast<std::size_t>(pairs[c].j);
        const double overlap = s.radius[i] + s.radius[j] - (s.position[j] - s.position[i]).norm();
        if (!(overlap < 0.5 * std::min(s.radius[i], s.radius[j])))
            fail(i, fmt::format("an overlap of {:g} m with sphere {} exceeds half a radius",
                                overlap, j));
    }
    const auto wall_pairs = contacts_.wall_pairs();
    for (std::size_t c = 0; c < wall_pairs.size(); ++c) {
        const auto i = static_cast<std::size_t>(wall_pairs[c].sphere);
        const Wall& wall = scene_.walls[static_cast<std::size_t>(wall_pairs[c].wall)];
        const double overlap = s.radius[i] - wall.normal.dot(s.position[i] - wall.point);
        if (!(overlap < 0.5 * s.radius[i]))
            fail(i,
                 fmt::format(
                     "a sphere is lost: it reaches {:g} m into wall {}, more than half its radius",
                     overlap, wall_pairs[c].wall));
    }
}

}  // namespace grainfield::core
