// The reference contact kernels: scalar, double precision, written to be read.

#include <cmath>

#include "kernels/contact_kernels.hpp"
#include "kernels/contact_law.hpp"

namespace grainfield::kernels {
namespace {

Vec3 at(const double* x, const double* y, const double* z, std::int32_t i) {
    return {x[i], y[i], z[i]};
}

/// Share of the step during which a contact that formed in it was closed: it opened `before`
/// (gap > 0) and closed with overlap `now` > 0.
double closed_share(double gap_before, double overlap_now) {
    return gap_before > 0.0 ? overlap_now / (overlap_now + gap_before) : 1.0;
}

/// Loads the tangential spring: the turned force plus K_s u, cut back to the limit. Returns the
/// new shear force; the work of slip is the mean force times the slip (trapezoidal rule, which
/// closes the energy ledger exactly in the linear regime).
template <bool Sums>
Vec3 load_shear(const TangentialMotion& motion, double share, double shear_stiffness, double limit,
                ContactSums& sums) {
    const Vec3 trial = motion.turned_shear + shear_stiffness * share * motion.displacement;
    const Vec3 shear = coulomb_limited(trial, limit);
    if constexpr (Sums) {
        if (shear_stiffness > 0.0) {
            sums.elastic_shear += 0.5 * shear.squaredNorm() / shear_stiffness;
            sums.friction_work +=
                0.5 * (motion.turned_shear + shear).dot(trial - shear) / shear_stiffness;
        }
    }
    return shear;
}

/// A contact that opened: its shear force is gone, and the energy in its spring with it.
template <bool Friction>
void open_contact(ContactColumns contacts, std::size_t c) {
    contacts.touching[c] = 0;
    if constexpr (Friction) contacts.shear[c].setZero();
}

template <bool Friction, bool PerSphere, bool Sums>
ContactSums pair_forces(const SphereColumns& s, const Pair* pairs, ContactColumns contacts,
                        const ContactParameters& p, std::size_t begin, std::size_t end) {
    ContactSums sums;
    for (std::size_t c = begin; c < end; ++c) {
        const auto [i, j] = pairs[c];
        const double reach = s.radius[i] + s.radius[j];
        const Vec3 branch = at(s.x, s.y, s.z, j) - at(s.x, s.y, s.z, i);
        const double distance2 = branch.squaredNorm();
        if (distance2 >= reach * reach) {
            if (contacts.touching[c]) {
                if constexpr (Sums && Friction) {
                    const double k =
                        p.stiffness_ratio *
                        contact_stiffness(0.5 * reach,
                                          PerSphere ? s.normal_stiffness[i] : p.uniform_stiffness,
                                          PerSphere ? s.normal_stiffness[j] : p.uniform_stiffness);
                    sums.friction_work += 0.5 * contacts.shear[c].squaredNorm() / k;
                }
                open_contact<Friction>(contacts, c);
            }
            continue;
        }
        const double distance = std::sqrt(distance2);
        const Vec3 normal = branch / distance;
        const double overlap = reach - distance;
        // Eqs. (4) and (5) of Tran et al., r the mean radius.
        const double kn =
            contact_stiffness(0.5 * reach, PerSphere ? s.normal_stiffness[i] : p.uniform_stiffness,
                              PerSphere ? s.normal_stiffness[j] : p.uniform_stiffness);
        const double fn = kn * overlap;  // Eq. (3a) of Tran et al.
        Vec3 force = -fn * normal;
        if constexpr (Friction) {
            const Vec3 velocity = at(s.vx, s.vy, s.vz, j) - at(s.vx, s.vy, s.vz, i);
            const Vec3 branch0 = branch - p.step * velocity;  // at the last force evaluation
            const double distance0 = branch0.norm();
            const TangentialMotion motion = sphere_motion(
                branch0 / distance0, normal, s.radius[i], s.radius[j], at(s.wx, s.wy, s.wz, i),
                at(s.wx, s.wy, s.wz, j), contacts.shear[c], p.step);
            const double friction =
                PerSphere ? std::min(s.friction[i], s.friction[j]) : p.uniform_friction;
            const double share =
                contacts.touching[c] ? 1.0 : closed_share(distance0 - reach, overlap);
            const Vec3 shear =
                load_shear<Sums>(motion, share, p.stiffness_ratio * kn, friction * fn, sums);
            contacts.shear[c] = shear;
            // The spring's displacement has lever arms r_i + r_j; the force on the centres that
            // does the same work over the same motion is larger by (r_i + r_j)/distance. Angular
            // momentum and energy are both kept.
            force += reach / distance * shear;
            contacts.moment_per_radius[c] = normal.cross(shear);
        }
        contacts.touching[c] = 1;
        contacts.force[c] = force;
        if constexpr (Sums) {
            sums.normal_force += fn;
            sums.elastic_normal += 0.5 * kn * overlap * overlap;
            ++sums.contacts;
        }
    }
    return sums;
}

template <bool Friction, bool PerSphere, bool Sums>
ContactSums wall_forces(const SphereColumns& s, const PlaneWall* walls, const WallPair* pairs,
                        ContactColumns contacts, const ContactParameters& p, WallLoad* loads,
                        std::size_t begin, std::size_t end) {
    ContactSums sums;
    for (std::size_t c = begin; c < end; ++c) {
        const auto [w, i] = pairs[c];
        const PlaneWall& wall = walls[w];
        const double overlap = s.radius[i] - wall.normal.dot(at(s.x, s.y, s.z, i) - wall.point);
        const double k = PerSphere ? s.normal_stiffness[i] : p.uniform_stiffness;
        // The wall counts as a body with its own k; r is the sphere's radius. K_s by
        // Eq. (4b) of Tran et al., from k_s = (k_s/k_n) k_n of each body.
        const double ks_sphere = p.stiffness_ratio * k;
        const double ks_wall = wall.stiffness_ratio * wall.normal_stiffness;
        const double ks = ks_sphere > 0.0 && ks_wall > 0.0
                              ? contact_stiffness(s.radius[i], ks_sphere, ks_wall)
                              : 0.0;
        if (overlap <= 0.0) {
            if (contacts.touching[c]) {
                if constexpr (Sums && Friction)
                    if (ks > 0.0) sums.friction_work += 0.5 * contacts.shear[c].squaredNorm() / ks;
                open_contact<Friction>(contacts, c);
            }
            continue;
        }
        const double kn = contact_stiffness(s.radius[i], k, wall.normal_stiffness);
        const double fn = kn * overlap;
        Vec3 force = fn * wall.normal;
        if constexpr (Friction) {
            const Vec3 outward = -wall.normal;
            const Vec3 velocity = wall.velocity - at(s.vx, s.vy, s.vz, i);
            const TangentialMotion motion = plane_motion(
                outward, s.radius[i], velocity, at(s.wx, s.wy, s.wz, i), contacts.shear[c], p.step);
            const double friction =
                std::min(PerSphere ? s.friction[i] : p.uniform_friction, wall.friction);
            const double gap0 = p.step * velocity.dot(wall.normal) - overlap;
            const double share = contacts.touching[c] ? 1.0 : closed_share(gap0, overlap);
            const Vec3 shear = load_shear<Sums>(motion, share, ks, friction * fn, sums);
            contacts.shear[c] = shear;
            force += shear;
            contacts.moment_per_radius[c] = outward.cross(shear);
        }
        contacts.touching[c] = 1;
        contacts.force[c] = force;
        loads[w].force -= force;
        loads[w].stiffness += kn;
        ++loads[w].contacts;
        if constexpr (Sums) {
            sums.normal_force += fn;
            sums.elastic_normal += 0.5 * kn * overlap * overlap;
            ++sums.contacts;
        }
    }
    return sums;
}

template <bool Friction, bool PerSphere>
PairKernel pick_pairs(bool sums) {
    return sums ? pair_forces<Friction, PerSphere, true> : pair_forces<Friction, PerSphere, false>;
}
template <bool Friction, bool PerSphere>
WallKernel pick_walls(bool sums) {
    return sums ? wall_forces<Friction, PerSphere, true> : wall_forces<Friction, PerSphere, false>;
}

PairKernel choose_pairs(ContactFeatures f) {
    if (f.friction)
        return f.per_sphere ? pick_pairs<true, true>(f.sums) : pick_pairs<true, false>(f.sums);
    return f.per_sphere ? pick_pairs<false, true>(f.sums) : pick_pairs<false, false>(f.sums);
}
WallKernel choose_walls(ContactFeatures f) {
    if (f.friction)
        return f.per_sphere ? pick_walls<true, true>(f.sums) : pick_walls<true, false>(f.sums);
    return f.per_sphere ? pick_walls<false, true>(f.sums) : pick_walls<false, false>(f.sums);
}

constexpr ReferenceKernels kernels{choose_pairs, choose_walls};
constexpr KernelTable table{"scalar", "double", &kernels, nullptr, nullptr};

}  // namespace

const KernelTable& reference_kernels() {
    return table;
}

}  // namespace grainfield::kernels
