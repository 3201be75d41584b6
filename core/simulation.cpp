#include "core/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/parallel.hpp"

namespace grainfield::core {
namespace {

bool all_equal(const Column<double>& column) {
    return std::adjacent_find(column.begin(), column.end(), std::not_equal_to<>()) == column.end();
}

/// The low and the high wall that bound a box along an axis; {-1, -1} unless there are just these
/// two and no other wall's normal has a part along the axis.
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

}  // namespace

Simulation::Simulation(Scene scene, const kernels::KernelTable& kernels, SimulationOptions options)
    : scene_(std::move(scene)), kernels_(&kernels), options_(options) {
    const std::size_t n = spheres().size();
    force_.resize(n);
    moment_.resize(n);
    inertia_scale_.assign(n, 1.0);
    if (n > 0) {
        const auto [smallest, largest] =
            std::minmax_element(spheres().radius.begin(), spheres().radius.end());
        largest_radius_ = *largest;
        if (options_.skin <= 0) options_.skin = 0.08 * *smallest;
    }
    refresh_properties();
}

void Simulation::refresh_properties() {
    const ParticleStore& s = spheres();
    const std::size_t n = s.size();
    friction_.resize(n);
    inverse_inertial_mass_.resize(n);
    inverse_inertia_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        friction_[i] = std::tan(s.friction_angle[i]);
        const double mass = s.mass[i] * inertia_scale_[i];
        inverse_inertial_mass_[i] = 1.0 / mass;
        inverse_inertia_[i] = 1.0 / (0.4 * mass * s.radius[i] * s.radius[i]);
    }
    per_sphere_ = !all_equal(s.normal_stiffness) || !all_equal(friction_);
    has_friction_ = scene_.stiffness_ratio > 0 &&
                    std::any_of(friction_.begin(), friction_.end(), [](double f) { return f > 0; });
    has_wall_friction_ = false;
    planes_.resize(scene_.walls.size());
    for (std::size_t w = 0; w < planes_.size(); ++w) {
        const Wall& wall = scene_.walls[w];
        planes_[w] = {wall.point,
                      wall.normal,
                      wall.velocity,
                      std::tan(wall.friction_angle),
                      wall.normal_stiffness,
                      wall.stiffness_ratio};
        has_wall_friction_ |= has_friction_ && wall.friction_angle > 0 && wall.stiffness_ratio > 0;
    }
    wall_loads_.resize(planes_.size());
    last_wall_loads_.resize(planes_.size());
}

// --- the step ------------------------------------------------------------------------------------

void Simulation::compute_forces(bool sums) {
    sums |= options_.ledger;
    if (lists_outdated()) {
        contacts_.build(spheres(), walls(), options_.skin);
        max_square_displacement_ = 0;
    }
    const kernels::SphereColumns s = sphere_columns();
    const kernels::ContactColumns pair_columns = contacts_.pair_columns();
    const kernels::ContactParameters parameters{
        scene_.stiffness_ratio, spheres().size() ? spheres().normal_stiffness[0] : 0.0,
        friction_.empty() ? 0.0 : friction_[0], elapsed()};
    const kernels::PairKernel pair_kernel = kernels_->pairs({has_friction_, per_sphere_, sums});
    const auto pairs = contacts_.pairs();
    // Sums run over ranges that do not depend on the skin.
    const auto ranges = contacts_.pair_ranges();
    std::vector<kernels::ContactSums> partial(ranges.size() - 1);
    for_pieces(partial.size(), [&](std::size_t c) {
        partial[c] =
            pair_kernel(s, pairs.data(), pair_columns, parameters, ranges[c], ranges[c + 1]);
    });
    contact_sums_ = {};
    for (const kernels::ContactSums& p : partial) contact_sums_ += p;
    wall_forces(sums);
    if (options_.ledger) friction_work_ += contact_sums_.friction_work;

    const kernels::MotionParameters motion = motion_parameters(0.0);
    for_chunks(spheres().size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        kernels::gather_forces(motion_columns(), contacts_.all_columns(), contacts_.offsets(),
                               contacts_.incidences(), motion, motion_features(), begin, end);
    });
    forces_at_ = steps_;
}

