// What may be changed between steps, and the watch over the state.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/simulation.hpp"

namespace grainfield::core {

ParticleStore& Simulation::changing() {
    scene();
    return world_->scene.spheres;
}

double Simulation::energy_gained(const std::function<void()>& change) {
    if (!world_->options.ledger ||
        world_->forces_at < 0) {  // else a start to begin the ledger with
        change();
        return 0;
    }
    if (world_->forces_at != world_->steps) compute_forces(true);
    const double before = energy().closing();
    change();
    return energy().closing() - before;
}

void Simulation::changed() {
    world_->refresh();
    engine_->upload();
}

void Change::set_wall_point(std::size_t wall, const Vec3& point) {
    World& world = *simulation_.world_;
    world.scene.walls.at(wall).point = point;
    world.planes.at(wall).point = point;
    rebuild_lists();  // it may have met new spheres
}

void Change::set_gravity(const Vec3& gravity) {
    simulation_.world_->scene.gravity = gravity;
}

void Change::set_damping(const Damping& damping) {
    simulation_.world_->scene.damping = damping;
}

void Change::set_friction_angle(double angle) {
    ParticleStore& s = simulation_.changing();
    std::fill(s.friction_angle.begin(), s.friction_angle.end(), angle);
    simulation_.changed();
}

void Change::set_properties(std::span<const double> normal_stiffness,
                            std::span<const double> friction_angle) {
    ParticleStore& s = simulation_.changing();
    std::copy(normal_stiffness.begin(), normal_stiffness.end(), s.normal_stiffness.begin());
    std::copy(friction_angle.begin(), friction_angle.end(), s.friction_angle.begin());
    simulation_.changed();
}

void Change::scale_velocities(double factor) {
    simulation_.world_->damping_work -= simulation_.energy_gained([&] {
        simulation_.engine_->scale_velocities(factor);
        simulation_.store_current_ = false;
    });
}

void Change::set_walls(std::vector<Wall> walls) {
    World& world = *simulation_.world_;
    simulation_.scene();
    world.scene.walls = std::move(walls);
    world.refresh();
    // The walls' candidates have to be found anew; their old history must not be matched by index.
    simulation_.engine_->forget_walls();
}

void Change::set_inertia_scale(std::span<const double> scale) {
    World& world = *simulation_.world_;
    simulation_.scene();
    world.external_work += simulation_.energy_gained([&] {
        const bool as_they_are =
            std::all_of(scale.begin(), scale.end(), [](double s) { return s == 1; });
        world.inertia_scale.assign(scale.begin(), as_they_are ? scale.begin() : scale.end());
        simulation_.changed();
    });
}

std::size_t Change::restore_shear(std::span<const ContactShear> contacts) {
    return simulation_.engine_->restore(contacts);
}

bool Change::restore_shear(std::int32_t i, std::int32_t j, const Vec3& shear) {
    return restore_shear(std::array{ContactShear{i, j, shear}}) == 1;
}

void Change::rebuild_lists() {
    simulation_.engine_->invalidate_lists();
}

void HealthView::check() const {
    Engine& engine = *simulation_.engine_;
    const World& world = *simulation_.world_;
    if (!engine.suspicious()) return;
    const ParticleStore& s = simulation_.spheres();
    const double step = world.old_step;
    const auto fail = [&](std::size_t i, const std::string& what) {
        throw SimulationError(fmt::format(
            "{} (sphere {}, step {}, time {:g} s, at ({:g}, {:g}, "
            "{:g}) m)",
            what, i, world.steps, world.time, s.position.x[i], s.position.y[i], s.position.z[i]));
    };
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (!s.position[i].allFinite() || !s.velocity[i].allFinite() || !s.spin[i].allFinite())
            fail(i, "a position or velocity is not a number");
        if (!(s.velocity[i].norm() * step < 0.5 * s.radius[i]))
            fail(i, fmt::format("unstable: a sphere moves {:g} m in a step of {:g} s, more than "
                                "half its radius",
                                s.velocity[i].norm() * step, step));
    }
    for (const TouchingContact& contact : engine.touching()) {
        const auto i = static_cast<std::size_t>(contact.i);
        if (contact.j >= 0) {
            const auto j = static_cast<std::size_t>(contact.j);
            const double overlap =
                s.radius[i] + s.radius[j] - (s.position[j] - s.position[i]).norm();
            if (!(overlap < 0.5 * std::min(s.radius[i], s.radius[j])))
                fail(i, fmt::format("an overlap of {:g} m with sphere {} exceeds half a radius",
                                    overlap, j));
            continue;
        }
        const Wall& wall = world.scene.walls[static_cast<std::size_t>(-1 - contact.j)];
        const double overlap = s.radius[i] - wall.normal.dot(s.position[i] - wall.point);
        if (!(overlap < 0.5 * s.radius[i]))
            fail(i,
                 fmt::format(
                     "a sphere is lost: it reaches {:g} m into wall {}, more than half its radius",
                     overlap, -1 - contact.j));
    }
    engine.cleared();
}

}  // namespace grainfield::core
