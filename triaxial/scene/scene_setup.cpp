#include "triaxial/scene/scene_setup.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_file.hpp"
#include "core/neighbour_search.hpp"

namespace grainfield::triaxial {
namespace {

constexpr double largest_strain_rate = 0.5;  ///< of a servo wall, of half the box [1/s]

std::string sphere_name(std::size_t i, std::span<const std::int32_t> lines) {
    return i < lines.size() ? fmt::format("sphere {} (line {})", i, lines[i])
                            : fmt::format("sphere {}", i);
}

void complete_columns(core::SphereFile& file, const ParticleOptions& particle, bool density_given,
                      const std::string& source) {
    core::ParticleStore& s = file.spheres;
    if (!file.has_normal_stiffness) s.normal_stiffness.assign(s.size(), particle.normal_stiffness);
    if (!file.has_friction_angle) s.friction_angle.assign(s.size(), particle.friction_angle);
    const core::Column<double> given = s.mass;
    s.set_density(particle.density);
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (given[i] > 0) {
            if (density_given && std::abs(given[i] - s.mass[i]) > 1e-3 * given[i])
                throw InputError(fmt::format(
                    "particle.density = {}: contradicts {}, whose {} brings a mass of {:.6g} kg, "
                    "not "
                    "{:.6g} kg; leave the key out",
                    particle.density, source, sphere_name(i, file.lines), given[i], s.mass[i]));
            s.mass[i] = given[i];
        }
        if (!(s.normal_stiffness[i] > 0))
            throw InputError(fmt::format("{}: {}: normal_stiffness = {}: must be > 0 Pa", source,
                                         sphere_name(i, file.lines), s.normal_stiffness[i]));
    }
}

void check_overlaps_with_walls(const core::Scene& scene, const std::string& source,
                               std::span<const std::int32_t> lines) {
    const core::ParticleStore& s = scene.spheres;
    for (std::size_t w = 0; w < scene.walls.size(); ++w)
        for (std::size_t i = 0; i < s.size(); ++i) {
            const core::Wall& wall = scene.walls[w];
            const double overlap = s.radius[i] - wall.normal.dot(s.position[i] - wall.point);
            const double allowed = core::largest_relative_overlap * s.radius[i];
            if (!(overlap <= allowed))
                throw InputError(fmt::format(
                    "{}: {} at ({:g}, {:g}, {:g}) m reaches {:.4g} m into or beyond wall {}; "
                    "allowed: {:g} % of its radius, {:.4g} m",
                    source, sphere_name(i, lines), s.position.x[i], s.position.y[i],
                    s.position.z[i], overlap, w, 100 * core::largest_relative_overlap, allowed));
        }
}

void check_overlaps_of_spheres(const core::ParticleStore& s, const std::string& source,
                               std::span<const std::int32_t> lines) {
    std::vector<std::pair<std::int32_t, std::int32_t>> candidates;
    for (const auto& [i, j] : core::find_pairs(s.position, s.radius, 0.0))
        candidates.emplace_back(i, j);
    core::check_overlaps(s, candidates, source, lines);
}

int axis_of(const Vec3& normal) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(normal[axis]) == 1.0) return axis;
    return -1;
}

/// Distance between the opposite walls of an axis; 0 where there are no such walls [m].
double distance_of_walls(std::span<const core::Wall> walls, int axis) {
    std::optional<double> low;
    std::optional<double> high;
    for (const core::Wall& wall : walls) {
        if (wall.normal[axis] == 1.0 && !low) low = wall.point[axis];
        if (wall.normal[axis] == -1.0 && !high) high = wall.point[axis];
    }
    return low && high && *high > *low ? *high - *low : 0.0;
}

}  // namespace

core::Scene set_up_scene(const SceneFile& file, core::Monitor* monitor) {
    const std::string name = file.spheres.string();
    core::SphereFile spheres = core::read_spheres(file.spheres);
    core::check_spheres(spheres.spheres, name, spheres.lines);
    if (monitor != nullptr)
        for (const std::string& note : spheres.notes)
            monitor->note(fmt::format("{}: {}", name, note));
    complete_columns(spheres, file.particle, file.density_given, name);

    core::Scene scene;
    scene.gravity = file.gravity;
    scene.stiffness_ratio = file.particle.stiffness_ratio;
    scene.damping = file.damping;
    for (const SceneWall& wall : file.walls)
        scene.walls.push_back({wall.point, wall.normal, wall.velocity, wall.friction_angle,
                               wall.normal_stiffness,
                               wall.stiffness_ratio.value_or(file.particle.stiffness_ratio)});
    scene.spheres = std::move(spheres.spheres);
    check_overlaps_with_walls(scene, name, spheres.lines);
    check_overlaps_of_spheres(scene.spheres, name, spheres.lines);
    return scene;
}

double ServoWall::area(std::span<const core::Wall> walls) const {
    return distance_of_walls(walls, (axis + 1) % 3) * distance_of_walls(walls, (axis + 2) % 3);
}

std::vector<ServoWall> set_up_servos(const SceneFile& file, const core::Scene& scene,
                                     const std::string& source) {
    std::vector<ServoWall> servos;
    for (std::size_t w = 0; w < file.walls.size(); ++w) {
        const SceneWall& wall = file.walls[w];
        if (!wall.stress) continue;
        const int axis = axis_of(wall.normal);
        if (axis < 0)
            throw InputError(fmt::format(
                "{}: wall {}: stress: its normal ({:g}, {:g}, {:g}) is not along an axis; a stress "
                "needs a box of walls along x, y and z",
                source, w, wall.normal.x(), wall.normal.y(), wall.normal.z()));
        double length = distance_of_walls(scene.walls, axis);
        if (!(length > 0)) length = core::bounding_box(scene.spheres).size()[axis];
        const core::WallServo::Options options{.stress = *wall.stress,
                                               .max_speed = largest_strain_rate * 0.5 * length};
        servos.push_back({core::WallServo(w, options), axis});
        if (!(servos.back().area(scene.walls) > 0))
            throw InputError(fmt::format(
                "{}: wall {}: stress: its area is not known; needed are two opposite walls, facing "
                "each other, on each of the axes {} and {}",
                source, w, "xyz"[(axis + 1) % 3], "xyz"[(axis + 2) % 3]));
    }
    return servos;
}

}  // namespace grainfield::triaxial
