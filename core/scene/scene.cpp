#include "core/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/neighbour_search.hpp"

namespace grainfield::core {

std::vector<Wall> box_walls(const Box& box, const Wall& like) {
    std::vector<Wall> walls;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            Wall wall = like;
            wall.point = side == 0 ? box.lower : box.upper;
            wall.normal = (side == 0 ? 1.0 : -1.0) * Vec3::Unit(axis);
            walls.push_back(wall);
        }
    return walls;
}

void check_start(const Scene& scene, const std::string& source) {
    const ParticleStore& s = scene.spheres;
    if (s.size() == 0) throw InputError(source + ": there are no spheres; at least one is needed");
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (!(s.radius[i] > 0) || !std::isfinite(s.radius[i]))
            throw InputError(
                fmt::format("{}: sphere {}: radius = {}: must be > 0 m", source, i, s.radius[i]));
        if (!(s.mass[i] > 0) || !std::isfinite(s.mass[i]))
            throw InputError(
                fmt::format("{}: sphere {}: mass = {}: must be > 0 kg", source, i, s.mass[i]));
        if (!s.position[i].allFinite() || !s.velocity[i].allFinite() || !s.spin[i].allFinite())
            throw InputError(fmt::format(
                "{}: sphere {}: position, velocity and spin must be finite numbers", source, i));
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            const Wall& wall = scene.walls[w];
            const double overlap = s.radius[i] - wall.normal.dot(s.position[i] - wall.point);
            if (overlap > 0.1 * s.radius[i])
                throw InputError(
                    fmt::format("{}: sphere {} at ({:g}, {:g}, {:g}) m reaches {:g} m into wall "
                                "{}; allowed is 10 % of its radius, {:g} m",
                                source, i, s.position.x[i], s.position.y[i], s.position.z[i],
                                overlap, w, 0.1 * s.radius[i]));
        }
    }
    for (const auto [i, j] : find_pairs(s.position, s.radius, 0.0)) {
        const double overlap = s.radius[i] + s.radius[j] - (s.position[j] - s.position[i]).norm();
        const double allowed = 0.1 * std::min(s.radius[i], s.radius[j]);
        if (overlap > allowed)
            throw InputError(
                fmt::format("{}: spheres {} and {} overlap by {:g} m; allowed is 10 % of the "
                            "smaller radius, {:g} m",
                            source, i, j, overlap, allowed));
    }
}

}  // namespace grainfield::core
