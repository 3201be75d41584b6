#include "core/vector/vector_engine.hpp"

#include <algorithm>
#include <cmath>

namespace grainfield::core {
namespace {

/// Most spheres of a domain: with their contacts they fill most of a 1 MB cache. A small sample has
/// four domains or more, so that threads share the work, but none so small that most is border.
std::size_t domain_size(std::size_t spheres) {
    return std::clamp<std::size_t>(spheres / 4, 1000, 5000);
}

template <class T>
void assign3(T (&to)[3], const Vec3& from) {
    for (int a = 0; a < 3; ++a) to[a] = static_cast<T>(from[a]);
}
template <class T>
Vec3 vec3(const T (&v)[3]) {
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}

}  // namespace

template <class T>
VectorEngine<T>::VectorEngine(World& world, const kernels::VectorKernels<T>& kernels)
    : Engine(world), kernels_(kernels) {
    const ParticleStore& s = world.spheres();
    const std::size_t n = s.size();
    order_ = order_in_space(s.position, domain_size(n));
    built_.position.resize(n);
    built_.reserve.resize(n);
    for (std::size_t slot = 0; slot < n; ++slot)
        built_.position.set(slot, s.position[static_cast<std::size_t>(order_.sphere[slot])]);
    if (n > 0) smallest_radius_ = *std::min_element(s.radius.begin(), s.radius.end());
    domains_.resize(order_.first.size() - 1);
    for (std::size_t d = 0; d < domains_.size(); ++d) {
        Domain<T>& domain = domains_[d];
        domain.first = order_.first[d];
        domain.own = order_.first[d + 1] - order_.first[d];
        domain.records.resize(domain.ghost_begin() + 1);
        domain.bodies.resize(weightless_columns * domain.ghost_begin());
    }
    push();
}

template <class T>
void VectorEngine<T>::push() {
    const ParticleStore& s = world_.spheres();
    for (Domain<T>& domain : domains_)
        for (std::size_t k = 0; k < domain.own; ++k) {
            const auto i = static_cast<std::size_t>(order_.sphere[domain.first + k]);
            kernels::SphereRecord<T>& r = domain.records[k];
            r.radius = static_cast<T>(s.radius[i]);
            assign3(r.v, s.velocity[i]);
            r.compliance = static_cast<T>(1 / s.normal_stiffness[i]);
            assign3(r.w, s.spin[i]);
            r.friction = static_cast<T>(world_.friction(i));
            for (int a = 0; a < 3; ++a) r.radius_spin[a] = r.radius * r.w[a];
            domain.body(inverse_mass)[k] = static_cast<T>(world_.inverse_inertial_mass(i));
            domain.body(spin_response)[k] = static_cast<T>(s.radius[i] * world_.inverse_inertia(i));
        }
    if (weighed_) weigh();
    ghosts_outdated_ = true;
    if (!world_.has_friction)
        for (Domain<T>& domain : domains_) {
            std::fill(domain.pairs.history.begin(), domain.pairs.history.end(), T(0));
            for (WallList<T>& wall : domain.walls)
                std::fill(wall.list.history.begin(), wall.list.history.end(), T(0));
        }
    suspicious_ = true;  // what was pushed has not been looked at
}

/// Gives the bodies their masses.
template <class T>
void VectorEngine<T>::weigh() {
    for (Domain<T>& domain : domains_) {
        domain.bodies.resize(body_columns * domain.ghost_begin());
        for (std::size_t k = 0; k < domain.own; ++k)
            domain.body(mass)[k] = static_cast<T>(mass_of(domain, k));
    }
    weighed_ = true;
}

template <class T>
void VectorEngine<T>::scale_velocities(double factor) {
    const auto f = static_cast<T>(factor);
#pragma omp parallel for schedule(static) if (domains_.size() > 1)
    for (std::size_t d = 0; d < domains_.size(); ++d)
        for (std::size_t k = 0; k < domains_[d].own; ++k)
            for (int a = 0; a < 3; ++a) {
                domains_[d].records[k].v[a] *= f;
                domains_[d].records[k].w[a] *= f;
                domains_[d].records[k].radius_spin[a] *= f;
            }
}

template <class T>
void VectorEngine<T>::pull() {
    ParticleStore& s = world_.scene.spheres;
#pragma omp parallel for schedule(static) if (domains_.size() > 1)
    for (std::size_t d = 0; d < domains_.size(); ++d) {
        const Domain<T>& domain = domains_[d];
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t slot = domain.first + k;
            const auto i = static_cast<std::size_t>(order_.sphere[slot]);
            const kernels::SphereRecord<T>& r = domain.records[k];
            s.position.set(i, built_.position[slot] + vec3(r.u));
            s.velocity.set(i, vec3(r.v));
            s.spin.set(i, vec3(r.w));
        }
    }
}

