// Forces of candidate pairs of spheres. Lanes spent on pairs that do not touch cost as much as
// contacts: of the candidates that are not close, those that touch are picked out first.

#if defined(GRAINFIELD_PAIR_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_PAIR_KERNEL_INL
#undef GRAINFIELD_PAIR_KERNEL_INL
#else
#define GRAINFIELD_PAIR_KERNEL_INL
#endif

#include "kernels/vector/law-inl.hpp"
#include "kernels/vector/vector_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// How much a pair has come closer or apart: |b|^2 - |b0|^2 of the branch b since the lists were
/// built.
template <class T>
HWY_INLINE Lane<T> growth2(Lane3<T> built, Lane3<T> moved) {
    return dot(moved, plus_scaled(moved, set<T>(2), built));
}

/// What all batches of a call share.
template <class T>
struct PairCall {
    const SphereRecord<T>* records;
    const Candidates<T>& candidates;
    SphereLoad<T>* loads;
    const PairParameters<T>& parameters;
};

/// The contact law for lanes<T> candidates; those that do not touch get a force of zero and lose
/// their history. Returns a bit for every lane that touches.
///   a, b        records
///   separation  when the lists were built
///   history     shear before; afterwards the new one
template <class T, bool Friction, bool PerSphere, bool Sums>
HWY_INLINE std::uint32_t pair_batch(const PairCall<T>& call, const std::int32_t* a,
                                    const std::int32_t* b, Lane4<T> separation, Lane3<T>& history,
                                    LaneMask<T>& too_deep, ContactSums& sums) {
    const Tag<T> d;
    const auto half = set<T>(T(0.5)), one = set<T>(1), zero = hn::Zero(d);
    const PairParameters<T>& p = call.parameters;
    const RecordLanes<T> ra = load_records<T>(call.records, a);
    const RecordLanes<T> rb = load_records<T>(call.records, b);
    const Lane3<T> built = separation.xyz();
    const Lane3<T> moved = rb.u.xyz() - ra.u.xyz();
    PairLanes<T> pair;
    pair.branch = built + moved;
    pair.reach = hn::Add(ra.u.w, rb.u.w);
    pair.distance = hn::Sqrt(dot(pair.branch, pair.branch));
    const auto both = hn::Add(pair.distance, hn::Sub(pair.reach, separation.w));
    // One division for three reciprocals.
    const auto inverse = hn::Div(one, hn::Mul(hn::Mul(pair.distance, both), pair.reach));
    pair.inverse_distance = hn::Mul(inverse, hn::Mul(both, pair.reach));
    pair.inverse_reach = hn::Mul(inverse, hn::Mul(both, pair.distance));
    const auto inverse_both = hn::Mul(inverse, hn::Mul(pair.distance, pair.reach));
    // |b| - |b0| = (|b|^2 - |b0|^2)/(|b| + |b0|)
    const auto depth = hn::NegMulAdd(growth2<T>(built, moved), inverse_both, separation.w);
    const auto touching = hn::Gt(depth, zero);
    pair.overlap = hn::Max(zero, depth);
    pair.normal = scaled(pair.inverse_distance, pair.branch);
    too_deep = hn::Or(too_deep, hn::Gt(depth, hn::Mul(half, hn::Min(ra.u.w, rb.u.w))));

    // Eq. (4) with r the mean radius, Eq. (3a).
    const auto mean_radius = hn::Mul(half, pair.reach);
    Lane<T> kn;
    if constexpr (PerSphere)
        kn = contact_stiffness<T>(mean_radius, ra.w.w, rb.w.w);
    else
        kn = hn::Mul(mean_radius, set<T>(T(0.5) * p.uniform_stiffness));
    const auto fn = hn::Mul(kn, pair.overlap);
    Lane3<T> force = scaled(hn::Neg(fn), pair.normal);
    [[maybe_unused]] Lane<T> mine;
    if constexpr (Sums) {
        alignas(64) T counted[lanes<T>];
        for (std::size_t l = 0; l < lanes<T>; ++l) counted[l] = a[l] < p.counted ? T(1) : T(0);
        mine = hn::Load(d, counted);
    }
    if constexpr (Friction) {
        const Approach<T> approach =
            sphere_motion<T>(pair, ra.u.w, rb.u.w, rb.v.xyz() - ra.v.xyz(), ra.w.xyz(),
                             rb.w.xyz(), history, set<T>(p.step));
        Lane<T> friction;
        if constexpr (PerSphere)
            friction = hn::Min(ra.v.w, rb.v.w);
        else
            friction = set<T>(p.uniform_friction);
        const ShearLanes<T> spring =
            load_shear<T, Sums>(approach.motion, approach.gap_before, pair.overlap,
                                hn::Mul(set<T>(p.stiffness_ratio), kn), hn::Mul(friction, fn));
        history = spring.shear;
        // The force on the centres does the work of the spring, whose lever arms are the radii.
        force = plus_scaled(force, hn::Mul(pair.reach, pair.inverse_distance), spring.shear);
        const Lane3<T> moment = cross(pair.normal, spring.shear);
        add_loads<T>(call.loads, a, force, scaled(ra.u.w, moment));
        add_loads<T>(call.loads, b, scaled(set<T>(-1), force), scaled(rb.u.w, moment));
        if constexpr (Sums) {
            sums.elastic_shear += sum_lanes<T>(hn::Mul(mine, spring.elastic));
            sums.friction_work += sum_lanes<T>(hn::Mul(mine, spring.slipped));
        }
    } else {
        const Lane3<T> none{zero, zero, zero};
        history = none;
        add_loads<T>(call.loads, a, force, none);
        add_loads<T>(call.loads, b, scaled(set<T>(-1), force), none);
    }
    if constexpr (Sums) {
        sums.normal_force += sum_lanes<T>(hn::Mul(mine, fn));
        sums.elastic_normal += sum_lanes<T>(hn::Mul(hn::Mul(mine, half), hn::Mul(fn, pair.overlap)));
        sums.contacts +=
            static_cast<std::int64_t>(sum_lanes<T>(hn::IfThenElseZero(touching, mine)));
    }
    return bits_of<T>(touching);
}

