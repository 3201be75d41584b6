#include "core/vector/verlet_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"

namespace grainfield::core {
namespace {

// An inner buffer: a share of the skin, and the way that the sphere goes in so many steps at its
// present speed.
constexpr double inner_share = 0.25, inner_steps = 60;
// The same for the outer buffer, which serves several inner lists.
constexpr double outer_share = 2.0, outer_steps = 300;
constexpr double most_buffer = 1.0;  // of the smallest radius [-]
constexpr double least_inner = 0.2;  // of the skin: with less a search is due [-]
// Displacements since the search are added up in float, which loses 6e-8 of them with every build.
// This much is set aside for it [-].
constexpr double lost_way = 1e-5;

template <class T>
void put_back(std::span<kernels::SphereRecord<T>> records) {
    for (kernels::SphereRecord<T>& record : records)
        for (T& u : record.u) u = 0;
}

std::vector<Vec3> wall_points(std::span<const Wall> walls) {
    std::vector<Vec3> points;
    for (const Wall& wall : walls) points.push_back(wall.point);
    return points;
}

}  // namespace

template <class T>
VerletBuffers<T>::VerletBuffers(const World& world, Decomposition<T>& sample)
    : world_(world), sample_(sample) {
    const ParticleStore& s = world.spheres();
    built_.position.resize(s.size());
    built_.buffer.resize(s.size());
    built_.reach.resize(sample.size());
    for (std::size_t slot = 0; slot < s.size(); ++slot)
        built_.position.set(slot, s.position[static_cast<std::size_t>(sample.order.sphere[slot])]);
}

// --- expiry --------------------------------------------------------------------------------------

template <class T>
kernels::AffineMotion VerletBuffers<T>::affine_motion(double ahead) const {
    std::vector<Vec3> now;
    for (const Wall& wall : world_.scene.walls) now.push_back(wall.point + ahead * wall.velocity);
    return box_motion(world_.scene.walls, built_.walls, now);
}

template <class T>
double VerletBuffers<T>::used() const {
    // Of a sphere: what it moved beyond the homogeneous strain of the box, and its half of the way
    // that strain brought it closer to a neighbour.
    const double strain = affine_.scale.cwiseAbs().maxCoeff();
    double used = used_by_spheres_ + strain * reach_per_buffer_;
    // Of a wall: by how much it deviated from that strain. A wall askew to an axis leaves that axis
    // without strain (bounding_walls), so that all its points deviate by as much.
    const auto& walls = world_.scene.walls;
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const Vec3& n = walls[w].normal;
        const Vec3& built = built_.walls[w];
        const Vec3 foreseen = affine_.shift + affine_.scale.cwiseProduct(built);
        const double deviation = std::abs(n.dot(walls[w].point - built - foreseen));
        used = std::max(used, deviation / built_.wall_buffer);
    }
    return used;
}

// --- here and now --------------------------------------------------------------------------------

template <class T>
void VerletBuffers<T>::take_positions(bool outer_holds) {
    std::vector<char> lost(sample_.size(), 0);
    for_pieces(sample_.size(), [&](std::size_t d) {
        Domain<T>& domain = sample_.domains[d];
        Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t slot = domain.first + k;
            const Vec3 u = vec3(domain.records[k].u);
            const Vec3 x = built_.position[slot] + u;
            if (!x.allFinite()) {
                lost[d] = 1;
                continue;
            }
            built_.position.set(slot, x);
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
            if (!outer_holds) continue;
            for (std::size_t a = 0; a < 3; ++a)
                outer_.moved[slot][a] += static_cast<float>(u[static_cast<int>(a)]);
        }
        if (!lost[d]) put_back<T>({domain.records.data(), domain.own});
        built_.reach[d].centres = {low, high};
    });
    Box all{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        if (lost[d]) name_lost_sphere(sample_.domains[d]);
        const Box& centres = built_.reach[d].centres;
        all.lower = d == 0 ? centres.lower : all.lower.cwiseMin(centres.lower);
        all.upper = d == 0 ? centres.upper : all.upper.cwiseMax(centres.upper);
    }
    built_.middle = 0.5 * (all.lower + all.upper);
}

/// Throws for the first sphere of a domain whose position is not a number.
template <class T>
void VerletBuffers<T>::name_lost_sphere(const Domain<T>& domain) const {
    std::size_t k = 0;
    while ((built_.position[domain.first + k] + vec3(domain.records[k].u)).allFinite()) ++k;
    const Vec3 x = built_.position[domain.first + k];
    std::string what =
        fmt::format("the position of sphere {} is not a number", sample_.sphere(domain, k));
    if (x.allFinite())
        what += fmt::format(", it was near ({:g}, {:g}, {:g}) m", x.x(), x.y(), x.z());
    throw SimulationError(
        fmt::format("{} (step {}, time {:g} s)", what, world_.steps, world_.time));
}

template <class T>
void VerletBuffers<T>::take_walls() {
    built_.walls = wall_points(world_.scene.walls);
}

template <class T>
void VerletBuffers<T>::begin_inner() {
    reach_per_buffer_ = 0;
    for (const DomainReach& reach : built_.reach)
        reach_per_buffer_ = std::max(reach_per_buffer_, reach.reach_per_buffer);
    take_walls();
    affine_ = {};
    used_by_spheres_ = 0;
}