void Simulation::wall_forces(bool sums) {
    std::swap(wall_loads_, last_wall_loads_);
    std::fill(wall_loads_.begin(), wall_loads_.end(), kernels::WallLoad{});
    if (planes_.empty()) return;
    const kernels::SphereColumns s = sphere_columns();
    const auto pairs = contacts_.wall_pairs();
    const kernels::ContactColumns columns = contacts_.wall_columns();
    const kernels::ContactParameters parameters{
        scene_.stiffness_ratio, spheres().size() ? spheres().normal_stiffness[0] : 0.0,
        friction_.empty() ? 0.0 : friction_[0], elapsed()};
    const kernels::WallKernel kernel = kernels_->walls({has_wall_friction_, per_sphere_, sums});
    // Loads are summed over ranges that do not depend on the skin: servos answer to them.
    const auto ranges = contacts_.wall_ranges();
    std::vector<kernels::WallLoad> partial((ranges.size() - 1) * planes_.size());
    std::vector<kernels::ContactSums> partial_sums(ranges.size() - 1);
    for_pieces(partial_sums.size(), [&](std::size_t c) {
        partial_sums[c] = kernel(s, planes_.data(), pairs.data(), columns, parameters,
                                 partial.data() + c * planes_.size(), ranges[c], ranges[c + 1]);
    });
    for (std::size_t c = 0; c < partial_sums.size(); ++c) {
        contact_sums_ += partial_sums[c];
        const auto w = static_cast<std::size_t>(pairs[ranges[c]].wall);
        const kernels::WallLoad& load = partial[c * planes_.size() + w];
        wall_loads_[w].force += load.force;
        wall_loads_[w].stiffness += load.stiffness;
        wall_loads_[w].contacts += load.contacts;
    }
    // Work of the walls on the spheres over the last step, trapezoidal rule.
    if (options_.ledger && elapsed() > 0)
        for (std::size_t w = 0; w < planes_.size(); ++w)
            external_work_ -=
                0.5 * elapsed() *
                planes_[w].velocity.dot(wall_loads_[w].force + last_wall_loads_[w].force);
}

void Simulation::advance(double step) {
    for (std::size_t w = 0; w < planes_.size(); ++w) {
        Wall& wall = scene_.walls[w];
        wall.point += step * wall.velocity;
        planes_[w].point = wall.point;
        planes_[w].velocity = wall.velocity;
    }
    const kernels::MotionParameters motion = motion_parameters(step);
    const std::size_t n = spheres().size();
    std::vector<kernels::MotionSums> partial(chunk_count(n));
    for_chunks(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
        partial[c] = kernels::move_spheres(motion_columns(), motion, motion_features(), begin, end);
    });
    max_square_displacement_ = 0;
    for (const kernels::MotionSums& p : partial) {
        max_square_displacement_ = std::max(max_square_displacement_, p.max_square_displacement);
        damping_work_ += p.damping_work;
    }
    time_ += step;
    old_step_ = step;
    ++steps_;
}

// --- lists ---------------------------------------------------------------------------------------

kernels::AffineMotion Simulation::affine_motion() const {
    kernels::AffineMotion motion;
    const auto& built = contacts_.built_walls();
    if (contacts_.stale()) return motion;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = bounding_walls(walls(), axis);
        if (low < 0) continue;
        const double a = built[low][axis], b = built[high][axis];
        const double moved_a = scene_.walls[low].point[axis] - a;
        const double moved_b = scene_.walls[high].point[axis] - b;
        if (!(b > a)) continue;
        motion.scale[axis] = (moved_b - moved_a) / (b - a);
        motion.shift[axis] = moved_a - motion.scale[axis] * a;
    }
    return motion;
}

double Simulation::unpaired_wall_motion() const {
    const auto& built = contacts_.built_walls();
    double motion = 0;
    for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
        const Wall& wall = scene_.walls[w];
        bool paired = false;
        for (int axis = 0; axis < 3; ++axis) {
            const auto [low, high] = bounding_walls(walls(), axis);
            paired |= low == static_cast<int>(w) || high == static_cast<int>(w);
        }
        if (!paired) motion = std::max(motion, std::abs(wall.normal.dot(wall.point - built[w])));
    }
    return motion;
}