/// Candidates that are close: one batch after the other, history in place.
template <class T, bool Friction, bool PerSphere, bool Sums>
HWY_INLINE void close_forces(const PairCall<T>& call, LaneMask<T>& too_deep, PassResult& result) {
    const Candidates<T>& c = call.candidates;
    for (std::size_t word = 0; word < c.close / most_lanes; ++word) {
        std::uint32_t touching = 0;
        for (std::size_t part = 0; part < most_lanes; part += lanes<T>) {
            const std::size_t k = word * most_lanes + part;
            T* history = c.history[k].shear;
            Lane3<T> shear{};
            if constexpr (Friction) shear = load_rows<T>(history).xyz();
            touching |= pair_batch<T, Friction, PerSphere, Sums>(
                            call, c.a + k, c.b + k, load_rows<T>(c.separation[k].x), shear,
                            too_deep, result.sums)
                        << part;
            if constexpr (Friction)
                store_rows<T>({shear.x, shear.y, shear.z, hn::Zero(Tag<T>())}, history);
        }
        c.touching[word] = static_cast<std::uint16_t>(touching);
        result.contacts += __builtin_popcount(touching);
    }
}

/// Lists in c.scratch the candidates beyond the close ones that touch or did so at the last force
/// evaluation; returns how many they are.
template <class T>
HWY_INLINE std::size_t find_touching(const PairCall<T>& call) {
    constexpr std::size_t n = lanes<T>;
    const Candidates<T>& c = call.candidates;
    std::size_t found = 0;
    for (std::size_t word = c.close / most_lanes; word < c.size / most_lanes; ++word) {
        std::uint32_t now = 0;
        for (std::size_t part = 0; part < most_lanes; part += n) {
            const std::size_t k = word * most_lanes + part;
            const Lane4<T> ua = load_places<T>(call.records, c.a + k);
            const Lane4<T> ub = load_places<T>(call.records, c.b + k);
            const Lane4<T> built = load_rows<T>(c.separation[k].x);
            const auto reach = hn::Add(ua.w, ub.w);
            // Touching: |b| < reach, with |b0| = reach - gap.
            const auto room = hn::Mul(built.w, hn::Sub(hn::Add(reach, reach), built.w));
            now |= bits_of<T>(hn::Lt(growth2<T>(built.xyz(), ub.xyz() - ua.xyz()), room)) << part;
        }
        for (std::uint32_t left = now | c.touching[word]; left != 0; left &= left - 1)
            c.scratch[found++] =
                static_cast<std::int32_t>(word * most_lanes) + __builtin_ctz(left);
        c.touching[word] = static_cast<std::uint16_t>(now);
    }
    return found;
}

/// The candidates picked out by find_touching().
template <class T, bool Friction, bool PerSphere, bool Sums>
HWY_INLINE void picked_forces(const PairCall<T>& call, LaneMask<T>& too_deep, PassResult& result) {
    constexpr std::size_t n = lanes<T>;
    const Candidates<T>& c = call.candidates;
    const std::size_t picked = find_touching<T>(call);
    result.contacts += static_cast<std::int64_t>(picked);
    for (std::size_t l = 0; l < n; ++l)
        c.scratch[picked + l] = static_cast<std::int32_t>(c.idle);
    for (std::size_t k = 0; k < picked; k += n) {
        std::array<std::int32_t, n> a, b;
        std::array<const T*, n> separation, history;
        std::array<T*, n> history_to;
        for (std::size_t l = 0; l < n; ++l) {
            const auto at = static_cast<std::size_t>(c.scratch[k + l]);
            a[l] = c.a[at];
            b[l] = c.b[at];
            separation[l] = c.separation[at].x;
            history[l] = history_to[l] = c.history[at].shear;
        }
        Lane3<T> shear{};
        if constexpr (Friction) shear = load4<T>(history, 0).xyz();
        pair_batch<T, Friction, PerSphere, Sums>(call, a.data(), b.data(),
                                                 load4<T>(separation, 0), shear, too_deep,
                                                 result.sums);
        if constexpr (Friction)
            store4<T>({shear.x, shear.y, shear.z, hn::Zero(Tag<T>())}, history_to, 0);
    }
}

template <class T, bool Friction, bool PerSphere, bool Sums>
PassResult pair_forces(const SphereRecord<T>* records, Candidates<T> c, SphereLoad<T>* loads,
                       const PairParameters<T>& p) {
    const Tag<T> d;
    PassResult result;
    const PairCall<T> call{records, c, loads, p};
    auto too_deep = hn::Lt(hn::Zero(d), hn::Zero(d));
    close_forces<T, Friction, PerSphere, Sums>(call, too_deep, result);
    picked_forces<T, Friction, PerSphere, Sums>(call, too_deep, result);
    result.too_deep = !hn::AllFalse(d, too_deep);
    return result;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
