// The reference sphere kernels: scalar, double precision, written to be read.

#include <algorithm>
#include <cmath>

#include "kernels/damping.hpp"
#include "kernels/sphere_kernels.hpp"

namespace grainfield::kernels {
namespace {

/// Acceleration at time n of one degree of freedom, damping included.
template <bool Damping>
double acceleration(double load, double velocity, double inverse_mass, double alpha,
                    double old_step) {
    if constexpr (Damping)
        load -= damping_force(load, alpha, velocity, 0.5 * old_step * inverse_mass);
    return load * inverse_mass;
}

/// Work of the damping of one degree of freedom over `half_motion` = half a step of its velocity.
double damping_work(double load, double velocity, double inverse_mass, double alpha,
                    double old_step, double half_motion) {
    return damping_force(load, alpha, velocity, 0.5 * old_step * inverse_mass) * half_motion;
}

template <bool Rotation>
void gather(const MotionColumns& s, const ContactColumns& contacts, const std::uint32_t* offsets,
            const Incidence* incidences, const MotionParameters& p, bool gravity, std::size_t begin,
            std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        Vec3 force = gravity ? Vec3(s.mass[i] * p.gravity) : Vec3(Vec3::Zero());
        Vec3 moment = Vec3::Zero();
        for (std::uint32_t e = offsets[i]; e < offsets[i + 1]; ++e) {
            const std::uint32_t c = incidences[e] >> 1;
            if (!contacts.touching[c]) continue;
            const bool second = incidences[e] & 1;
            force += second ? Vec3(-contacts.force[c]) : contacts.force[c];
            // Both spheres of a pair get a moment of the same sense.
            if constexpr (Rotation) moment += contacts.moment_per_radius[c];
        }
        s.fx[i] = force.x();
        s.fy[i] = force.y();
        s.fz[i] = force.z();
        if constexpr (Rotation) {
            s.mx[i] = s.radius[i] * moment.x();
            s.my[i] = s.radius[i] * moment.y();
            s.mz[i] = s.radius[i] * moment.z();
        }
    }
}

template <bool Damping, bool Rotation, bool Ledger>
MotionSums move(const MotionColumns& s, const MotionParameters& p, std::size_t begin,
                std::size_t end) {
    MotionSums sums;
    const double mean_step = 0.5 * (p.old_step + p.new_step);
    const auto kick = [&](double load, double& velocity, double inverse_mass, double alpha) {
        const double a = acceleration<Damping>(load, velocity, inverse_mass, alpha, p.old_step);
        const double kicked = velocity + mean_step * a;
        if constexpr (Damping && Ledger)
            sums.damping_work += damping_work(load, velocity, inverse_mass, alpha, p.old_step,
                                              0.5 * (p.old_step * velocity + p.new_step * kicked));
        velocity = kicked;
    };
    for (std::size_t i = begin; i < end; ++i) {
        const double inverse_mass = s.inverse_inertial_mass[i];
        kick(s.fx[i], s.vx[i], inverse_mass, p.force_damping);
        kick(s.fy[i], s.vy[i], inverse_mass, p.force_damping);
        kick(s.fz[i], s.vz[i], inverse_mass, p.force_damping);
        s.x[i] += p.new_step * s.vx[i];
        s.y[i] += p.new_step * s.vy[i];
        s.z[i] += p.new_step * s.vz[i];
        if constexpr (Rotation) {
            const double inverse_inertia = s.inverse_inertia[i];
            kick(s.mx[i], s.wx[i], inverse_inertia, p.moment_damping);
            kick(s.my[i], s.wy[i], inverse_inertia, p.moment_damping);
            kick(s.mz[i], s.wz[i], inverse_inertia, p.moment_damping);
        }
        const double dx = s.x[i] - p.x0[i] - (p.affine.shift.x() + p.affine.scale.x() * p.x0[i]);
        const double dy = s.y[i] - p.y0[i] - (p.affine.shift.y() + p.affine.scale.y() * p.y0[i]);
        const double dz = s.z[i] - p.z0[i] - (p.affine.shift.z() + p.affine.scale.z() * p.z0[i]);
        const double square = dx * dx + dy * dy + dz * dz;
        // Written so that a NaN becomes an infinite displacement: the next list build names it.
        if (!(square <= sums.max_square_displacement))
            sums.max_square_displacement = std::isnan(square) ? HUGE_VAL : square;
    }
    return sums;
}

}  // namespace

