// Moves spheres by one step: gravity, local damping, leapfrog; and the checks whether the lists
// still hold and the motion is sane.

#if defined(GRAINFIELD_MOVE_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_MOVE_KERNEL_INL
#undef GRAINFIELD_MOVE_KERNEL_INL
#else
#define GRAINFIELD_MOVE_KERNEL_INL
#endif

#include "kernels/vector/record_lanes-inl.hpp"
#include "kernels/vector/vector_kernels.hpp"
#include "kernels/vector/wide_sum-inl.hpp"

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

/// A padded column of BodyColumns from sphere k on.
template <class T>
HWY_INLINE Lane<T> of_bodies(const T* column, std::size_t k) {
    return hn::Load(Tag<T>(), column + k);
}

/// Numbers that follow each other in memory less `origin`, rounded to T after that.
template <class T>
HWY_INLINE Lane<T> load_relative(const double* at, double origin) {
#if HWY_TARGET == HWY_SCALAR
    return set<T>(static_cast<T>(*at - origin));
#else
    const Tag<T> d;
    if constexpr (sizeof(T) == 8) {
        return hn::Sub(hn::LoadU(d, at), set<T>(origin));
    } else {
        const hn::Half<Tag<T> > half;
        const hn::Rebind<double, decltype(half)> wide;
        const auto from = hn::Set(wide, origin);
        const auto low = hn::Sub(hn::LoadU(wide, at), from);
        const auto high = hn::Sub(hn::LoadU(wide, at + lanes<T> / 2), from);
        return hn::Combine(d, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
    }
#endif
}

/// Centres of spheres k, k + 1, ... when the lists were built, from the middle of the sample.
template <class T>
HWY_INLINE Lane3<T> built_places(const BodyColumns<T>& bodies, const double (&middle)[3],
                                 std::size_t k) {
    constexpr std::size_t n = lanes<T>;
    constexpr std::size_t ahead = 128;  // spheres to ask for early
    for (const double* column : {bodies.x, bodies.y, bodies.z})
        for (std::size_t l = 0; l < n; l += 8) __builtin_prefetch(column + k + ahead + l);
    if (k + n <= bodies.own)
        return {load_relative<T>(bodies.x + k, middle[0]),
                load_relative<T>(bodies.y + k, middle[1]),
                load_relative<T>(bodies.z + k, middle[2])};
    double place[3][n] = {};
    for (std::size_t l = 0; k + l < bodies.own; ++l) {
        place[0][l] = bodies.x[k + l];
        place[1][l] = bodies.y[k + l];
        place[2][l] = bodies.z[k + l];
    }
    return {load_relative<T>(place[0], middle[0]), load_relative<T>(place[1], middle[1]),
            load_relative<T>(place[2], middle[2])};
}

template <class T, bool Gravity, bool Damping, bool Rotation, bool Ledger>
MoveResult move_records(SphereRecord<T>* records, const SphereLoad<T>* loads,
                        const BodyColumns<T>& bodies, const MoveParameters<T>& p,
                        std::size_t count) {
    constexpr std::size_t n = lanes<T>;
    const Tag<T> d;
    MoveResult result;
    const auto zero = hn::Zero(d);
    const auto step = set<T>(p.new_step), old_step = set<T>(p.old_step);
    const Lane3<T> gravity = set3<T>(p.gravity);
    const Lane3<T> shift = set3<T>(p.affine_shift), scale = set3<T>(p.affine_scale);
    auto used = zero;
    [[maybe_unused]] WideSum<T> twice_work;
    auto sane = hn::Eq(zero, zero);
    for (std::size_t k = 0; k < count; k += n) {
        std::array<Lane<T>, 16> record = load_columns<T>(records + k);
        const std::array<Lane<T>, 16> load = load_columns<T>(loads + k);
        Lane3<T> u{record[0], record[1], record[2]}, v{record[4], record[5], record[6]};
        const Lane<T> radius = record[3];
        Lane3<T> force{load[0], load[1], load[2]};
        if constexpr (Gravity) force = plus_scaled(force, of_bodies(bodies.mass, k), gravity);
        Lane3<T> damped{zero, zero, zero};
        const Kick<T, Damping> kick(of_bodies(bodies.inverse_mass, k), set<T>(p.force_damping), p);
        const auto step_work = [&](Lane<T> taken, Lane<T> before, Lane<T> after) HWY_ATTR {
            // Half a step of the old velocity and half a step of the new.
            const auto way = hn::MulAdd(old_step, before, hn::Mul(step, after));
            twice_work.add_product(slot_of<T>(k), taken, way);
        };
        const Lane3<T> v0 = v;
        v.x = kick.apply(force.x, v.x, damped.x);
        v.y = kick.apply(force.y, v.y, damped.y);
        v.z = kick.apply(force.z, v.z, damped.z);
        if constexpr (Damping && Ledger) {
            step_work(damped.x, v0.x, v.x);
            step_work(damped.y, v0.y, v.y);
            step_work(damped.z, v0.z, v.z);
        }
        u = plus_scaled(u, step, v);
        record[0] = u.x;
        record[1] = u.y;
        record[2] = u.z;
        record[4] = v.x;
        record[5] = v.y;
        record[6] = v.z;
        if constexpr (Rotation) {
            Lane3<T> w{record[8], record[9], record[10]};
            const Lane3<T> w0{record[12], record[13], record[14]};  // times the radius
            // Moments over the radius and what a spin makes of them: the same motion.
            const Kick<T, Damping> spin(of_bodies(bodies.spin_response, k),
                                        set<T>(p.moment_damping), p);
            w.x = spin.apply(load[4], w.x, damped.x);
            w.y = spin.apply(load[5], w.y, damped.y);
            w.z = spin.apply(load[6], w.z, damped.z);
            record[8] = w.x;
            record[9] = w.y;
            record[10] = w.z;
            record[12] = hn::Mul(radius, w.x);
            record[13] = hn::Mul(radius, w.y);
            record[14] = hn::Mul(radius, w.z);
            if constexpr (Damping && Ledger) {
                step_work(damped.x, w0.x, record[12]);
                step_work(damped.y, w0.y, record[13]);
                step_work(damped.z, w0.z, record[14]);
            }
        }
        store_columns<T>(record, records + k);
        // A step of less than half a radius; false for what is not a number.
        const auto way2 = hn::Mul(hn::Mul(step, step), dot(v, v));
        const auto half = hn::Mul(set<T>(T(0.5)), radius);
        sane = hn::And(sane, hn::Le(way2, hn::Mul(half, half)));
        const Lane3<T> place = built_places<T>(bodies, p.middle, k);
        const Lane3<T> affine{hn::MulAdd(scale.x, place.x, shift.x),
                              hn::MulAdd(scale.y, place.y, shift.y),
                              hn::MulAdd(scale.z, place.z, shift.z)};
        const Lane3<T> beyond = u - affine;
        const auto share = of_bodies(bodies.inverse_buffer, k);
        used = hn::Max(used, hn::Mul(dot(beyond, beyond), hn::Mul(share, share)));
    }
    if constexpr (Damping && Ledger) result.damping_work = 0.5 * twice_work.total();
    alignas(64) T lane[n];
    hn::Store(used, d, lane);
    for (T value : lane)
        if (double{value} > result.used_buffer2) result.used_buffer2 = value;
    result.too_far = !hn::AllTrue(d, sane);
    return result;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
