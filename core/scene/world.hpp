#pragma once
// What a simulation consists of: the scene, what follows from it, what the last force evaluation
// found, and the clock. Engines compute on it; Simulation guards it.

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/scene/scene.hpp"
#include "kernels/contact_kernels.hpp"
#include "kernels/sphere_kernels.hpp"

namespace grainfield::core {

struct SimulationOptions {
    double skin = 0;      ///< of the candidate list; 0: chosen from the radii [m]
    bool ledger = false;  ///< keep the works of friction, damping and walls in every step
};

struct World {
    Scene scene;
    SimulationOptions options;

    Column<double> inertia_scale;  ///< inertia over real mass; empty where it is 1 throughout [-]

    // What follows from the scene; refresh() keeps it.
    std::vector<kernels::PlaneWall> planes;  ///< as the contacts see the walls
    bool has_friction = false, has_wall_friction = false;
    bool per_sphere = false;  ///< stiffness or friction differ from sphere to sphere
    double smallest_radius = 0, largest_radius = 0;  ///< [m]

    // What the last force evaluation found.
    Vec3Column force, moment;  ///< resultants, gravity included: Engine::download_resultants()
    std::vector<kernels::WallLoad> wall_loads, last_wall_loads;
    kernels::ContactSums contact_sums;  ///< where sums were asked for
    // With the ledger [J].
    double friction_work = 0, damping_work = 0, external_work = 0, work_put_in = 0;

    // The clock.
    double time = 0;              ///< [s]
    double old_step = 0;          ///< before the present time; 0 at first [s]
    std::int64_t steps = 0;       ///< taken [-]
    std::int64_t forces_at = -1;  ///< steps taken when forces were last computed [-]

    World(Scene scene_, SimulationOptions options_);

    /// Recomputes what follows from the scene.
    void refresh();

    const ParticleStore& spheres() const { return scene.spheres; }
    std::size_t size() const { return scene.spheres.size(); }
    /// Motion that the contacts have not seen yet [s].
    double elapsed() const { return forces_at == steps ? 0.0 : old_step; }
    double uniform_stiffness() const { return size() ? spheres().normal_stiffness[0] : 0.0; }
    double uniform_friction() const { return size() ? friction(0) : 0.0; }
    double friction(std::size_t i) const { return std::tan(spheres().friction_angle[i]); }  ///< [-]
    /// Of the motion [1/kg].
    double inverse_inertial_mass(std::size_t i) const { return 1.0 / inertial_mass(i); }
    /// Of the spin [1/(kg m2)].
    double inverse_inertia(std::size_t i) const {
        const double radius = spheres().radius[i];
        return 1.0 / (0.4 * inertial_mass(i) * radius * radius);
    }
    kernels::MotionFeatures motion_features() const;

    /// Clears the wall loads for a new evaluation and keeps the last ones.
    void begin_wall_loads();
    /// Adds the works of the evaluation just made to the ledger, if it is kept.
    void end_evaluation();

  private:
    double inertial_mass(std::size_t i) const {
        return spheres().mass[i] * (inertia_scale.empty() ? 1.0 : inertia_scale[i]);
    }
};

/// Motion of the box between the walls at `built` and the walls at `now` [m]: where two opposite
/// walls bound an axis and no other wall has a part along it, the homogeneous strain between them.
kernels::AffineMotion box_motion(std::span<const Wall> walls, std::span<const Vec3> built,
                                 std::span<const Vec3> now);

/// The low and the high wall that bound a box along an axis; {-1, -1} where there are none.
std::array<int, 2> bounding_walls(std::span<const Wall> walls, int axis);

}  // namespace grainfield::core
