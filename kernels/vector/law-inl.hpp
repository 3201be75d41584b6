// The contact law (contact_law.hpp) over lanes. The same equations, written so that no difference
// of nearly equal numbers is formed: what float loses is round-off of the result alone.

#if defined(GRAINFIELD_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_LAW_INL
#undef GRAINFIELD_LAW_INL
#else
#define GRAINFIELD_LAW_INL
#endif

#include "kernels/contact_kernels.hpp"
#include "kernels/vector/wide_sum-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// 1/(1 - x). In float by its series: every x here is the square of an angle or a strain of one
/// step, below 1e-2, and the next term below 1e-8.
template <class T>
HWY_INLINE Lane<T> inverse_of_one_minus(Lane<T> x) {
    const auto one = set<T>(1);
    if constexpr (sizeof(T) == 8) return hn::Div(one, hn::Sub(one, x));
    return hn::MulAdd(x, hn::MulAdd(x, hn::Add(one, x), one), one);
}

/// What a rotation by a finite angle adds to vectors: (R - I) v = f (t x v + t x (t x v)), t the
/// axis times tan(angle/2), f = 2/(1 + t.t) (Euler-Rodrigues).
template <class T>
struct Turn {
    Lane3<T> t;
    Lane<T> factor;

    /// From a rotation vector (axis times angle) below 0.1 rad, by the series of the tangent.
    HWY_INLINE explicit Turn(Lane3<T> rotation) {
        const auto a2 = dot(rotation, rotation);
        // tan(a/2)/a = 1/2 + a2/24 + a2^2/240 + 17 a2^3/40320 + 31 a2^4/725760 + ...
        auto series = set<T>(T(1.0 / 240.0));
        if constexpr (sizeof(T) == 8) {
            series = hn::MulAdd(a2, set<T>(691.0 / 159667200.0), set<T>(31.0 / 725760.0));
            series = hn::MulAdd(a2, series, set<T>(17.0 / 40320.0));
            series = hn::MulAdd(a2, series, set<T>(1.0 / 240.0));
        }
        series = hn::MulAdd(a2, series, set<T>(T(1.0 / 24.0)));
        series = hn::MulAdd(a2, series, set<T>(T(0.5)));
        t = scaled(series, rotation);
        factor = hn::Mul(set<T>(2), inverse_of_one_minus<T>(hn::Neg(dot(t, t))));
    }
    HWY_INLINE Lane3<T> added_to(Lane3<T> v) const {
        const Lane3<T> c = cross(t, v);
        return scaled(factor, c + cross(t, c));
    }
};

/// Carries a vector tangent at `from` to the tangent plane at `to` by the smallest rotation
/// between the two unit vectors.
template <class T>
HWY_INLINE Lane3<T> swing(Lane3<T> tangent, Lane3<T> from, Lane3<T> to) {
    const Lane3<T> difference = from - to;
    // 1 + from.to = 2 - |from - to|^2/2
    const auto inverse =
        hn::Mul(set<T>(T(0.5)),
                inverse_of_one_minus<T>(hn::Mul(set<T>(T(0.25)), dot(difference, difference))));
    const Lane3<T> carried = minus_scaled(tangent, hn::Mul(dot(tangent, to), inverse), from + to);
    return tangential(carried, to);
}

/// What the tangential spring of a contact went through in one step.
template <class T>
struct TangentialLanes {
    Lane3<T> displacement;  ///< of body b relative to a, in the tangent plane [m]
    Lane3<T> turned;        ///< the old shear force, turned with the contact frame [N]
};

/// A touching pair of spheres.
template <class T>
struct PairLanes {
    Lane3<T> branch;            ///< from a to b [m]
    Lane<T> distance, overlap;  ///< [m]
    Lane<T> reach;              ///< sum of the radii [m]
    Lane<T> inverse_distance, inverse_reach;
    Lane3<T> normal;
};

template <class T>
struct Approach {
    TangentialLanes<T> motion;
    Lane<T> gap_before;  ///< at the last force evaluation; negative if closed then [m]
};

/// The largest turn of a pair in one step for which SmallMotion is used [rad]. Its relative error
/// in what the step adds to the shear force grows with the turn. Across the normal it is less than
/// a tenth of the turn. Along the normal it is up to four times the turn, but the next step takes
/// that part away.
inline constexpr double small_turn = 3e-4;

/// sphere_motion() where a pair turns by small angles only, as it does in nearly every step.
template <class T>
struct SmallMotion {
    Approach<T> approach;
    LaneMask<T> too_large;  ///< touching pairs for which it is not good enough