template <class T>
void VerletBuffers<T>::begin_outer() {
    outer_.moved.assign(world_.size(), {});
    outer_.buffer.resize(world_.size());
    outer_.walls = wall_points(world_.scene.walls);
}

// --- the buffers ---------------------------------------------------------------------------------

/// Rates of the box's strain at present [1/s].
template <class T>
kernels::AffineMotion VerletBuffers<T>::affine_rate() const {
    std::vector<Vec3> now, ahead;
    for (const Wall& wall : world_.scene.walls) {
        now.push_back(wall.point);
        ahead.push_back(wall.point + wall.velocity);
    }
    return box_motion(world_.scene.walls, now, ahead);
}

template <class T>
BufferRules VerletBuffers<T>::rules(bool outer_holds) const {
    const double skin = world_.options.skin, radius = most_buffer * world_.smallest_radius;
    BufferRules rules;
    rules.inner = inner_share * skin;
    rules.most_inner = std::max(rules.inner, radius);
    rules.least_inner = least_inner * skin;
    rules.outer = outer_share * skin;
    rules.most_outer = std::max(rules.outer, radius);
    rules.rate = affine_rate();
    if (!outer_holds) return rules;
    const std::vector<Vec3> now = wall_points(world_.scene.walls);
    rules.since_search = box_motion(world_.scene.walls, outer_.walls, now);
    rules.strain = rules.since_search.scale.cwiseAbs().maxCoeff();
    return rules;
}

/// What a sphere may move in so many steps at its present speed beyond the box's strain [m].
template <class T>
double VerletBuffers<T>::foreseen_way(const Domain<T>& domain, std::size_t k, double steps,
                                      const kernels::AffineMotion& rate) const {
    const Vec3 x = built_.position[domain.first + k];
    const Vec3 beyond = vec3(domain.records[k].v) - rate.shift - rate.scale.cwiseProduct(x);
    return steps * world_.old_step * beyond.norm();
}

template <class T>
Shortage VerletBuffers<T>::choose_inner(const BufferRules& rules) {
    built_.wall_buffer = rules.inner;
    std::vector<std::vector<std::int32_t>> scarce(sample_.size());
    std::vector<char> exhausted(sample_.size(), 0);
    for_pieces(sample_.size(), [&](std::size_t d) {
        const Domain<T>& domain = sample_.domains[d];
        built_.reach[d].largest_reach = built_.reach[d].reach_per_buffer = 0;
        for (std::size_t k = 0; k < domain.own; ++k) {
            const Remainder left = choose_inner(d, k, rules);
            if (left == Remainder::enough) continue;
            scarce[d].push_back(static_cast<std::int32_t>(domain.first + k));
            if (left == Remainder::none) exhausted[d] = 1;
        }
    });
    return {std::find(exhausted.begin(), exhausted.end(), 1) != exhausted.end(), joined(scarce)};
}

template <class T>
Remainder VerletBuffers<T>::choose_inner(std::size_t d, std::size_t k, const BufferRules& rules) {
    Domain<T>& domain = sample_.domains[d];
    const std::size_t slot = domain.first + k;
    const Vec3 x0 = searched_position(slot), moved = built_.position[slot] - x0;
    const Vec3 beyond =
        moved - rules.since_search.shift - rules.since_search.scale.cwiseProduct(x0);
    const double given = outer(slot), radius = radii()[slot];
    const double left =
        given - beyond.norm() - by_strain(rules.strain, radius, given) - lost_way * moved.norm();
    const double wanted =
        std::min(rules.most_inner, rules.inner + foreseen_way(domain, k, inner_steps, rules.rate));
    if (!(left >= rules.least_inner)) return Remainder::none;
    // Rounded down: no more than there is.
    const double buffer =
        double{built_.buffer[slot] = static_cast<float>((1 - 1e-7) * std::min(wanted, left))};
    DomainReach& reach = built_.reach[d];
    reach.largest_reach = std::max(reach.largest_reach, radius + buffer);
    reach.reach_per_buffer =
        std::max(reach.reach_per_buffer, by_strain(1, radius, buffer) / buffer);
    domain.body(inverse_buffer)[k] = static_cast<T>(1 / buffer);
    return left < wanted ? Remainder::scarce : Remainder::enough;
}

template <class T>
double VerletBuffers<T>::choose_outer(const Domain<T>& domain, std::size_t k,
                                      const BufferRules& rules) {
    const std::size_t slot = domain.first + k;
    outer_.buffer[slot] = static_cast<float>(
        std::min(rules.most_outer, rules.outer + foreseen_way(domain, k, outer_steps, rules.rate)));
    return outer(slot);
}

template <class T>
void VerletBuffers<T>::join_outer(std::size_t slot, const BufferRules& rules) {
    const Vec3 now = built_.position[slot];
    const Vec3 then =
        (now - rules.since_search.shift).cwiseQuotient(Vec3::Ones() + rules.since_search.scale);
    for (std::size_t a = 0; a < 3; ++a)
        outer_.moved[slot][a] = static_cast<float>((now - then)[static_cast<int>(a)]);
}

template <class T>
Vec3 VerletBuffers<T>::searched_position(std::size_t slot) const {
    const std::array<float, 3>& moved = outer_.moved[slot];
    return built_.position[slot] - Vec3(double{moved[0]}, double{moved[1]}, double{moved[2]});
}

template class VerletBuffers<float>;
template class VerletBuffers<double>;

}  // namespace grainfield::core
