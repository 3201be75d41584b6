// Moves spheres by one step: gravity, local damping, leapfrog; and the checks whether the lists
// still hold and the motion is sane.

#if defined(GRAINFIELD_MOVE_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_MOVE_KERNEL_INL
#undef GRAINFIELD_MOVE_KERNEL_INL
#else
#define GRAINFIELD_MOVE_KERNEL_INL
#endif

#include "kernels/vector/lanes-inl.hpp"
#include "kernels/vector/vector_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// Local damping and the kick of one degree of freedom a lane.
template <class T, bool Damping>
struct Kick {
    Lane<T> inverse_mass, mean_step, old_step, half_old, inverse_half, alpha;
    bool first;  ///< no step has been made: a body at rest starts along the load

    HWY_INLINE Kick(Lane<T> inverse_mass_, Lane<T> alpha_, const MoveParameters<T>& p)
        : inverse_mass(inverse_mass_),
          mean_step(set<T>(T(0.5) * (p.old_step + p.new_step))),
          old_step(set<T>(p.old_step)),
          alpha(alpha_),
          first(p.old_step == T(0)) {
        if constexpr (Damping) {
            half_old = hn::Mul(set<T>(T(0.5) * p.old_step), inverse_mass);
            // Padding has no mass.
            const auto safe =
                hn::IfThenElse(hn::Gt(half_old, hn::Zero(Tag<T>())), half_old, set<T>(1));
            inverse_half = hn::Div(set<T>(1), safe);
        }
    }
    /// alpha |F| sign(v) (damping.hpp): with s = clamp(v*/limit) and limit = alpha |F| h_old/2m,
    /// alpha |F| s = clamp(v* 2m/h_old, -alpha |F|, alpha |F|).
    HWY_INLINE Lane<T> damping(Lane<T> load, Lane<T> velocity) const {
        const auto taken = hn::Mul(alpha, hn::Abs(load));
        if (first) {
            const auto still = hn::Eq(velocity, hn::Zero(Tag<T>()));
            return hn::CopySign(taken, hn::IfThenElse(still, load, velocity));
        }
        const auto held = hn::Mul(hn::MulAdd(half_old, load, velocity), inverse_half);
        return hn::Max(hn::Neg(taken), hn::Min(taken, held));
    }
    HWY_INLINE Lane<T> apply(Lane<T> load, Lane<T> velocity, Lane<T>& damped) const {
        if constexpr (Damping) {
            damped = damping(load, velocity);
            load = hn::Sub(load, damped);
        }
        return hn::MulAdd(mean_step, hn::Mul(load, inverse_mass), velocity);
    }
};

template <class T, bool Gravity, bool Damping, bool Rotation, bool Ledger>
MoveResult move_records(SphereRecord<T>* records, const SphereLoad<T>* loads,
                        const BuiltPlace<T>* built, const MoveParameters<T>& p, std::size_t count) {
    constexpr std::size_t n = lanes<T>;
    const Tag<T> d;
    MoveResult result;
    const auto zero = hn::Zero(d);
    const auto step = set<T>(p.new_step), old_step = set<T>(p.old_step);
    const Lane3<T> gravity = set3<T>(p.gravity);
    const Lane3<T> shift = set3<T>(p.affine_shift), scale = set3<T>(p.affine_scale);
    auto used = zero;
    [[maybe_unused]] auto twice_work = zero;
    auto sane = hn::Eq(zero, zero);
    for (std::size_t k = 0; k < count; k += n) {
        std::array<const T*, n> at, load_at, place_at;
        std::array<T*, n> to;
        for (std::size_t l = 0; l < n; ++l) {
            at[l] = to[l] = records[k + l].u;
            load_at[l] = loads[k + l].force;
            place_at[l] = built[k + l].x;
        }
        Lane4<T> u = load4<T>(at, 0), v = load4<T>(at, 4), mass = load4<T>(at, 12);
        Lane3<T> force = load4<T>(load_at, 0).xyz();
        if constexpr (Gravity) force = plus_scaled(force, mass.z, gravity);
        Lane3<T> damped{zero, zero, zero};
        const Kick<T, Damping> kick(mass.x, set<T>(p.force_damping), p);
        const auto step_work = [&](Lane<T> taken, Lane<T> before, Lane<T> after) HWY_ATTR {
            // Half a step of the old velocity and half a step of the new.
            const auto way = hn::MulAdd(old_step, before, hn::Mul(step, after));
            twice_work = hn::MulAdd(taken, way, twice_work);
        };
        const Lane3<T> v0 = v.xyz();
        v.x = kick.apply(force.x, v.x, damped.x);
        v.y = kick.apply(force.y, v.y, damped.y);
        v.z = kick.apply(force.z, v.z, damped.z);
        if constexpr (Damping && Ledger) {
            step_work(damped.x, v0.x, v.x);
            step_work(damped.y, v0.y, v.y);
            step_work(damped.z, v0.z, v.z);
        }
        u.x = hn::MulAdd(step, v.x, u.x);
        u.y = hn::MulAdd(step, v.y, u.y);
        u.z = hn::MulAdd(step, v.z, u.z);
        store4<T>(u, to, 0);
        store4<T>(v, to, 4);
        if constexpr (Rotation) {
            Lane4<T> w = load4<T>(at, 8);
            const Lane3<T> w0 = w.xyz(), moment = load4<T>(load_at, 4).xyz();
            const Kick<T, Damping> spin(mass.y, set<T>(p.moment_damping), p);
            w.x = spin.apply(moment.x, w.x, damped.x);
            w.y = spin.apply(moment.y, w.y, damped.y);
            w.z = spin.apply(moment.z, w.z, damped.z);
            store4<T>(w, to, 8);
            if constexpr (Damping && Ledger) {
                step_work(damped.x, w0.x, w.x);
                step_work(damped.y, w0.y, w.y);
                step_work(damped.z, w0.z, w.z);
            }
        }
        // A step of less than half a radius; false for what is not a number.
        const auto way2 = hn::Mul(hn::Mul(step, step), dot(v.xyz(), v.xyz()));
        const auto half = hn::Mul(set<T>(T(0.5)), u.w);
        sane = hn::And(sane, hn::Le(way2, hn::Mul(half, half)));
        const Lane4<T> place = load4<T>(place_at, 0);
        const Lane3<T> affine{hn::MulAdd(scale.x, place.x, shift.x),
                              hn::MulAdd(scale.y, place.y, shift.y),
                              hn::MulAdd(scale.z, place.z, shift.z)};
        const Lane3<T> beyond = u.xyz() - affine;
        used = hn::Max(used, hn::Mul(dot(beyond, beyond), hn::Mul(place.w, place.w)));
    }
    if constexpr (Damping && Ledger) result.damping_work = 0.5 * sum_lanes<T>(twice_work);
    alignas(64) T lane[n];
    hn::Store(used, d, lane);
    for (T value : lane)
        if (double{value} > result.used_reserve2) result.used_reserve2 = value;
    result.too_far = !hn::AllTrue(d, sane);
    return result;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