    HWY_INLINE SmallMotion(const PairLanes<T>& pair, Lane3<T> velocity, Lane3<T> spins,
                           Lane3<T> rolled, Lane3<T> shear, Lane<T> step) {
        const auto half = set<T>(T(0.5));
        const Lane3<T> n = pair.normal;
        // With w = h v/|b|: n - n0 = P h v/|b0| and |b|/|b0| = 1 + w.n, up to the square of w.
        const Lane3<T> w = scaled(hn::Mul(step, pair.inverse_distance), velocity);
        const auto closing = dot(w, n);
        const Lane3<T> swung = scaled(hn::Add(set<T>(1), closing), minus_scaled(w, closing, n));
        // The frame rolls from n0 to n - u: (R - I) n0 = r x (n0 + n - u)/2, exact for a pair that
        // turns as a rigid body. u follows in two rounds.
        const Lane3<T> r = scaled(hn::Mul(step, pair.inverse_reach), rolled);
        const Lane3<T> first = swung - cross(r, minus_scaled(n, half, swung));
        const Lane3<T> u = plus_scaled(first, half, cross(r, first));
        approach.motion.displacement = scaled(pair.reach, u);
        // The shear force follows the normal by the smallest turn and spins about it.
        const Lane3<T> spun = scaled(hn::Mul(half, step), spins);
        const Lane3<T> carried = tangential(shear, n);
        approach.motion.turned = carried + cross(scaled(dot(spun, n), n), carried);
        approach.gap_before = hn::NegMulSub(closing, pair.distance, pair.overlap);
        const auto turn2 = hn::Max(dot(w, w), hn::Max(dot(r, r), dot(spun, spun)));
        too_large = hn::And(hn::Gt(turn2, set<T>(T(small_turn * small_turn))),
                            hn::Gt(pair.overlap, hn::Zero(Tag<T>())));
    }
};

/// sphere_motion() of the reference. With b0 = b - h v the branch of the last evaluation and P the
/// projection on the tangent plane, P(n - n0) = h P v/|b0|: no difference of normals is needed.
/// `spins` and `rolled` are the sums of both spheres' spins and of their radii times spins.
template <class T>
HWY_INLINE Approach<T> sphere_motion(const PairLanes<T>& pair, Lane3<T> velocity, Lane3<T> spins,
                                     Lane3<T> rolled, Lane3<T> shear, Lane<T> step) {
    const Lane3<T> n = pair.normal;
    const Lane3<T> moved = scaled(step, velocity);
    const Lane3<T> branch0 = pair.branch - moved;
    // |b|^2 - |b0|^2, relative to |b|^2.
    const auto change = hn::Mul(dot(moved, pair.branch + branch0),
                                hn::Mul(pair.inverse_distance, pair.inverse_distance));
    Lane<T> inverse_distance0, distance0;
    const auto one = set<T>(1);
    if constexpr (sizeof(T) == 8) {
        distance0 = hn::Sqrt(dot(branch0, branch0));
        inverse_distance0 = hn::Div(one, distance0);
    } else {
        // 1/sqrt(1 - c) = 1 + c/2 + 3c^2/8 + 5c^3/16; c is the strain of the branch in a step.
        auto series = hn::MulAdd(change, set<T>(T(0.3125)), set<T>(T(0.375)));
        series = hn::MulAdd(change, series, set<T>(T(0.5)));
        series = hn::MulAdd(change, series, one);
        inverse_distance0 = hn::Mul(pair.inverse_distance, series);
        distance0 = hn::Mul(dot(branch0, branch0), inverse_distance0);
    }
    // d - d0 = (d^2 - d0^2)/(d + d0), and d + d0 = 2 d up to the strain of a step.
    const auto closing = hn::Div(hn::Mul(change, hn::Mul(pair.distance, pair.distance)),
                                 hn::Add(pair.distance, distance0));
    Approach<T> result;
    result.gap_before = hn::Sub(hn::Neg(closing), pair.overlap);

    const Lane3<T> n0 = scaled(inverse_distance0, branch0);
    const Lane3<T> rolling = scaled(pair.inverse_reach, rolled);
    const Lane3<T> middle = n + n0, between = n - n0;
    // |n + n0|^2 = 4 - |n - n0|^2
    const auto inverse_middle2 = hn::Mul(
        set<T>(T(0.25)), inverse_of_one_minus<T>(hn::Mul(set<T>(T(0.25)), dot(between, between))));
    const Lane3<T> beyond = scaled(set<T>(T(0.5)), spins) - rolling;
    const auto twist = hn::Mul(dot(beyond, middle), inverse_middle2);
    const Turn<T> frame(scaled(step, plus_scaled(rolling, twist, middle)));
    const Lane3<T> turned_by = frame.added_to(n0);
    Lane3<T> u = scaled(inverse_distance0, moved) - turned_by;
    result.motion.displacement = scaled(pair.reach, tangential(u, n));
    result.motion.turned = swing(shear + frame.added_to(shear), n0 + turned_by, n);
    return result;
}

