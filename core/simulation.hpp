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

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/engine.hpp"
#include "core/scene/energy.hpp"
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
    const kernels::KernelTable& kernel_table() const { return *kernels_; }

    /// Forces at the present positions. With `sums`, contact_sums() is valid afterwards. Calling it
    /// again before the next advance() changes nothing else.
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
    const kernels::ContactSums& contact_sums() const { return world_->contact_sums; }
    /// Contacts that touched at the last force evaluation, sorted by (i, j), walls last.
    std::vector<TouchingContact> touching() const { return engine_->touching(); }
    std::int64_t touching_contacts() const { return engine_->touching_count(); }  ///< [-]
    /// Restores the shear forces of contacts; those of bodies that are not near each other are left
    /// out. Returns how many were restored. Forces have been computed before.
    std::size_t restore_shear(std::span<const ContactShear> contacts) {
        return engine_->restore(contacts);
    }
    /// The shear force on i [N] of one contact, j = -1 - wall for a wall; true if it was restored.
    bool restore_shear(std::int32_t i, std::int32_t j, const Vec3& shear) {
        return restore_shear(std::array{ContactShear{i, j, shear}}) == 1;
    }
    /// The next force evaluation searches for neighbours anew; for tests, nothing needs it.
    void rebuild_lists() { engine_->invalidate_lists(); }
    std::int64_t list_builds() const { return engine_->list_builds(); }      ///< so far [-]
    std::int64_t neighbour_searches() const { return engine_->searches(); }  ///< so far [-]
    /// Searches for the neighbours of a few spheres alone, so far [-].
    std::int64_t neighbour_renewals() const { return engine_->renewals(); }
    /// Pairs of spheres, i < j, that may touch before one of these two grows; lists must exist.
    std::vector<kernels::Pair> neighbours() const { return engine_->neighbours(); }
    StepCost step_cost() const { return engine_->step_cost(); }  ///< of the step taken last
    /// Candidates in the lists; those that the engine looks at twice count twice [-].
    std::int64_t candidates() const { return engine_->candidate_count(); }

    /// Velocity and spin of sphere i at the present time (those stored are of mid-step).
    kernels::OnStep on_step(std::size_t i) const;
    /// Resultant force on sphere i, gravity included [N].
    Vec3 resultant(std::size_t i) const;
    /// Mean resultant over mean contact force; compute_forces(true) must have been called. 0 where
    /// nothing touches and nothing pulls, infinite where nothing touches but something pulls [-].
    double unbalanced_force_ratio() const;
    /// Ledger at the present time; compute_forces(true) must have been called. The works are only
    /// kept with SimulationOptions::ledger. It follows velocities and masses that are changed;
    /// other properties, gravity or walls shifted at once break it.
    Energy energy() const;
    bool keeps_ledger() const { return world_->options.ledger; }

    // Steering. All take effect with the next advance() or compute_forces().
    void set_wall_velocity(std::size_t wall, const Vec3& velocity);  ///< [m/s]
    void set_wall_point(std::size_t wall, const Vec3& point);        ///< shifts a wall at once [m]
    void set_gravity(const Vec3& gravity);                           ///< [m/s2]
    void set_damping(const Damping& damping);
    void set_friction_angle(double angle);  ///< of all spheres [rad]
    void set_properties(std::span<const double> normal_stiffness,
                        std::span<const double> friction_angle);  ///< [Pa], [rad]
    void scale_velocities(double factor);                         ///< spins too [-]
    /// Adds velocity(x) [m/s] to that of every sphere, x its centre [m].
    template <class Field>
    void add_velocities(const Field& velocity) {
        world_->external_work += energy_gained([&] {
            ParticleStore& s = changing();
            for (std::size_t i = 0; i < s.size(); ++i)
                s.velocity.set(i, s.velocity[i] + velocity(i, s.position[i]));
            engine_->push();
        });
    }
    void set_walls(std::vector<Wall> walls);  ///< replaces all; history with walls is lost
    /// Inertia of each sphere relative to its real mass (mass scaling), >= 1 [-].
    void set_inertia_scale(std::span<const double> scale);
    /// Of the motion of sphere i [1/kg], and of its spin [1/(kg m2)]; scaled ones.
    double inverse_inertial_mass(std::size_t i) const { return world_->inverse_inertial_mass(i); }
    double inverse_inertia(std::size_t i) const { return world_->inverse_inertia(i); }

    /// Throws SimulationError, naming sphere, step, time and place, if a position or velocity is
    /// not a number, an overlap exceeds half a radius, or a sphere moves more than half its radius
    /// in a step. Looks in full only where the engine has noticed something.
    void check_state() const;
    /// True if the last step gives reason to call check_state() at once.
    bool alarmed() const { return engine_->alarmed(); }

    /// Hash of the whole mechanical state (positions, velocities, spins, touching contacts with
    /// their shear forces, walls, time), as 16 hexadecimal digits.
    std::string state_hash() const;

    /// The whole state between two steps: a simulation that loads it goes on to the same bits, with
    /// any number of threads. Forces have to be computed before anything asks for them.
    void save(StateWriter& archive) const;
    /// Replaces everything. Throws InputError if it was saved with other kernels.
    void load(StateReader& archive);

  private:
    void move_walls(double step);
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

}  // namespace grainfield::core
