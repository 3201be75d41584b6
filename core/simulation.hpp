#pragma once
// The stepping loop. One step is two calls, so that drivers can measure and steer in between:
//
//   compute_forces()   1 rebuild the lists if the motion demands it
//                      2 contact forces   3 wall forces   4 resultants
//   [measure; set wall velocities for the coming step; choose its length]
//   advance(step)      5 move spheres   6 move walls   7 time goes on
//
// step() does both at once where nothing but wall velocities is steered in between, to the same
// bits. Results are the same, bit for bit, for any number of threads.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/scene/energy.hpp"
#include "core/simulation_views.hpp"
#include "core/state/bytes.hpp"

namespace grainfield::core {

class Simulation {
  public:
    Simulation(Scene scene, const kernels::KernelTable& kernels, SimulationOptions options = {});

    /// The scene as it is now; spheres' velocities and spins are of mid-step.
    const Scene& scene() const;
    const ParticleStore& spheres() const { return scene().spheres; }
    std::size_t size() const { return world_->size(); }
    std::span<const Wall> walls() const { return world_->scene.walls; }

    /// Forces at the present positions. With `sums`, contacts().sums() is valid afterwards. Calling
    /// it again before the next advance() changes nothing else.
    void compute_forces(bool sums = false);
    /// Moves everything by one step [s] > 0; compute_forces() must have been called.
    void advance(double step);
    /// compute_forces() and advance(step), with steer() called in between: it may read wall loads
    /// and set wall velocities, nothing else.
    template <class Steer>
    void step(double step, const Steer& steer) {
        if (!engine_->fuses()) {
            compute_forces();
            steer();
            return advance(step);
        }
        engine_->compute_and_move(step);
        moved();
        steer();
        move_walls(step);
    }

    double time() const { return world_->time; }           ///< [s]
    std::int64_t steps() const { return world_->steps; }   ///< taken so far [-]
    double last_step() const { return world_->old_step; }  ///< before now; 0 at first [s]

    /// Load of each wall at the last force evaluation.
    std::span<const kernels::WallLoad> wall_loads() const { return world_->wall_loads; }

    // By subject (simulation_views.hpp).
    ContactView contacts() const { return {*engine_, *world_}; }
    StatsView stats() const { return {*engine_, *kernels_}; }
    HealthView health() const { return HealthView(*this); }
    SphereView sphere(std::size_t i) const { return {*this, i}; }
    Change change() { return Change(*this); }
    /// Takes effect with the next advance() [m/s].
    void set_wall_velocity(std::size_t wall, const Vec3& velocity) {
        world_->scene.walls.at(wall).velocity = velocity;
    }

    /// Mean resultant over mean contact force; compute_forces(true) must have been called. 0 where
    /// nothing touches and nothing pulls, infinite where nothing touches but something pulls [-].
    double unbalanced_force_ratio() const;
    /// Ledger at the present time; compute_forces(true) must have been called. The works are only
    /// kept with SimulationOptions::ledger. It follows velocities and masses that are changed;
    /// other properties, gravity or walls shifted at once break it.
    Energy energy() const;
    bool keeps_ledger() const { return world_->options.ledger; }

    /// Hash of the whole mechanical state (positions, velocities, spins, touching contacts with
    /// their shear forces, walls, time), as 16 hexadecimal digits.
    std::string state_hash() const;

    /// The whole state between two steps: a simulation that loads it goes on to the same bits, with
    /// any number of threads. Forces have to be computed before anything asks for them.
    void save(StateWriter& archive) const;
    /// Replaces everything. Throws InputError if it was saved with other kernels.
    void load(StateReader& archive);

  private:
    friend class Change;
    friend class HealthView;
    friend class SphereView;
    void move_walls(double step);
    const Vec3Column& resultants() const;
    ParticleStore& changing();
    /// Makes a change; with the ledger, the energy that it brought [J].
    double energy_gained(const std::function<void()>& change);
    void changed();
    void moved();

    // Engines keep working copies; the store is brought up to date when somebody looks.
    std::unique_ptr<World> world_;  // at a fixed address: the engine refers to it
    const kernels::KernelTable* kernels_;
    std::unique_ptr<Engine> engine_;
    mutable bool store_current_ = true, resultants_current_ = false;
};

inline bool HealthView::alarmed() const {
    return simulation_.engine_->alarmed();
}
inline double SphereView::inverse_inertial_mass() const {
    return simulation_.world_->inverse_inertial_mass(i_);
}
inline double SphereView::inverse_inertia() const {
    return simulation_.world_->inverse_inertia(i_);
}

template <class Field>
void Change::add_velocities(const Field& velocity) {
    simulation_.world_->external_work += simulation_.energy_gained([&] {
        ParticleStore& s = simulation_.changing();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.velocity.set(i, s.velocity[i] + velocity(i, s.position[i]));
        simulation_.engine_->upload();
    });
}

}  // namespace grainfield::core