/// plane_motion() of the reference; `outward` from the sphere to the plane.
template <class T>
HWY_INLINE TangentialLanes<T> plane_motion(Lane3<T> outward, Lane<T> radius, Lane3<T> velocity,
                                           Lane3<T> spin, Lane3<T> shear, Lane<T> step) {
    const Lane3<T> u = scaled(step, minus_scaled(velocity, radius, cross(spin, outward)));
    const auto half = hn::Mul(hn::Mul(set<T>(T(0.5)), step), dot(spin, outward));
    const Turn<T> frame(scaled(half, outward));
    return {tangential(u, outward), tangential(shear + frame.added_to(shear), outward)};
}

/// Result of loading a tangential spring.
template <class T>
struct ShearLanes {
    Lane3<T> shear;            ///< cut back to the Coulomb limit, Eq. (6) of Tran et al. [N]
    Lane<T> elastic, slipped;  ///< energy in the spring; work of slip in the step [J]
};

/// load_shear() of the reference; `gap_before` sets the share of the step the contact was closed.
template <class T, bool Sums>
HWY_INLINE ShearLanes<T> load_shear(const TangentialLanes<T>& motion, Lane<T> gap_before,
                                    Lane<T> overlap, Lane<T> shear_stiffness, Lane<T> limit) {
    const Tag<T> d;
    const auto zero = hn::Zero(d);
    // Share of the step during which the contact was closed: all of it, unless it formed in it.
    const auto way = hn::Add(overlap, hn::Max(gap_before, zero));
    const auto share = hn::Div(overlap, hn::Max(way, set<T>(T(1e-30))));
    const auto stretched = hn::Mul(shear_stiffness, share);
    const Lane3<T> trial = plus_scaled(motion.turned, stretched, motion.displacement);
    const auto size = hn::Sqrt(hn::Max(dot(trial, trial), set<T>(T(1e-30))));
    ShearLanes<T> result;
    result.shear = scaled(hn::Min(set<T>(1), hn::Div(limit, size)), trial);
    if constexpr (Sums) {
        const auto sticks = hn::Gt(shear_stiffness, zero);
        const auto inverse =
            hn::Div(set<T>(T(0.5)), hn::IfThenElse(sticks, shear_stiffness, set<T>(1)));
        result.elastic =
            hn::IfThenElseZero(sticks, hn::Mul(inverse, dot(result.shear, result.shear)));
        result.slipped = hn::IfThenElseZero(
            sticks, hn::Mul(inverse, dot(motion.turned + result.shear, trial - result.shear)));
    } else {
        result.elastic = result.slipped = zero;
    }
    return result;
}

/// ContactSums a lane: a domain's contacts are added up in vectors, all else in double. `slot` is
/// that of WideSum.
template <class T>
struct LaneSums {
    WideSum<T> normal_force, elastic_normal, elastic_shear, friction_work;
    std::int64_t contacts = 0;

    HWY_INLINE LaneSums() {}  // one of the compiler's own would be for no target
    HWY_INLINE void add_normal(std::size_t slot, LaneMask<T> counted, Lane<T> force,
                               Lane<T> overlap) {
        const auto mine = hn::IfThenElseZero(counted, force);
        normal_force.add(slot, mine);
        elastic_normal.add_product(slot, mine, overlap);  // twice: total() halves it
    }
    HWY_INLINE void add_shear(std::size_t slot, LaneMask<T> counted, const ShearLanes<T>& spring) {
        elastic_shear.add(slot, hn::IfThenElseZero(counted, spring.elastic));
        friction_work.add(slot, hn::IfThenElseZero(counted, spring.slipped));
    }
    HWY_INLINE ContactSums total() const {
        ContactSums sums;
        sums.normal_force = normal_force.total();
        sums.elastic_normal = 0.5 * elastic_normal.total();
        sums.elastic_shear = elastic_shear.total();
        sums.friction_work = friction_work.total();
        sums.contacts = contacts;
        return sums;
    }
};

/// Eq. (4) of Tran et al.: K = r kA kB/(kA + kB) = r/(1/kA + 1/kB).
template <class T>
HWY_INLINE Lane<T> contact_stiffness(Lane<T> mean_radius, Lane<T> compliances) {
    return hn::Div(mean_radius, compliances);
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
