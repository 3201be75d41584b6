#pragma once
// The stepping loop. One step is two calls, so that drivers can measure and steer in between:
//
//   compute_forces()   1 rebuild the lists if the motion demands it
//                      2 contact forces   3 wall forces   4 resultants
//   [measure; set wall velocities for the coming step; choose its length]
//   advance(step)      5 move spheres   6 move walls   7 time goes on
//
// Results are the same, bit for bit, for any number of threads, any skin and any age of the lists.

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact_list.hpp"
#include "core/scene.hpp"
#include "kernels/contact_kernels.hpp"
#include "kernels/sphere_kernels.hpp"

namespace grainfield::core {

/// Energies and works [J]. kinetic to gravity are of the present state; the works are sums since
/// the start. closing() is constant in exact arithmetic of the scheme.
struct Energy {
    double kinetic = 0, rotational = 0;            ///< at time n [J]
    double elastic_normal = 0, elastic_shear = 0;  ///< [J]
    double friction_work = 0;                      ///< dissipated by slip [J]
    double damping_work = 0;                       ///< dissipated by local damping [J]
    double external_work = 0;                      ///< put in by moving walls [J]
    double gravity = 0;                            ///< potential, -m g.x [J]

    double closing() const {
        return kinetic + rotational + elastic_normal + elastic_shear + friction_work +
               damping_work + gravity - external_work;
    }
};

struct SimulationOptions {
    double skin = 0;      ///< of the candidate list; 0: chosen from the radii [m]
    bool ledger = false;  ///< keep the works of friction, damping and walls in every step
};

class Simulation {
  public:
    Simulation(Scene scene, const kernels::KernelTable& kernels, SimulationOptions options = {});

    const Scene& scene() const { return scene_; }
    const ParticleStore& spheres() const { return scene_.spheres; }
    std::span<const Wall> walls() const { return scene_.walls; }
    const kernels::KernelTable& kernel_table() const { return *kernels_; }

    /// Forces at the present positions. With `sums`, contact_sums() is valid afterwards. Calling it
    /// again before the next advance() changes nothing else.
    void compute_forces(bool sums = false);
    /// Moves everything by one step [s] > 0; compute_forces() must have been called.
    void advance(double step);

    double time() const { return time_; }           ///< [s]
    std::int64_t steps() const { return steps_; }   ///< taken so far [-]
    double last_step() const { return old_step_; }  ///< before the present time; 0 at first [s]

    /// Load of each wall at the present positions.
    std::span<const kernels::WallLoad> wall_loads() const { return wall_loads_; }
    const kernels::ContactSums& contact_sums() const { return contact_sums_; }
    ContactList& contacts() { return contacts_; }
    const ContactList& contacts() const { return contacts_; }
    std::int64_t touching_contacts() const;  ///< [-]

    /// Velocity and spin of sphere i at the present time (those stored are of mid-step).
    kernels::OnStep on_step(std::size_t i) const;
    /// Resultant force on sphere i, gravity included [N].
    Vec3 resultant(std::size_t i) const { return force_[i]; }
    /// Mean resultant over mean contact force; compute_forces(true) must have been called. 0 where
    /// nothing touches and nothing pulls, infinite where nothing touches but something pulls [-].
    double unbalanced_force_ratio() const;
    /// Ledger at the present time; compute_forces(true) must have been called. The works are only
    /// kept with SimulationOptions::ledger.
    Energy energy() const;

    // Steering. All take effect with the next advance() or compute_forces().
    void set_wall_velocity(std::size_t wall, const Vec3& velocity);  ///< [m/s]
    void set_wall_point(std::size_t wall, const Vec3& point);        ///< shifts a wall at once [m]
    void set_gravity(const Vec3& gravity);                           ///< [m/s2]
    void set_damping(const Damping& damping);
    void set_friction_angle(double angle);  ///< of all spheres [rad]
    void set_properties(std::span<const double> normal_stiffness,
                        std::span<const double> friction_angle);  ///< [Pa], [rad]
    void add_velocity(std::size_t i, const Vec3& velocity);       ///< [m/s]
    void scale_velocities(double factor);                         ///< spins too [-]
    void set_walls(std::vector<Wall> walls);  ///< replaces all; history with walls is lost
    /// Inertia of each sphere relative to its real mass (mass scaling), >= 1 [-].
    void set_inertia_scale(std::span<const double> scale);
    std::span<const double> inverse_inertial_mass() const { return inverse_inertial_mass_; }
    std::span<const double> inverse_inertia() const { return inverse_inertia_; }

    /// Throws SimulationError, naming sphere, step, time and place, if a position or velocity is
    /// not a number, an overlap exceeds half a radius, or a sphere moves more than half its radius
    /// in a step.
    void check_state() const;

    /// Hash of the whole mechanical state (positions, velocities, spins, touching contacts with
    /// their shear forces, walls, time), as 16 hexadecimal digits.
    std::string state_hash() const;

  private:
    void refresh_properties();
    bool lists_outdated() const;
    kernels::AffineMotion affine_motion() const;
    double unpaired_wall_motion() const;
    kernels::SphereColumns sphere_columns() const;
    kernels::MotionColumns motion_columns() const;
    kernels::MotionParameters motion_parameters(double new_step) const;
    kernels::MotionFeatures motion_features() const;
    void wall_forces(bool sums);
    /// Motion that the contacts have not seen yet [s].
    double elapsed() const { return forces_at_ == steps_ ? 0.0 : old_step_; }

    Scene scene_;
    const kernels::KernelTable* kernels_;
    SimulationOptions options_;
    ContactList contacts_;

    Column<double> friction_;  // tan(phi)
    Column<double> inertia_scale_, inverse_inertial_mass_, inverse_inertia_;
    Vec3Column force_, moment_;
    bool has_friction_ = false, has_wall_friction_ = false, per_sphere_ = false;
    double largest_radius_ = 0;

    std::vector<kernels::PlaneWall> planes_;
    std::vector<kernels::WallLoad> wall_loads_, last_wall_loads_;
    kernels::ContactSums contact_sums_;
    double friction_work_ = 0, damping_work_ = 0, external_work_ = 0;

    double max_square_displacement_ = 0;
    double time_ = 0, old_step_ = 0;
    std::int64_t steps_ = 0;
    std::int64_t forces_at_ = -1;  // steps taken when forces were last computed
};

}  // namespace grainfield::core