bool Simulation::lists_outdated() const {
    if (contacts_.stale()) return true;
    // A candidate has been missed only if two bodies came closer by more than the skin: each by
    // what it moved beyond the box's homogeneous strain, and that strain over their distance.
    const double moved = std::sqrt(max_square_displacement_);
    const double strain = affine_motion().scale.cwiseAbs().maxCoeff();
    const double skin = contacts_.skin();
    const double by_strain = strain * (2 * largest_radius_ + skin);
    return !(std::max(2 * moved, moved + unpaired_wall_motion()) + by_strain < skin);
}

// --- views ---------------------------------------------------------------------------------------

kernels::SphereColumns Simulation::sphere_columns() const {
    const ParticleStore& s = scene_.spheres;
    return {s.position.x.data(), s.position.y.data(),       s.position.z.data(),
            s.velocity.x.data(), s.velocity.y.data(),       s.velocity.z.data(),
            s.spin.x.data(),     s.spin.y.data(),           s.spin.z.data(),
            s.radius.data(),     s.normal_stiffness.data(), friction_.data()};
}

kernels::MotionColumns Simulation::motion_columns() const {
    // The kernels' views are mutable; which of them write is said at each kernel.
    auto& s = const_cast<ParticleStore&>(scene_.spheres);
    auto& f = const_cast<Vec3Column&>(force_);
    auto& m = const_cast<Vec3Column&>(moment_);
    return {s.position.x.data(),
            s.position.y.data(),
            s.position.z.data(),
            s.velocity.x.data(),
            s.velocity.y.data(),
            s.velocity.z.data(),
            s.spin.x.data(),
            s.spin.y.data(),
            s.spin.z.data(),
            f.x.data(),
            f.y.data(),
            f.z.data(),
            m.x.data(),
            m.y.data(),
            m.z.data(),
            s.radius.data(),
            s.mass.data(),
            inverse_inertial_mass_.data(),
            inverse_inertia_.data()};
}

kernels::MotionParameters Simulation::motion_parameters(double new_step) const {
    kernels::MotionParameters p;
    p.gravity = scene_.gravity;
    p.force_damping = scene_.damping.force;
    p.moment_damping = scene_.damping.moment;
    p.old_step = old_step_;
    p.new_step = new_step;
    const Vec3Column& x0 = contacts_.built_position();
    p.x0 = x0.x.data();
    p.y0 = x0.y.data();
    p.z0 = x0.z.data();
    if (new_step > 0) p.affine = affine_motion();
    return p;
}

kernels::MotionFeatures Simulation::motion_features() const {
    return {!scene_.gravity.isZero(0.0), scene_.damping.force > 0 || scene_.damping.moment > 0,
            has_friction_, options_.ledger};
}

std::int64_t Simulation::touching_contacts() const {
    return sum_over<std::int64_t>(contacts_.size(), [&](std::size_t c) {
        return contacts_.touching(c) ? std::int64_t{1} : std::int64_t{0};
    });
}

kernels::OnStep Simulation::on_step(std::size_t i) const {
    return kernels::on_step_motion(motion_columns(), motion_parameters(0.0), motion_features(), i);
}

double Simulation::unbalanced_force_ratio() const {
    const std::size_t n = spheres().size();
    const double resultant = sum_over<double>(n, [&](std::size_t i) { return force_[i].norm(); });
    if (resultant == 0.0) return 0.0;
    if (contact_sums_.contacts == 0 || contact_sums_.normal_force == 0.0)
        return std::numeric_limits<double>::infinity();
    return (resultant / static_cast<double>(n)) /
           (contact_sums_.normal_force / static_cast<double>(contact_sums_.contacts));
}

Energy Simulation::energy() const {
    const kernels::MotionParameters p = motion_parameters(0.0);
    const kernels::StateSums state =
        sum_chunks<kernels::StateSums>(spheres().size(), [&](std::size_t begin, std::size_t end) {
            return kernels::sum_state(motion_columns(), p, motion_features(), begin, end);
        });
    Energy e;
    e.kinetic = state.kinetic;
    e.rotational = state.rotational;
    e.gravity = state.potential;
    e.elastic_normal = contact_sums_.elastic_normal;
    e.elastic_shear = contact_sums_.elastic_shear;
    e.friction_work = friction_work_;
    e.damping_work = damping_work_ + state.half_step_damping;
    e.external_work = external_work_;
    return e;
}

}  // namespace grainfield::core
