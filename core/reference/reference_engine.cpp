#include "core/reference/reference_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"

namespace grainfield::core {

Inertias::Inertias(const World& world, std::size_t begin, std::size_t end) {
    inverse_mass.reserve(end - begin);
    inverse_inertia.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
        inverse_mass.push_back(world.inverse_inertial_mass(i));
        inverse_inertia.push_back(world.inverse_inertia(i));
    }
}

void ReferenceEngine::upload() {
    const std::size_t n = world_.size();
    world_.force.resize(n);
    world_.moment.resize(n);
    inertias_ = Inertias(world_, 0, n);
    friction_.resize(n);
    for (std::size_t i = 0; i < n; ++i) friction_[i] = world_.friction(i);
}

void ReferenceEngine::invalidate_lists() {
    max_square_displacement_ = HUGE_VAL;
}

bool ReferenceEngine::alarmed() const {
    const ParticleStore& s = world_.spheres();
    for (std::size_t i = 0; i < s.size(); ++i)
        if (!(s.velocity[i].norm() * world_.old_step < 0.5 * s.radius[i])) return true;
    return false;
}

// --- the step ------------------------------------------------------------------------------------

void ReferenceEngine::compute_forces(bool sums) {
    if (lists_outdated()) {
        try {
            contacts_.build(world_.spheres(), world_.scene.walls, world_.options.skin);
        } catch (const SimulationError& error) {
            throw SimulationError(
                fmt::format("{} (step {}, time {:g} s)", error.what(), world_.steps, world_.time));
        }
        max_square_displacement_ = 0;
    }
    const kernels::SphereColumns s = sphere_columns();
    const kernels::ContactColumns pair_columns = contacts_.pair_columns();
    const kernels::ContactParameters parameters = contact_parameters();
    const kernels::PairKernel pair_kernel =
        kernels_.pairs({world_.has_friction, world_.per_sphere, sums});
    const auto pairs = contacts_.pairs();
    // Sums run over ranges that do not depend on the skin.
    const auto ranges = contacts_.pair_ranges();
    std::vector<kernels::ContactSums> partial(ranges.size() - 1);
    for_pieces(partial.size(), [&](std::size_t c) {
        partial[c] =
            pair_kernel(s, pairs.data(), pair_columns, parameters, ranges[c], ranges[c + 1]);
    });
    world_.begin_wall_loads();
    for (const kernels::ContactSums& p : partial) world_.contact_sums += p;
    wall_forces(sums);

    const kernels::MotionColumns columns = motion_columns(world_, 0, inertias_);
    const kernels::MotionParameters motion = motion_parameters(world_, 0.0);
    for_chunks(world_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        kernels::gather_forces(columns, contacts_.all_columns(), contacts_.offsets(),
                               contacts_.incidences(), motion, world_.motion_features(), begin,
                               end);
    });
    world_.end_evaluation();
}

void ReferenceEngine::wall_forces(bool sums) {
    const auto& planes = world_.planes;
    if (planes.empty()) return;
    const kernels::SphereColumns s = sphere_columns();
    const auto pairs = contacts_.wall_pairs();
    const kernels::ContactColumns columns = contacts_.wall_columns();
    const kernels::ContactParameters parameters = contact_parameters();
    const kernels::WallKernel kernel =
        kernels_.walls({world_.has_wall_friction, world_.per_sphere, sums});
    // Loads are summed over ranges that do not depend on the skin: servos answer to them.
    const auto ranges = contacts_.wall_ranges();
    std::vector<kernels::WallLoad> partial((ranges.size() - 1) * planes.size());
    std::vector<kernels::ContactSums> partial_sums(ranges.size() - 1);
    for_pieces(partial_sums.size(), [&](std::size_t c) {
        partial_sums[c] = kernel(s, planes.data(), pairs.data(), columns, parameters,
                                 partial.data() + c * planes.size(), ranges[c], ranges[c + 1]);
    });
    for (std::size_t c = 0; c < partial_sums.size(); ++c) {
        world_.contact_sums += partial_sums[c];
        const auto w = static_cast<std::size_t>(pairs[ranges[c]].wall);
        world_.wall_loads[w] += partial[c * planes.size() + w];
    }
}

void ReferenceEngine::move(double step) {
    kernels::MotionParameters motion = motion_parameters(world_, step);
    const Vec3Column& x0 = contacts_.built_position();
    motion.x0 = x0.x.data();
    motion.y0 = x0.y.data();
    motion.z0 = x0.z.data();
    motion.affine = affine_motion(step);  // at the end of the step
    const kernels::MotionColumns columns = motion_columns(world_, 0, inertias_);
    const std::size_t n = world_.size();
    std::vector<kernels::MotionSums> partial(chunk_count(n));
    for_chunks(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
        partial[c] = kernels::move_spheres(columns, motion, world_.motion_features(), begin, end);
    });
    max_square_displacement_ = 0;
    for (const kernels::MotionSums& p : partial) {
        max_square_displacement_ = std::max(max_square_displacement_, p.max_square_displacement);
        world_.damping_work += p.damping_work;
    }
}

