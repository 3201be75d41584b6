#pragma once
// Views of a simulation by subject; Simulation hands them out. They last no longer than it.

#include <cstdint>
#include <span>
#include <vector>

#include "core/engine.hpp"

namespace grainfield::core {

class Simulation;

/// Simulation::contacts(): those of the last force evaluation.
class ContactView {
  public:
    ContactView(const Engine& engine, const World& world) : engine_(engine), world_(world) {}

    /// Contacts that touch, sorted by (i, j), walls last.
    std::vector<TouchingContact> touching() const { return engine_.touching(); }
    std::int64_t count() const { return engine_.touching_count(); }  ///< that touch [-]
    /// compute_forces(true) must have been called.
    const kernels::ContactSums& sums() const { return world_.contact_sums; }
    /// Pairs of spheres, i < j, that may touch before one of these two grows; lists must exist.
    std::vector<kernels::Pair> neighbours() const { return engine_.neighbours(); }

  private:
    const Engine& engine_;
    const World& world_;
};

/// Simulation::stats(): what the steps cost, and by which kernels.
class StatsView {
  public:
    StatsView(const Engine& engine, const kernels::KernelTable& kernels)
        : engine_(engine), kernels_(kernels) {}

    const kernels::KernelTable& kernel_table() const { return kernels_; }
    std::int64_t list_builds() const { return engine_.list_builds(); }  ///< so far [-]
    std::int64_t searches() const { return engine_.searches(); }  ///< of neighbours so far [-]
    /// Searches for the neighbours of a few spheres alone, so far [-].
    std::int64_t partial_rebuilds() const { return engine_.partial_rebuilds(); }
    StepCost step_cost() const { return engine_.step_cost(); }  ///< of the step taken last
    /// Candidates in the lists; those that the engine looks at twice count twice [-].
    std::int64_t candidates() const { return engine_.candidate_count(); }

  private:
    const Engine& engine_;
    const kernels::KernelTable& kernels_;
};

/// Simulation::health().
class HealthView {
  public:
    explicit HealthView(const Simulation& simulation) : simulation_(simulation) {}

    /// Throws SimulationError, naming sphere, step, time and place, if a position or velocity is
    /// not a number, an overlap exceeds half a radius, or a sphere moves more than half its radius
    /// in a step. Looks in full only where the engine has noticed something.
    void check() const;
    /// True if the last step gives reason to call check() at once.
    bool alarmed() const;

  private:
    const Simulation& simulation_;
};

/// Simulation::sphere(i): what follows from the state of one sphere.
class SphereView {
  public:
    SphereView(const Simulation& simulation, std::size_t i) : simulation_(simulation), i_(i) {}

    /// Velocity and spin at the present time (those stored are of mid-step).
    kernels::OnStep on_step() const;
    /// Resultant force, gravity included [N].
    Vec3 resultant() const;
    /// Of its motion [1/kg], and of its spin [1/(kg m2)]; scaled ones.
    double inverse_inertial_mass() const;
    double inverse_inertia() const;

  private:
    const Simulation& simulation_;
    std::size_t i_;
};

/// Simulation::change(): what may be changed between two steps. All takes effect with the next
/// advance() or compute_forces().
class Change {
  public:
    explicit Change(Simulation& simulation) : simulation_(simulation) {}

    void set_gravity(const Vec3& gravity);  ///< [m/s2]
    void set_damping(const Damping& damping);
    void set_friction_angle(double angle);  ///< of all spheres [rad]
    void set_properties(std::span<const double> normal_stiffness,
                        std::span<const double> friction_angle);  ///< [Pa], [rad]
    /// Inertia of each sphere relative to its real mass (mass scaling), >= 1 [-].
    void set_inertia_scale(std::span<const double> scale);
    void scale_velocities(double factor);  ///< spins too [-]
    /// Adds velocity(i, x) [m/s] to that of every sphere i, x its centre [m].
    template <class Field>
    void add_velocities(const Field& velocity);

    void set_walls(std::vector<Wall> walls);  ///< replaces all; history with walls is lost
    void set_wall_point(std::size_t wall, const Vec3& point);  ///< shifts a wall at once [m]

    /// Restores the shear forces of contacts; those of bodies that are not near each other are left
    /// out. Returns how many were restored. Forces have been computed before.
    std::size_t restore_shear(std::span<const ContactShear> contacts);
    /// The shear force on i [N] of one contact, j = -1 - wall for a wall; true if it was restored.
    bool restore_shear(std::int32_t i, std::int32_t j, const Vec3& shear);
    /// The next force evaluation searches for neighbours anew; for tests, nothing needs it.
    void rebuild_lists();

  private:
    Simulation& simulation_;
};

}  // namespace grainfield::core