void gather_forces(const MotionColumns& s, const ContactColumns& contacts,
                   const std::uint32_t* offsets, const Incidence* incidences,
                   const MotionParameters& p, MotionFeatures f, std::size_t begin,
                   std::size_t end) {
    (f.rotation ? gather<true> : gather<false>)(s, contacts, offsets, incidences, p, f.gravity,
                                                begin, end);
}

MotionSums move_spheres(const MotionColumns& s, const MotionParameters& p, MotionFeatures f,
                        std::size_t begin, std::size_t end) {
    if (!f.damping)
        return (f.rotation ? move<false, true, false> : move<false, false, false>)(s, p, begin,
                                                                                   end);
    if (f.ledger)
        return (f.rotation ? move<true, true, true> : move<true, false, true>)(s, p, begin, end);
    return (f.rotation ? move<true, true, false> : move<true, false, false>)(s, p, begin, end);
}

OnStep on_step_motion(const MotionColumns& s, const MotionParameters& p, MotionFeatures f,
                      std::size_t i) {
    const auto now = [&](double load, double velocity, double inverse_mass, double alpha) {
        const double a = f.damping
                             ? acceleration<true>(load, velocity, inverse_mass, alpha, p.old_step)
                             : acceleration<false>(load, velocity, inverse_mass, alpha, p.old_step);
        return velocity + 0.5 * p.old_step * a;
    };
    const double m = s.inverse_inertial_mass[i];
    const double t = s.inverse_inertia[i];
    OnStep motion;
    motion.velocity = {now(s.fx[i], s.vx[i], m, p.force_damping),
                       now(s.fy[i], s.vy[i], m, p.force_damping),
                       now(s.fz[i], s.vz[i], m, p.force_damping)};
    motion.spin = f.rotation ? Vec3(now(s.mx[i], s.wx[i], t, p.moment_damping),
                                    now(s.my[i], s.wy[i], t, p.moment_damping),
                                    now(s.mz[i], s.wz[i], t, p.moment_damping))
                             : Vec3(s.wx[i], s.wy[i], s.wz[i]);
    return motion;
}

StateSums sum_state(const MotionColumns& s, const MotionParameters& p, MotionFeatures f,
                    std::size_t begin, std::size_t end) {
    StateSums sums;
    for (std::size_t i = begin; i < end; ++i) {
        const OnStep motion = on_step_motion(s, p, f, i);
        sums.kinetic += 0.5 * motion.velocity.squaredNorm() / s.inverse_inertial_mass[i];
        sums.rotational += 0.5 * motion.spin.squaredNorm() / s.inverse_inertia[i];
        sums.potential -= s.mass[i] * p.gravity.dot(Vec3(s.x[i], s.y[i], s.z[i]));
        sums.resultant += Vec3(s.fx[i], s.fy[i], s.fz[i]).norm();
        if (!f.damping) continue;
        const double half = 0.5 * p.old_step;
        const auto work = [&](double load, double velocity, double inverse_mass, double alpha) {
            sums.half_step_damping +=
                damping_work(load, velocity, inverse_mass, alpha, p.old_step, half * velocity);
        };
        const double m = s.inverse_inertial_mass[i];
        work(s.fx[i], s.vx[i], m, p.force_damping);
        work(s.fy[i], s.vy[i], m, p.force_damping);
        work(s.fz[i], s.vz[i], m, p.force_damping);
        if (!f.rotation) continue;
        const double t = s.inverse_inertia[i];
        work(s.mx[i], s.wx[i], t, p.moment_damping);
        work(s.my[i], s.wy[i], t, p.moment_damping);
        work(s.mz[i], s.wz[i], t, p.moment_damping);
    }
    return sums;
}

}  // namespace grainfield::kernels
