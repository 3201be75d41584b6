#pragma once
// What a step does sphere by sphere: adds up the forces of its contacts, and moves it.
//
// Leapfrog: positions x_n, velocities v_(n-1/2); the same for spins. Spheres need no orientation.
//   v_(n+1/2) = v_(n-1/2) + (h_old + h_new)/2 a_n,   x_(n+1) = x_n + h_new v_(n+1/2)
// with h_old, h_new the steps before and after n. a_n holds the local damping, whose sign is taken
// at time n (damping.hpp). Exact for constant acceleration, second order otherwise.

#include <cstddef>
#include <cstdint>

#include "kernels/contact_kernels.hpp"
#include "kernels/vec3.hpp"

namespace grainfield::kernels {

/// One contact of a sphere: 2 * contact + side, side 1 being the second body of a pair.
using Incidence = std::uint32_t;

/// Mutable columns of the spheres that moving them touches.
struct MotionColumns {
    double *x, *y, *z;                    ///< centres [m]
    double *vx, *vy, *vz;                 ///< mid-step velocity [m/s]
    double *wx, *wy, *wz;                 ///< mid-step spin [rad/s]
    double *fx, *fy, *fz;                 ///< resultant force, gravity included [N]
    double *mx, *my, *mz;                 ///< resultant moment [N m]
    const double* radius;                 ///< [m]
    const double* mass;                   ///< gravitational mass [kg]
    const double* inverse_inertial_mass;  ///< of the motion; differs from 1/mass if scaled [1/kg]
    const double* inverse_inertia;        ///< of the spin [1/(kg m2)]
};

/// Motion of a homogeneously strained box since the contact lists were built: u = shift + scale*x.
/// What spheres do beyond it is what can bring new neighbours together.
struct AffineMotion {
    Vec3 shift = Vec3::Zero();  ///< [m]
    Vec3 scale = Vec3::Zero();  ///< [-]
};

struct MotionParameters {
    Vec3 gravity = Vec3::Zero();  ///< [m/s2]
    double force_damping = 0;     ///< alpha [-]
    double moment_damping = 0;    ///< alpha [-]
    double old_step = 0;          ///< h_old; 0 in the first step [s]
    double new_step = 0;          ///< h_new [s]
    const double *x0, *y0, *z0;   ///< centres when the lists were built [m]
    AffineMotion affine;          ///< at the end of this step
};

struct MotionFeatures {
    bool gravity, damping, rotation;
    bool ledger;  ///< MotionSums::damping_work is wanted
};

/// Result of moving a range of spheres.
struct MotionSums {
    double max_square_displacement = 0;  ///< since the lists were built, beyond affine [m2]
    double damping_work = 0;  ///< dissipated from half a step before to half a step after n [J]
};

/// Sums of the state at time n, velocities brought to n.
struct StateSums {
    double kinetic = 0;            ///< of translation [J]
    double rotational = 0;         ///< [J]
    double potential = 0;          ///< -m g.x [J]
    double half_step_damping = 0;  ///< damping work of the half step before n [J]
    double resultant = 0;          ///< sum of |resultant force| [N]

    StateSums& operator+=(const StateSums& o) {
        kinetic += o.kinetic;
        rotational += o.rotational;
        potential += o.potential;
        half_step_damping += o.half_step_damping;
        resultant += o.resultant;
        return *this;
    }
};

/// Resultant of spheres begin <= i < end: gravity, then the touching contacts in list order, so
/// that the sum does not depend on threads or on which candidates the list holds.
void gather_forces(const MotionColumns&, const ContactColumns&, const std::uint32_t* offsets,
                   const Incidence* incidences, const MotionParameters&, MotionFeatures,
                   std::size_t begin, std::size_t end);

/// Moves spheres begin <= i < end by one step. Reads the resultants, changes state.
MotionSums move_spheres(const MotionColumns&, const MotionParameters&, MotionFeatures,
                        std::size_t begin, std::size_t end);

/// Velocity and spin at time n of sphere i, from the mid-step state and the resultants.
struct OnStep {
    Vec3 velocity, spin;  ///< [m/s], [rad/s]
};
OnStep on_step_motion(const MotionColumns&, const MotionParameters&, MotionFeatures, std::size_t i);

/// Energies and resultants of spheres begin <= i < end at time n.
StateSums sum_state(const MotionColumns&, const MotionParameters&, MotionFeatures,
                    std::size_t begin, std::size_t end);

}  // namespace grainfield::kernels