template <class T>
void VectorEngine<T>::pull_resultants() {
    world_.force.resize(world_.size());
    world_.moment.resize(world_.size());
    run({.again = true, .sums = false, .use = Pass::columns, .step = 0});
}

template <class T>
double VectorEngine<T>::resultant_sum() {
    double sum = 0;
    for (const Domain<T>& domain : domains_) sum += domain.resultant_sum;
    return sum;
}

// --- the step ------------------------------------------------------------------------------------

template <class T>
void VectorEngine<T>::compute_forces(bool sums) {
    if (stale_ || !(used_reserves() < 1)) rebuild();
    run({.again = false, .sums = sums, .use = Pass::sum, .step = 0});
}

template <class T>
void VectorEngine<T>::move(double step) {
    run({.again = true, .sums = false, .use = Pass::motion, .step = step});
}

template <class T>
void VectorEngine<T>::compute_and_move(double step) {
    if (stale_ || !(used_reserves() < 1)) rebuild();
    run({.again = false, .sums = world_.options.ledger, .use = Pass::motion, .step = step});
}

/// Reads what a domain needs out of order, so that it is in this core's cache; columns read in
/// order come by themselves. Loads, because prefetches are dropped where a page's address is not at
/// hand.
template <class T>
void touch(const Domain<T>& domain) {
    const auto read = [](const auto& column) {
        const auto* begin = reinterpret_cast<const char*>(column.data());
        const std::size_t bytes = column.size() * sizeof(column[0]);
        for (std::size_t at = 0; at < bytes; at += 64)
            static_cast<void>(*static_cast<const volatile char*>(begin + at));
    };
    read(domain.records);
    read(std::span(domain.pairs.history.data(), kernels::history_size * domain.pairs.begin[1]));
}

template <class T>
void VectorEngine<T>::run(const Pass& pass) {
    if (!pass.again) {
        // Once a stretch of candidates is in play it stays so until the next build: contacts in it
        // carry history.
        most_used_ = std::max(most_used_, used_reserves());
        planes_.clear();
        for (std::size_t w = 0; w < world_.planes.size(); ++w) planes_.push_back(wall_plane(w));
    }
    if (pass.use == Pass::motion) affine_ = affine_motion(pass.step);
    if (world_.motion_features().gravity && !weighed_) weigh();
    const kernels::MoveParameters<T> motion = move_parameters(pass.step);
    make_scratch();
#pragma omp parallel if (domains_.size() > 1)
    {
        if (!pass.again || ghosts_outdated_) {
#pragma omp for schedule(static)
            for (std::size_t d = 0; d < domains_.size(); ++d) copy_ghosts(domains_[d]);
        }
        Scratch<T>& scratch = scratch_[static_cast<std::size_t>(omp_get_thread_num())];
        const auto team = static_cast<std::size_t>(omp_get_num_threads());
        std::size_t coming = domains_.size();  // whose records are on their way into the cache
#pragma omp for schedule(dynamic, 1)
        for (std::size_t d = 0; d < domains_.size(); ++d) {
            Domain<T>& domain = domains_[d];
            if (d != coming) touch(domain);
            coming = d + team;  // threads mostly take turns
            find_forces(domain, coming < domains_.size() ? &domains_[coming] : nullptr, pass,
                        scratch);
            use_loads(domain, scratch.loads, pass, motion);
        }
    }
    ghosts_outdated_ = false;
    collect(pass);
}

template <class T>
void VectorEngine<T>::use_loads(Domain<T>& domain, const Aligned<kernels::SphereLoad<T>>& loads,
                                const Pass& pass, const kernels::MoveParameters<T>& motion) {
    if (pass.use == Pass::motion) {
        const auto move = kernels_.spheres.move(world_.motion_features());
        domain.motion = move(domain.records.data(), loads.data(), domain.columns(built_.position),
                             motion, domain.ghost_begin());
        return;
    }
    domain.resultant_sum = 0;
    for (std::size_t k = 0; k < domain.own; ++k) {
        const Vec3 force = vec3(loads[k].force) + mass_of(domain, k) * world_.scene.gravity;
        domain.resultant_sum += force.norm();
        if (pass.use != Pass::columns) continue;
        const auto i = static_cast<std::size_t>(order_.sphere[domain.first + k]);
        world_.force.set(i, force);
        world_.moment.set(i, world_.spheres().radius[i] * vec3(loads[k].moment_per_radius));
    }
}

template <class T>
void VectorEngine<T>::copy_ghosts(Domain<T>& domain) {
    kernels::SphereRecord<T>* ghost = domain.records.data() + domain.ghost_begin();
    const auto& homes = domain.ghost_homes;
    constexpr std::size_t ahead = 16;  // they lie anywhere: memory is asked for several at a time
    for (std::size_t g = 0; g < homes.size(); ++g) {
        if (g + ahead < homes.size()) {
            __builtin_prefetch(homes[g + ahead]);
            __builtin_prefetch(ghost + g + ahead, 1);
        }
        ghost[g] = *homes[g];
    }
}