void ReferenceEngine::scale_velocities(double factor) {
    ParticleStore& s = world_.scene.spheres;
    for_chunks(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            s.velocity.set(i, factor * s.velocity[i]);
            s.spin.set(i, factor * s.spin[i]);
        }
    });
}

// --- lists ---------------------------------------------------------------------------------------

kernels::AffineMotion ReferenceEngine::affine_motion(double ahead) const {
    if (contacts_.stale()) return {};
    std::vector<Vec3> now;
    for (const Wall& wall : world_.scene.walls) now.push_back(wall.point + ahead * wall.velocity);
    return box_motion(world_.scene.walls, contacts_.built_walls(), now);
}

double ReferenceEngine::unpaired_wall_motion() const {
    const auto& walls = world_.scene.walls;
    double motion = 0;
    for (std::size_t w = 0; w < walls.size(); ++w) {
        bool paired = false;
        for (int axis = 0; axis < 3; ++axis) {
            const auto [low, high] = bounding_walls(walls, axis);
            paired |= low == static_cast<int>(w) || high == static_cast<int>(w);
        }
        if (!paired)
            motion = std::max(
                motion, std::abs(walls[w].normal.dot(walls[w].point - contacts_.built_walls()[w])));
    }
    return motion;
}

bool ReferenceEngine::lists_outdated() const {
    if (contacts_.stale()) return true;
    // A candidate has been missed only if two bodies came closer by more than the skin: each by
    // what it moved beyond the box's homogeneous strain, and that strain over their distance.
    const double moved = std::sqrt(max_square_displacement_);
    const double strain = affine_motion(0).scale.cwiseAbs().maxCoeff();
    const double skin = contacts_.skin();
    const double by_strain = strain * (2 * world_.largest_radius + skin);
    return !(std::max(2 * moved, moved + unpaired_wall_motion()) + by_strain < skin);
}

// --- views ---------------------------------------------------------------------------------------

kernels::ContactParameters ReferenceEngine::contact_parameters() const {
    return {world_.scene.stiffness_ratio, world_.uniform_stiffness(), world_.uniform_friction(),
            world_.elapsed()};
}

kernels::SphereColumns ReferenceEngine::sphere_columns() const {
    const ParticleStore& s = world_.spheres();
    return {s.position.x.data(), s.position.y.data(),       s.position.z.data(),
            s.velocity.x.data(), s.velocity.y.data(),       s.velocity.z.data(),
            s.spin.x.data(),     s.spin.y.data(),           s.spin.z.data(),
            s.radius.data(),     s.normal_stiffness.data(), friction_.data()};
}

kernels::MotionColumns motion_columns(World& world, std::size_t begin, const Inertias& inertias) {
    ParticleStore& s = world.scene.spheres;
    Vec3Column &f = world.force, &m = world.moment;
    return {s.position.x.data() + begin,
            s.position.y.data() + begin,
            s.position.z.data() + begin,
            s.velocity.x.data() + begin,
            s.velocity.y.data() + begin,
            s.velocity.z.data() + begin,
            s.spin.x.data() + begin,
            s.spin.y.data() + begin,
            s.spin.z.data() + begin,
            f.x.data() + begin,
            f.y.data() + begin,
            f.z.data() + begin,
            m.x.data() + begin,
            m.y.data() + begin,
            m.z.data() + begin,
            s.radius.data() + begin,
            s.mass.data() + begin,
            inertias.inverse_mass.data(),
            inertias.inverse_inertia.data()};
}

kernels::MotionParameters motion_parameters(const World& world, double new_step) {
    kernels::MotionParameters p;
    p.gravity = world.scene.gravity;
    p.force_damping = world.scene.damping.force;
    p.moment_damping = world.scene.damping.moment;
    p.old_step = world.old_step;
    p.new_step = new_step;
    p.x0 = p.y0 = p.z0 = nullptr;
    return p;
}

std::vector<TouchingContact> ReferenceEngine::touching() const {
    std::vector<TouchingContact> found;
    const auto pairs = contacts_.pairs();
    for (std::size_t c = 0; c < pairs.size(); ++c)
        if (contacts_.touching(c))
            found.push_back({pairs[c].i, pairs[c].j, contacts_.shear(c), contacts_.force(c)});
    const auto wall_pairs = contacts_.wall_pairs();
    for (std::size_t k = 0; k < wall_pairs.size(); ++k) {
        const std::size_t c = pairs.size() + k;
        if (contacts_.touching(c))
            found.push_back({wall_pairs[k].sphere, -1 - wall_pairs[k].wall, contacts_.shear(c),
                             contacts_.force(c)});
    }
    return found;
}

std::int64_t ReferenceEngine::touching_count() const {
    return sum_over<std::int64_t>(contacts_.size(), [&](std::size_t c) {
        return contacts_.touching(c) ? std::int64_t{1} : std::int64_t{0};
    });
}

double ReferenceEngine::resultant_sum() {
    return sum_over<double>(world_.size(), [&](std::size_t i) { return world_.force[i].norm(); });
}

}  // namespace grainfield::core
