#pragma once
// Local (non-viscous, Cundall) damping of one component of a resultant force or moment.

#include <cmath>

namespace grainfield::kernels {

/// Sign of the velocity at the time of the force, as damping needs it, in [-1, 1].
///
/// The velocity kept is that of the middle of the last step, v-. At the time of the force it is
/// v = v- + (h_old/2)(F - alpha |F| s)/m with s = sign(v): an equation for s, whose solution is
/// s = clamp(v*/(alpha |F| h_old/2m), -1, 1) with the undamped v* = v- + (h_old/2) F/m. Force and
/// velocity are thus taken at the same time, and s passes through zero without a jump.
///   undamped  v* [m/s or rad/s]
///   limit     alpha |F| h_old/(2m), zero in the first step [m/s or rad/s]
///   load      F; a body at rest in its first step starts along it [N or N m]
inline double damping_sign(double undamped, double limit, double load) {
    if (undamped > limit) return 1.0;
    if (undamped < -limit) return -1.0;
    if (limit > 0.0) return undamped / limit;
    return load > 0.0 ? 1.0 : load < 0.0 ? -1.0 : 0.0;
}

/// The part of the load that damping takes away: alpha |F| sign(v). It acts an axis at a time and
/// is therefore not objective: a sample turned by 45 degrees is damped differently.
inline double damping_force(double load, double alpha, double velocity,
                            double half_old_step_over_mass) {
    const double taken = alpha * std::abs(load);
    return taken * damping_sign(velocity + half_old_step_over_mass * load,
                                half_old_step_over_mass * taken, load);
}

}  // namespace grainfield::kernels
