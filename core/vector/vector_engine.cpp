#include "core/vector/vector_engine.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace grainfield::core {
namespace {

/// Brings into this core's cache what stages 2 to 4 read out of order; what they read in order the
/// hardware fetches by itself. It loads, because a prefetch is dropped where the TLB does not hold
/// the page.
template <class T>
void touch(const Domain<T>& domain, const CandidateList<T>& pairs) {
    const auto read = [](const auto& column) {
        const auto* begin = reinterpret_cast<const char*>(column.data());
        const std::size_t bytes = column.size() * sizeof(column[0]);
        for (std::size_t at = 0; at < bytes; at += 64)
            static_cast<void>(*static_cast<const volatile char*>(begin + at));
    };
    read(domain.records);
    read(std::span(pairs.history.data(), kernels::history_size * pairs.begin[1]));
}

}  // namespace

template <class T>
VectorEngine<T>::VectorEngine(World& world, const kernels::VectorKernels<T>& kernels)
    : Engine(world),
      kernels_(kernels),
      sample_(decompose<T>(world)),
      lists_(world, sample_, kernels),
      contacts_(world, sample_, lists_) {
    upload();
}

// --- the step ------------------------------------------------------------------------------------

template <class T>
void VectorEngine<T>::compute_forces(bool sums) {
    begin_evaluation();
    for_domains(true, [&](const Task& task) {
        compute_loads(task, sums);
        for_resultants(task, [](std::size_t, const Vec3&) {});
    });
    reduce_forces();
}

template <class T>
void VectorEngine<T>::compute_and_move(double step) {
    begin_evaluation();
    const kernels::MoveParameters<T> motion = begin_motion(step);
    for_domains(true, [&](const Task& task) {
        compute_loads(task, world_.options.ledger);
        integrate(task, motion);
    });
    reduce_forces();
    reduce_motion();
}

template <class T>
void VectorEngine<T>::move(double step) {
    const kernels::MoveParameters<T> motion = begin_motion(step);
    for_domains(false, [&](const Task& task) {
        replay_loads(task);
        integrate(task, motion);
    });
    reduce_motion();
}

template <class T>
template <class Work>
void VectorEngine<T>::for_domains(bool ghosts_moved, const Work& work) {
    const std::size_t domains = sample_.size();
    if (world_.motion_features().gravity && !has_masses_) upload_masses();
    const bool ghosts = ghosts_moved || ghosts_outdated_;
    const int threads = domains > 1 ? omp_get_max_threads() : 1;
    scratch_.resize(static_cast<std::size_t>(threads));
    // `coming`: whose records are on their way into the cache of this thread.
    const auto do_domain = [&](std::size_t d, std::size_t thread, std::size_t team,
                               std::size_t& coming) {
        Domain<T>& domain = sample_.domains[d];
        if (d != coming) touch(domain, lists_.of(d).inner);
        coming = d + team;  // threads mostly take turns
        work(Task{d, domain, coming < domains ? &sample_.domains[coming] : nullptr,
                  scratch_[thread]});
    };
    if (threads == 1) {
        std::size_t coming = domains;
        if (ghosts)
            for (Domain<T>& domain : sample_.domains) copy_ghosts(domain);
        for (std::size_t d = 0; d < domains; ++d) do_domain(d, 0, 1, coming);
    } else {
#pragma omp parallel
        {
            if (ghosts) {
#pragma omp for schedule(static)
                for (std::size_t d = 0; d < domains; ++d) copy_ghosts(sample_.domains[d]);
            }
            const auto thread = static_cast<std::size_t>(omp_get_thread_num());
            const auto team = static_cast<std::size_t>(omp_get_num_threads());
            std::size_t coming = domains;
#pragma omp for schedule(dynamic, 1)
            for (std::size_t d = 0; d < domains; ++d) do_domain(d, thread, team, coming);
        }
    }
    ghosts_outdated_ = false;
}

// --- stages 0 and 1: lists and ghosts ------------------------------------------------------------

template <class T>
void VectorEngine<T>::begin_evaluation() {
    if (lists_.outdated()) lists_.rebuild();
    lists_.bring_into_play();
    planes_.clear();
    for (std::size_t w = 0; w < world_.planes.size(); ++w) planes_.push_back(wall_plane(w));
}