/// Loads of a domain's spheres into scratch.loads. `coming` is read next.
template <class T>
void VectorEngine<T>::find_forces(Domain<T>& domain, const Domain<T>* coming, const Pass& pass,
                                  Scratch<T>& scratch) {
    scratch.loads.assign(domain.records.size(), {});
    kernels::PairParameters<T> parameters = pair_parameters();
    parameters.counted = static_cast<std::int32_t>(domain.own) * kernels::record_stride<T>;
    const auto kernel = [&](const auto& kernels, bool friction) {
        const kernels::ContactFeatures features{friction, world_.per_sphere, pass.sums};
        return pass.again ? kernels.replay(features) : kernels.compute(features);
    };
    kernels::Candidates<T> candidates = domain.pairs.view(most_used_, scratch.touching);
    if (coming != nullptr) {
        candidates.coming = reinterpret_cast<const char*>(coming->records.data());
        candidates.coming_bytes = coming->records.size() * sizeof(kernels::SphereRecord<T>);
    }
    kernels::PassResult result = kernel(kernels_.pairs, world_.has_friction)(
        domain.records.data(), candidates, scratch.loads.data(), parameters);
    std::vector<kernels::WallLoad>& wall_loads =
        pass.again ? scratch.known_wall_loads : domain.wall_loads;
    wall_loads.assign(planes_.size(), {});
    for (WallList<T>& list : domain.walls) {
        const auto w = static_cast<std::size_t>(list.wall);
        const kernels::PassResult of_wall = kernel(kernels_.walls, world_.has_wall_friction)(
            domain.records.data(), planes_[w], list.list.view(most_used_, scratch.touching),
            scratch.loads.data(), parameters, wall_loads[w]);
        result.sums += of_wall.sums;
        result.too_deep |= of_wall.too_deep;
    }
    if (!pass.again) domain.pass = result;
}

template <class T>
void VectorEngine<T>::collect(const Pass& pass) {
    if (!pass.again) {
        world_.begin_wall_loads();
        for (const Domain<T>& domain : domains_) {
            world_.contact_sums += domain.pass.sums;
            suspicious_ |= domain.pass.too_deep;
            for (std::size_t w = 0; w < world_.planes.size(); ++w)
                world_.wall_loads[w] += domain.wall_loads[w];
        }
        world_.end_evaluation();
    }
    if (pass.use != Pass::motion) return;
    double used2 = 0;
    for (const Domain<T>& domain : domains_) {
        used2 = std::max(used2, domain.motion.used_reserve2);
        suspicious_ |= domain.motion.too_far;
        stale_ |= domain.motion.too_far;  // the next list build names what is not a number
        world_.damping_work += domain.motion.damping_work;
    }
    used_reserve_ = std::sqrt(used2);
}

template <class T>
kernels::PairParameters<T> VectorEngine<T>::pair_parameters() const {
    return {static_cast<T>(world_.scene.stiffness_ratio),
            static_cast<T>(world_.uniform_stiffness()),
            static_cast<T>(world_.uniform_friction()),
            static_cast<T>(smallest_radius_),
            static_cast<T>(world_.elapsed()),
            0};
}

template <class T>
kernels::MoveParameters<T> VectorEngine<T>::move_parameters(double step) const {
    kernels::MoveParameters<T> p;
    assign3(p.gravity, world_.scene.gravity);
    p.force_damping = static_cast<T>(world_.scene.damping.force);
    p.moment_damping = static_cast<T>(world_.scene.damping.moment);
    p.old_step = static_cast<T>(world_.old_step);
    p.new_step = static_cast<T>(step);
    for (int a = 0; a < 3; ++a) p.middle[a] = middle_[a];
    assign3(p.affine_shift, affine_.shift + affine_.scale.cwiseProduct(middle_));
    assign3(p.affine_scale, affine_.scale);
    return p;
}

template <class T>
kernels::WallPlane<T> VectorEngine<T>::wall_plane(std::size_t wall) const {
    const kernels::PlaneWall& plane = world_.planes[wall];
    kernels::WallPlane<T> p;
    assign3(p.normal, plane.normal);
    assign3(p.velocity, plane.velocity);
    p.advance = static_cast<T>(plane.normal.dot(plane.point - built_walls_[wall]));
    p.friction = static_cast<T>(plane.friction);
    p.stiffness = static_cast<T>(plane.normal_stiffness);
    p.stiffness_ratio = static_cast<T>(plane.stiffness_ratio);
    return p;
}

}  // namespace grainfield::core

#include "core/vector/vector_contacts.inc"
#include "core/vector/vector_lists.inc"
#include "core/vector/vector_search.inc"
#include "core/vector/vector_state.inc"

namespace grainfield::core {

template class VectorEngine<float>;
template class VectorEngine<double>;

}  // namespace grainfield::core
