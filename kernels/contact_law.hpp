#pragma once
// The contact law of one contact: linear springs, Coulomb friction, no tension. Equations are
// those of Tran et al. and of docs/method.md, section 1. Pure functions on values; the loops over
// contacts are in kernels/reference_contacts.cpp.

#include <algorithm>
#include <cmath>

#include "kernels/vec3.hpp"

namespace grainfield::kernels {

/// Eq. (4) of Tran et al.: K = r kA kB / (kA + kB), r the mean radius [m], k in [Pa]; result in
/// [N/m].
inline double contact_stiffness(double mean_radius, double k_a, double k_b) {
    return mean_radius * k_a * k_b / (k_a + k_b);
}

/// A rotation by a finite angle, applied without trigonometry: t is the rotation axis times
/// tan(angle/2), and R v = v + 2/(1 + t.t) (t x v + t x (t x v)) (Euler-Rodrigues).
class Rotation {
  public:
    /// From a rotation vector (axis times angle) [rad].
    explicit Rotation(const Vec3& rotation_vector) {
        const double angle2 = rotation_vector.squaredNorm();
        // tan(a/2)/a by its series below 1e-2 rad: the next term is under 1e-12 of the first.
        const double scale =
            angle2 < 1e-4
                ? 0.5 + angle2 * (1.0 / 24.0 + angle2 * (1.0 / 240.0 + angle2 * (17.0 / 40320.0)))
                : std::tan(0.5 * std::sqrt(angle2)) / std::sqrt(angle2);
        t_ = scale * rotation_vector;
        factor_ = 2.0 / (1.0 + t_.squaredNorm());
    }
    Vec3 operator*(const Vec3& v) const {
        const Vec3 c = t_.cross(v);
        return v + factor_ * (c + t_.cross(c));
    }

  private:
    Vec3 t_;
    double factor_;
};

/// Carries a vector tangent at `from` to the tangent plane at `to` by the smallest rotation that
/// takes one unit normal to the other; its length is kept. from = -to is not allowed.
inline Vec3 swing(const Vec3& tangent, const Vec3& from, const Vec3& to) {
    const Vec3 carried = tangent - tangent.dot(to) / (1.0 + from.dot(to)) * (from + to);
    return carried - carried.dot(to) * to;  // only round-off is left along the normal
}

/// What the tangential spring of a contact went through in one step.
struct TangentialMotion {
    Vec3 displacement;  ///< of body j relative to body i at the contact, in the tangent plane [m]
    Vec3 turned_shear;  ///< the old shear force, turned with the contact frame [N]
};

/// Sphere on sphere. The frame of the contact turns with the spheres: with the mean of the spins
/// weighted by the radii across the normal, their plain mean about it. What the normal turns
/// beyond that is slip: u = (r_i + r_j)(n - R n0). A pair that turns as a rigid body has exactly
/// u = 0 for any angle of the step (objectivity); the radii, not the distances from the centres
/// to the contact, are the lever arms, so that no cycle of pushing and rolling leaves a force
/// behind (McNamara et al. 2008).
///   normal0, normal  unit normals from i to j before and after the step [-]
///   spin_i, spin_j   angular velocities during the step [rad/s]
///   shear            shear force on i before the step, tangent at normal0 [N]
inline TangentialMotion sphere_motion(const Vec3& normal0, const Vec3& normal, double radius_i,
                                      double radius_j, const Vec3& spin_i, const Vec3& spin_j,
                                      const Vec3& shear, double step) {
    const double reach = radius_i + radius_j;
    const Vec3 rolling = (radius_i * spin_i + radius_j * spin_j) / reach;
    // The twist is about the mean of both normals: a step undone leaves nothing behind, exactly.
    const Vec3 middle = normal0 + normal;
    const double twist = (0.5 * (spin_i + spin_j) - rolling).dot(middle) / middle.squaredNorm();
    const Rotation frame(step * (rolling + twist * middle));
    const Vec3 material = frame * normal0;  // the normal as the spheres' spins carry it
    Vec3 u = reach * (normal - material);
    u -= u.dot(normal) * normal;
    return {u, swing(frame * shear, material, normal)};
}

/// Sphere on plane. The plane's normal is fixed; the frame twists by half the sphere's spin about
/// it, the plane itself does not turn.
///   outward  unit vector from the sphere to the plane [-]
///   velocity of the plane relative to the sphere's centre [m/s]
inline TangentialMotion plane_motion(const Vec3& outward, double radius, const Vec3& velocity,
                                     const Vec3& spin, const Vec3& shear, double step) {
    Vec3 u = step * (velocity - radius * spin.cross(outward));
    u -= u.dot(outward) * outward;
    const Rotation frame(0.5 * step * spin.dot(outward) * outward);
    Vec3 turned = frame * shear;
    turned -= turned.dot(outward) * outward;
    return {u, turned};
}

/// Eq. (6) of Tran et al.: cuts a shear force back to the Coulomb limit [N].
inline Vec3 coulomb_limited(const Vec3& shear, double limit) {
    const double square = shear.squaredNorm();
    return square > limit * limit ? Vec3(limit / std::sqrt(square) * shear) : shear;
}

}  // namespace grainfield::kernels
