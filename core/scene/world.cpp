#include "core/scene/world.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace grainfield::core {
namespace {

bool all_equal(const Column<double>& column) {
    return std::adjacent_find(column.begin(), column.end(), std::not_equal_to<>()) == column.end();
}

}  // namespace

std::array<int, 2> bounding_walls(std::span<const Wall> walls, int axis) {
    std::array<int, 2> found{-1, -1};
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (walls[w].normal[axis] == 0.0) continue;
        const std::size_t side = walls[w].normal[axis] > 0.0 ? 0 : 1;
        const bool along = walls[w].normal == (side == 0 ? 1.0 : -1.0) * Vec3::Unit(axis);
        if (!along || found[side] >= 0) return {-1, -1};
        found[side] = static_cast<int>(w);
    }
    if (found[0] < 0 || found[1] < 0) return {-1, -1};
    return found;
}

kernels::AffineMotion box_motion(std::span<const Wall> walls, std::span<const Vec3> built,
                                 std::span<const Vec3> now) {
    kernels::AffineMotion motion;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = bounding_walls(walls, axis);
        if (low < 0) continue;
        const double a = built[low][axis], b = built[high][axis];
        const double moved_a = now[low][axis] - a, moved_b = now[high][axis] - b;
        if (!(b > a)) continue;
        motion.scale[axis] = (moved_b - moved_a) / (b - a);
        motion.shift[axis] = moved_a - motion.scale[axis] * a;
    }
    return motion;
}

World::World(Scene scene_, SimulationOptions options_)
    : scene(std::move(scene_)), options(options_) {
    refresh();
    if (size() > 0 && options.skin <= 0) options.skin = 0.08 * smallest_radius;
}

void World::refresh() {
    const ParticleStore& s = spheres();
    if (size() > 0) {
        const auto [smallest, largest] = std::minmax_element(s.radius.begin(), s.radius.end());
        smallest_radius = *smallest;
        largest_radius = *largest;
    }
    per_sphere = !all_equal(s.normal_stiffness) || !all_equal(s.friction_angle);
    has_friction =
        scene.stiffness_ratio > 0 && std::any_of(s.friction_angle.begin(), s.friction_angle.end(),
                                                 [](double angle) { return std::tan(angle) > 0; });
    has_wall_friction = false;
    planes.resize(scene.walls.size());
    for (std::size_t w = 0; w < planes.size(); ++w) {
        const Wall& wall = scene.walls[w];
        planes[w] = {wall.point,
                     wall.normal,
                     wall.velocity,
                     std::tan(wall.friction_angle),
                     wall.normal_stiffness,
                     wall.stiffness_ratio};
        has_wall_friction |= has_friction && wall.friction_angle > 0 && wall.stiffness_ratio > 0;
    }
    wall_loads.resize(planes.size());
    last_wall_loads.resize(planes.size());
}

kernels::MotionFeatures World::motion_features() const {
    return {!scene.gravity.isZero(0.0), scene.damping.force > 0 || scene.damping.moment > 0,
            has_friction, options.ledger};
}

void World::begin_wall_loads() {
    std::swap(wall_loads, last_wall_loads);
    std::fill(wall_loads.begin(), wall_loads.end(), kernels::WallLoad{});
    contact_sums = {};
}

void World::end_evaluation() {
    if (options.ledger) {
        friction_work += contact_sums.friction_work;
        // Work of the walls on the spheres over the last step, trapezoidal rule.
        for (std::size_t w = 0; w < planes.size(); ++w) {
            const double work =
                -0.5 * elapsed() *
                planes[w].velocity.dot(wall_loads[w].force + last_wall_loads[w].force);
            external_work += work;
            work_put_in += std::max(0.0, work);
        }
    }
    forces_at = steps;
}

}  // namespace grainfield::core
