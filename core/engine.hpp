#pragma once
// What computes the steps of a simulation. The reference engine is written to be read and is the
// oracle; the vector engine is written to be fast.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/scene/world.hpp"
#include "core/state/bytes.hpp"

namespace grainfield::core {

/// A contact that touched at the last force evaluation, as others see it.
struct TouchingContact {
    std::int32_t i, j;  ///< spheres, i < j; j = -1 - wall for a wall [-]
    Vec3 shear;         ///< shear force on i [N]
    Vec3 force;         ///< whole force on i [N]
};

/// What a contact carries from step to step.
struct ContactShear {
    std::int32_t i, j;  ///< spheres; j = -1 - wall for a wall [-]
    Vec3 shear;         ///< shear force on i [N]
};

/// What a step has to do, for those who measure.
struct StepCost {
    double bytes = 0;            ///< read and written if nothing stays in cache; 0: unknown [B]
    std::int64_t evaluated = 0;  ///< contacts evaluated, those of two domains twice [-]
};

class Engine {
  public:
    explicit Engine(World& world) : world_(world) {}
    virtual ~Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    /// Forces at the present positions: wall loads; with `sums`, also world.contact_sums.
    /// Rebuilds the lists if the motion demands it.
    virtual void compute_forces(bool sums) = 0;
    /// Moves the spheres by a step [s]; compute_forces() must have been called.
    virtual void move(double step) = 0;
    /// True if compute_and_move() is less work than the two calls.
    virtual bool fuses() const { return false; }
    /// Both at once, for a step [s] whose wall velocities are not known yet.
    virtual void compute_and_move(double step) {
        compute_forces(world_.options.ledger);
        move(step);
    }

    /// Brings the store's positions, velocities and spins up to date.
    virtual void download() = 0;
    /// Brings world.force and world.moment up to date; forces must be current.
    virtual void download_resultants() = 0;
    /// Takes over velocities, spins and properties changed in the store.
    virtual void upload() = 0;
    /// Multiplies velocities and spins; the store is out of date until the next download().
    virtual void scale_velocities(double factor) = 0;
    /// Takes over walls that were replaced: history with the old ones is lost.
    virtual void forget_walls() = 0;
    /// The next evaluation builds new lists.
    virtual void invalidate_lists() = 0;

    /// All touching contacts, sorted by (i, j) with the walls last, in their order.
    virtual std::vector<TouchingContact> touching() const = 0;
    virtual std::int64_t touching_count() const = 0;
    virtual std::int64_t candidate_count() const = 0;  ///< in the lists, walls too [-]
    /// Outer list: pairs of spheres, i < j in no particular order, that may touch before the next
    /// search.
    virtual std::vector<kernels::Pair> neighbours() const = 0;
    /// Sum over spheres of |resultant force|; forces must be current [N].
    virtual double resultant_sum() = 0;
    /// Sets the shear forces of candidates, which touch from then on (used when a saved state is
    /// loaded). Leaves out those that are no candidates; returns how many are.
    virtual std::size_t restore(std::span<const ContactShear> contacts) = 0;
    /// All that the engine carries from step to step, so that a run goes on to the same bits. What
    /// is loaded was saved by an engine for the same kernels; the world has been loaded before.
    virtual void save(StateWriter& archive) const = 0;
    virtual void load(StateReader& archive) = 0;
    /// True if the steps since cleared() give reason to look at the whole state.
    virtual bool suspicious() const = 0;
    virtual void cleared() {}
    /// True if the last step gives reason to look at once: a sphere moved more than half its
    /// radius, or two overlap too much. It may look sound again a few steps later.
    virtual bool alarmed() const = 0;
    virtual std::int64_t list_builds() const = 0;  ///< of the inner list, so far [-]
    /// Of the step taken last.
    virtual StepCost step_cost() const { return {0, touching_count()}; }
    /// Builds of the outer list so far; of inner ones there are more [-].
    virtual std::int64_t searches() const { return list_builds(); }
    /// Of the outer list, for a few spheres alone, so far [-].
    virtual std::int64_t partial_rebuilds() const { return 0; }

  protected:
    World& world_;
};

/// The engine for a kernel table.
std::unique_ptr<Engine> make_engine(World& world, const kernels::KernelTable& kernels);

}  // namespace grainfield::core