template <class T>
void VectorEngine<T>::copy_ghosts(Domain<T>& domain) {
    kernels::SphereRecord<T>* ghost = domain.records.data() + domain.ghost_begin();
    const auto& sources = domain.ghost_sources;
    constexpr std::size_t ahead = 16;  // they lie anywhere: memory is asked for several at a time
    for (std::size_t g = 0; g < sources.size(); ++g) {
        if (g + ahead < sources.size()) {
            __builtin_prefetch(sources[g + ahead]);
            __builtin_prefetch(ghost + g + ahead, 1);
        }
        ghost[g] = *sources[g];
    }
}

// --- stages 2 and 3: forces ----------------------------------------------------------------------

template <class T>
void VectorEngine<T>::compute_loads(const Task& task, bool sums) {
    kernels::PassResult result =
        pair_forces(task, kernels_.pairs.compute({world_.has_friction, world_.per_sphere, sums}));
    wall_forces(task, kernels_.walls.compute({world_.has_wall_friction, world_.per_sphere, sums}),
                task.domain.wall_loads, result);
    task.domain.pass = result;
}

template <class T>
void VectorEngine<T>::replay_loads(const Task& task) {
    kernels::PassResult known =
        pair_forces(task, kernels_.pairs.replay({world_.has_friction, world_.per_sphere, false}));
    wall_forces(task, kernels_.walls.replay({world_.has_wall_friction, world_.per_sphere, false}),
                task.scratch.replayed_wall_loads, known);
}

template <class T>
kernels::PassResult VectorEngine<T>::pair_forces(const Task& task,
                                                 kernels::VectorPairKernel<T> kernel) {
    Scratch<T>& scratch = task.scratch;
    scratch.loads.assign(task.domain.records.size(), {});
    kernels::Candidates<T> pairs = lists_.in_play(lists_.of(task.d).inner, scratch.touching);
    if (task.coming != nullptr) {
        pairs.coming = reinterpret_cast<const char*>(task.coming->records.data());
        pairs.coming_bytes = task.coming->records.size() * sizeof(kernels::SphereRecord<T>);
    }
    return kernel(task.domain.records.data(), pairs, scratch.loads.data(),
                  pair_parameters(task.domain));
}

template <class T>
void VectorEngine<T>::wall_forces(const Task& task, kernels::VectorWallKernel<T> kernel,
                                  std::vector<kernels::WallLoad>& wall_loads,
                                  kernels::PassResult& result) {
    wall_loads.assign(planes_.size(), {});
    const kernels::PairParameters<T> parameters = pair_parameters(task.domain);
    for (WallList<T>& walls : lists_.of(task.d).walls) {
        const auto w = static_cast<std::size_t>(walls.wall);
        const kernels::PassResult of_wall =
            kernel(task.domain.records.data(), planes_[w],
                   lists_.in_play(walls.list, task.scratch.touching), task.scratch.loads.data(),
                   parameters, wall_loads[w]);
        result.sums += of_wall.sums;
        result.too_deep |= of_wall.too_deep;
    }
}

template <class T>
kernels::PairParameters<T> VectorEngine<T>::pair_parameters(const Domain<T>& domain) const {
    return {static_cast<T>(world_.scene.stiffness_ratio),
            static_cast<T>(world_.uniform_stiffness()),
            static_cast<T>(world_.uniform_friction()),
            static_cast<T>(world_.smallest_radius),
            static_cast<T>(world_.elapsed()),
            static_cast<std::int32_t>(domain.own) * kernels::record_stride<T>};
}

template <class T>
kernels::WallPlane<T> VectorEngine<T>::wall_plane(std::size_t wall) const {
    const kernels::PlaneWall& plane = world_.planes[wall];
    kernels::WallPlane<T> p;
    assign3(p.normal, plane.normal);
    assign3(p.velocity, plane.velocity);
    p.advance = static_cast<T>(plane.normal.dot(plane.point - lists_.built().walls[wall]));
    p.friction = static_cast<T>(plane.friction);
    p.stiffness = static_cast<T>(plane.normal_stiffness);
    p.stiffness_ratio = static_cast<T>(plane.stiffness_ratio);
    return p;
}

// --- stage 4: what becomes of the loads ----------------------------------------------------------

template <class T>
kernels::MoveParameters<T> VectorEngine<T>::begin_motion(double step) {
    lists_.buffers().foresee(step);
    return move_parameters(step);
}

template <class T>
void VectorEngine<T>::integrate(const Task& task, const kernels::MoveParameters<T>& motion) {
    Domain<T>& domain = task.domain;
    const auto kernel = kernels_.spheres.move(world_.motion_features());
    domain.motion = kernel(domain.records.data(), task.scratch.loads.data(),
                           domain.columns(lists_.built().position), motion, domain.ghost_begin());
}

