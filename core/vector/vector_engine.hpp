#pragma once
// The fast engine: packed records, vector kernels, domains. T is float in mixed precision (forces
// and motion in float, positions exact at every list build, long sums in double), double otherwise.
//
// A step goes through these stages. Between the double lines is one parallel region; a thread takes
// one domain after the other through stages 2 to 4, while its data are in cache:
//
//     0 lists         inner and outer Verlet lists, where they are outdated (VerletLists)
//     ================================================================== threads start
//     1 ghosts        every domain copies the records of its neighbours outside
//     ------------------------------------------------------------------ all have theirs
//     2 pair forces   | contacts between spheres: loads of the domain's own spheres
//     3 wall forces   | contacts with walls: to the same loads, and loads of the walls
//     4 integrate     v damping, velocities, displacements, use of the buffers
//     ================================================================== threads end
//     5 reduce        domain by domain in their order: wall loads, sums, ledger, use of the buffers
//
// The loads of spheres live in a core's cache between stages 2 and 4 and nowhere else. A step that
// somebody looks into ends after stage 3; who wants the loads later has them replayed, from the
// shear forces that the evaluation left, to the same bits:
//
//                           lists, ghosts   stages 2 and 3   then
//     compute_forces()           yes           compute       |resultants| are added up
//     compute_and_move()         yes           compute       integrate
//     move()                     no            replay        integrate
//     download_resultants()      no            replay        resultants are stored
//
// Results are the same, bit for bit, for any number of threads; they depend on when the lists are
// built, which follows from the state alone.

#include "core/engine.hpp"
#include "core/vector/contact_history.hpp"
#include "core/vector/verlet_lists.hpp"

namespace grainfield::core {

/// A thread's own memory.
template <class T>
struct Scratch {
    Aligned<kernels::SphereLoad<T>> loads;  ///< of one domain's records
    Aligned<std::int32_t> touching;
    std::vector<kernels::WallLoad> replayed_wall_loads;
};

template <class T>
class VectorEngine : public Engine {
  public:
    VectorEngine(World& world, const kernels::VectorKernels<T>& kernels);

    // The step (vector_engine.cpp).
    void compute_forces(bool sums) override;
    void move(double step) override;
    bool fuses() const override { return true; }
    void compute_and_move(double step) override;

    // To and from the store (vector_transfer.cpp).
    void download() override;
    void download_resultants() override;
    void upload() override;
    void scale_velocities(double factor) override;

    // Lists and contacts.
    void forget_walls() override { lists_.forget_walls(); }
    void invalidate_lists() override { lists_.invalidate(); }
    std::vector<TouchingContact> touching() const override { return contacts_.touching(); }
    std::int64_t touching_count() const override { return contacts_.touching_count(); }
    std::int64_t candidate_count() const override { return lists_.candidate_count(); }
    std::vector<kernels::Pair> neighbours() const override { return lists_.outer_pairs(); }
    std::size_t restore(std::span<const ContactShear> contacts) override {
        return contacts_.restore(contacts);
    }
    std::int64_t list_builds() const override { return lists_.builds(); }
    std::int64_t searches() const override { return lists_.searches(); }
    std::int64_t partial_rebuilds() const override { return lists_.partial_rebuilds(); }

    double resultant_sum() override;
    StepCost step_cost() const override;
    bool suspicious() const override { return suspicious_; }
    void cleared() override { suspicious_ = false; }
    bool alarmed() const override { return suspicious_; }

    // Checkpoints (vector_state.cpp).
    void save(StateWriter& archive) const override;
    void load(StateReader& archive) override;

  private:
    /// A domain on its way through stages 2 to 4.
    struct Task {
        std::size_t d;
        Domain<T>& domain;
        const Domain<T>* coming;  // its records are read next; or null
        Scratch<T>& scratch;
    };

    // Stage 0, and what an evaluation needs of all walls.
    void begin_evaluation();
    // Stage 1.
    void copy_ghosts(Domain<T>& domain);
    /// Stage 1 if anything that ghosts show has changed, and work(task) for every domain.
    template <class Work>
    void for_domains(bool ghosts_moved, const Work& work);
    // Stages 2 and 3.
    void compute_loads(const Task& task, bool sums);
    void replay_loads(const Task& task);
    kernels::PassResult pair_forces(const Task& task, kernels::VectorPairKernel<T> kernel);
    void wall_forces(const Task& task, kernels::VectorWallKernel<T> kernel,
                     std::vector<kernels::WallLoad>& wall_loads, kernels::PassResult& result);
    // Stage 4, or what becomes of the loads instead.
    kernels::MoveParameters<T> begin_motion(double step);
    void integrate(const Task& task, const kernels::MoveParameters<T>& motion);
    /// Adds up |resultant| over the own spheres, and calls use(k, resultant); gravity included [N].
    template <class Use>
    void for_resultants(const Task& task, const Use& use);
    // Stage 5.
    void reduce_forces();
    void reduce_motion();

    kernels::PairParameters<T> pair_parameters(const Domain<T>& domain) const;
    kernels::MoveParameters<T> move_parameters(double step) const;
    kernels::WallPlane<T> wall_plane(std::size_t wall) const;
    double mass_of(const Domain<T>& domain, std::size_t k) const {
        return world_.spheres().mass[sample_.sphere(domain, k)];
    }
    void upload_masses();
    /// Lists the state for an archive, in either direction.
    template <class Self, class Archive>
    static void list_state(Self& self, Archive& archive);

    const kernels::VectorKernels<T>& kernels_;
    Decomposition<T> sample_;
    VerletLists<T> lists_;
    ContactHistory<T> contacts_;
    std::vector<Scratch<T>> scratch_;            // of each thread
    std::vector<kernels::WallPlane<T>> planes_;  // at the last force evaluation
    bool suspicious_ = false;
    bool has_masses_ = false;      // the bodies have theirs
    bool ghosts_outdated_ = true;  // of what does not change by motion
};

}  // namespace grainfield::core