template <class T>
template <class Use>
void VectorEngine<T>::for_resultants(const Task& task, const Use& use) {
    Domain<T>& domain = task.domain;
    domain.resultant_sum = 0;
    for (std::size_t k = 0; k < domain.own; ++k) {
        const Vec3 force =
            vec3(task.scratch.loads[k].force) + mass_of(domain, k) * world_.scene.gravity;
        domain.resultant_sum += force.norm();
        use(k, force);
    }
}

template <class T>
void VectorEngine<T>::download_resultants() {
    world_.force.resize(world_.size());
    world_.moment.resize(world_.size());
    for_domains(false, [&](const Task& task) {
        replay_loads(task);
        for_resultants(task, [&](std::size_t k, const Vec3& force) {
            const std::size_t i = sample_.sphere(task.domain, k);
            world_.force.set(i, force);
            world_.moment.set(
                i, world_.spheres().radius[i] * vec3(task.scratch.loads[k].moment_per_radius));
        });
    });
}

template <class T>
kernels::MoveParameters<T> VectorEngine<T>::move_parameters(double step) const {
    const kernels::AffineMotion& affine = lists_.buffers().affine();
    const Vec3& middle = lists_.built().middle;
    kernels::MoveParameters<T> p;
    assign3(p.gravity, world_.scene.gravity);
    p.force_damping = static_cast<T>(world_.scene.damping.force);
    p.moment_damping = static_cast<T>(world_.scene.damping.moment);
    p.old_step = static_cast<T>(world_.old_step);
    p.new_step = static_cast<T>(step);
    for (int a = 0; a < 3; ++a) p.middle[a] = middle[a];
    assign3(p.affine_shift, affine.shift + affine.scale.cwiseProduct(middle));
    assign3(p.affine_scale, affine.scale);
    return p;
}

// --- stage 5: sums over the domains, in their order ----------------------------------------------

template <class T>
void VectorEngine<T>::reduce_forces() {
    world_.begin_wall_loads();
    for (const Domain<T>& domain : sample_.domains) {
        world_.contact_sums += domain.pass.sums;
        suspicious_ |= domain.pass.too_deep;
        for (std::size_t w = 0; w < world_.planes.size(); ++w)
            world_.wall_loads[w] += domain.wall_loads[w];
    }
    world_.end_evaluation();
}

template <class T>
void VectorEngine<T>::reduce_motion() {
    double used2 = 0;
    for (const Domain<T>& domain : sample_.domains) {
        used2 = std::max(used2, domain.motion.used_buffer2);
        suspicious_ |= domain.motion.too_far;
        if (domain.motion.too_far) lists_.invalidate();  // the rebuild names what is not a number
        world_.damping_work += domain.motion.damping_work;
    }
    lists_.buffers().set_used_by_spheres(std::sqrt(used2));
}

// --- views ---------------------------------------------------------------------------------------

template <class T>
double VectorEngine<T>::resultant_sum() {
    double sum = 0;
    for (const Domain<T>& domain : sample_.domains) sum += domain.resultant_sum;
    return sum;
}

template <class T>
StepCost VectorEngine<T>::step_cost() const {
    constexpr double record = sizeof(kernels::SphereRecord<T>);
    constexpr double history = kernels::history_size * sizeof(T);
    constexpr double candidate = 2 * sizeof(std::int32_t) + kernels::separation_size * sizeof(T);
    const double bodies =
        3 * sizeof(double) +
        (world_.motion_features().gravity ? body_columns : weightless_columns) * sizeof(T);
    StepCost cost;
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        const Domain<T>& domain = sample_.domains[d];
        const auto own = static_cast<double>(domain.own);
        const auto ghosts = static_cast<double>(domain.ghost_slots.size());
        const auto in_play = static_cast<double>(lists_.pairs_in_play(d));
        const auto close = static_cast<double>(lists_.of(d).inner.begin[1]);
        cost.bytes += own * (2 * record + bodies) +
                      ghosts * 3 * record +  // read at home, written, read
                      in_play * candidate + close * 2 * history;
        cost.evaluated += domain.pass.contacts + contacts_.wall_count(d);
    }
    return cost;
}

template class VectorEngine<float>;
template class VectorEngine<double>;

}  // namespace grainfield::core
