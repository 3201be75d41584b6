// Forces of candidate pairs of spheres. Lanes spent on pairs that do not touch cost as much as
// contacts: of the candidates that are not close, those that touch are picked out first.

#if defined(GRAINFIELD_PAIR_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_PAIR_KERNEL_INL
#undef GRAINFIELD_PAIR_KERNEL_INL
#else
#define GRAINFIELD_PAIR_KERNEL_INL
#endif

#include <algorithm>

#include "kernels/vector/law-inl.hpp"
#include "kernels/vector/vector_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// What all batches of a call share.
template <class T>
struct PairCall {
    const SphereRecord<T>* records;
    const Candidates<T>& candidates;
    SphereLoad<T>* loads;
    const PairParameters<T>& parameters;
};

/// Batches that go through the stages of the law together. The law is a long chain of operations
/// that wait for each other; a processor looks ahead further than one stage, but not further than
/// the whole chain, so that stage by stage it works on several batches at once.
inline constexpr std::size_t group = 4;

/// Candidates are read in order, but faster than the processor foresees: batches to ask for early.
inline constexpr std::size_t ahead = 3 * group;

/// Asks memory for one group's worth of rows of four from `row` on; may lie beyond the end.
template <class Row>
HWY_INLINE void fetch_ahead(const Row* row) {
    const char* at = reinterpret_cast<const char*>(row);
    constexpr std::size_t bytes = group * HWY_LANES(std::uint8_t) * 4;  // a vector a component
    for (std::size_t line = 0; line < bytes; line += 64) __builtin_prefetch(at + line);
}

/// One batch between the stages.
template <class T>
struct PairBatch {
    const std::int32_t *a, *b;  ///< records
    PairLanes<T> pair;
    Lane<T> radius_a, radius_b, kn, friction;
    Lane3<T> velocity, spin_a, spin_b;  ///< velocity of b relative to a
    Lane3<T> shear;                     ///< before, then the new one
    Approach<T> approach;
    Lane3<T> force;
    std::uint32_t touching;  ///< a bit a lane
};

/// First stage: loads the records; where the spheres are.
template <class T, bool Friction, bool PerSphere>
HWY_INLINE void approach_batch(const PairCall<T>& call, Lane4<T> separation, PairBatch<T>& batch,
                               LaneMask<T>& too_deep) {
    const Tag<T> d;
    const auto half = set<T>(T(0.5)), one = set<T>(1), zero = hn::Zero(d);
    const PairParameters<T>& p = call.parameters;
    const RecordLanes<T> ra = load_records<T>(call.records, batch.a);
    const RecordLanes<T> rb = load_records<T>(call.records, batch.b);
    const Lane3<T> built = separation.xyz();
    const Lane3<T> moved = rb.u.xyz() - ra.u.xyz();
    PairLanes<T>& pair = batch.pair;
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
    batch.touching = bits_of<T>(hn::Gt(depth, zero));
    pair.overlap = hn::Max(zero, depth);
    pair.normal = scaled(pair.inverse_distance, pair.branch);
    too_deep = hn::Or(too_deep, hn::Gt(depth, hn::Mul(half, hn::Min(ra.u.w, rb.u.w))));
    batch.radius_a = ra.u.w;
    batch.radius_b = rb.u.w;
    // Eq. (4) with r the mean radius.
    const auto mean_radius = hn::Mul(half, pair.reach);
    if constexpr (PerSphere)
        batch.kn = contact_stiffness<T>(mean_radius, ra.w.w, rb.w.w);
    else
        batch.kn = hn::Mul(mean_radius, set<T>(T(0.5) * p.uniform_stiffness));
    if constexpr (Friction) {
        batch.velocity = rb.v.xyz() - ra.v.xyz();
        batch.spin_a = ra.w.xyz();
        batch.spin_b = rb.w.xyz();
        if constexpr (PerSphere)
            batch.friction = hn::Min(ra.v.w, rb.v.w);
        else
            batch.friction = set<T>(p.uniform_friction);
    }
}

/// Second stage: how the spheres moved past each other.
template <class T>
HWY_INLINE void motion_batch(const PairCall<T>& call, PairBatch<T>& batch) {
    batch.approach =
        sphere_motion<T>(batch.pair, batch.radius_a, batch.radius_b, batch.velocity, batch.spin_a,
                         batch.spin_b, batch.shear, set<T>(call.parameters.step));
}

/// Third stage: forces. Of pairs that do not touch they are zero, and their history is gone.
template <class T, bool Friction, bool Sums>
HWY_INLINE void force_batch(const PairCall<T>& call, PairBatch<T>& batch, LaneSums<T>& sums) {
    const PairLanes<T>& pair = batch.pair;
    const auto fn = hn::Mul(batch.kn, pair.overlap);  // Eq. (3a)
    batch.force = scaled(hn::Neg(fn), pair.normal);
    [[maybe_unused]] LaneMask<T> counted;
    if constexpr (Sums) {
        counted = below<T>(batch.a, call.parameters.counted);
        sums.add_normal(counted, fn, pair.overlap);
        sums.contacts += __builtin_popcount(batch.touching & bits_of<T>(counted));
    }
    if constexpr (Friction) {
        const ShearLanes<T> spring =
            load_shear<T, Sums>(batch.approach.motion, batch.approach.gap_before, pair.overlap,
                                hn::Mul(set<T>(call.parameters.stiffness_ratio), batch.kn),
                                hn::Mul(batch.friction, fn));
        batch.shear = spring.shear;
        // The force on the centres does the work of the spring, whose lever arms are the radii.
        batch.force =
            plus_scaled(batch.force, hn::Mul(pair.reach, pair.inverse_distance), spring.shear);
        if constexpr (Sums) sums.add_shear(counted, spring);
    }
}

/// Last stage: onto the loads of both spheres.
template <class T, bool Friction>
HWY_INLINE void load_batch(const PairCall<T>& call, const PairBatch<T>& batch) {
    const auto zero = hn::Zero(Tag<T>());
    Lane3<T> moment{zero, zero, zero};
    if constexpr (Friction) moment = cross(batch.pair.normal, batch.shear);
    add_loads<T>(call.loads, batch.a, batch.force, scaled(batch.radius_a, moment));
    add_loads<T>(call.loads, batch.b, scaled(set<T>(-1), batch.force),
                 scaled(batch.radius_b, moment));
}

/// All stages but the first, of `count` batches.
template <class T, bool Friction, bool Sums>
HWY_INLINE void finish_batches(const PairCall<T>& call, PairBatch<T>* batches, std::size_t count,
                               LaneSums<T>& sums) {
    if constexpr (Friction)
        for (std::size_t q = 0; q < count; ++q) motion_batch<T>(call, batches[q]);
    for (std::size_t q = 0; q < count; ++q) force_batch<T, Friction, Sums>(call, batches[q], sums);
    for (std::size_t q = 0; q < count; ++q) load_batch<T, Friction>(call, batches[q]);
}

/// Candidates that are close: one batch after the other, history in place.
template <class T, bool Friction, bool PerSphere, bool Sums>
HWY_INLINE void close_forces(const PairCall<T>& call, LaneMask<T>& too_deep, LaneSums<T>& sums,
                             PassResult& result) {
    constexpr std::size_t n = lanes<T>;
    const Candidates<T>& c = call.candidates;
    const auto zero = hn::Zero(Tag<T>());
    for (std::size_t word = 0; word < c.close / most_lanes; ++word) c.touching[word] = 0;
    PairBatch<T> batches[group];
    for (std::size_t first = 0; first < c.close; first += group * n) {
        const std::size_t count = std::min(group, (c.close - first) / n);
        fetch_ahead(c.separation + first + ahead * n);
        if constexpr (Friction) fetch_ahead(c.history + first + ahead * n);
        for (std::size_t q = 0; q < count; ++q) {
            const std::size_t k = first + q * n;
            PairBatch<T>& batch = batches[q];
            batch.a = c.a + k;
            batch.b = c.b + k;
            if constexpr (Friction) batch.shear = load_rows<T>(c.history[k].shear).xyz();
            approach_batch<T, Friction, PerSphere>(call, load_rows<T>(c.separation[k].x), batch,
                                                   too_deep);
            c.touching[k / most_lanes] = static_cast<std::uint16_t>(
                c.touching[k / most_lanes] | batch.touching << (k % most_lanes));
            result.contacts += __builtin_popcount(batch.touching);
        }
        finish_batches<T, Friction, Sums>(call, batches, count, sums);
        if constexpr (Friction)
            for (std::size_t q = 0; q < count; ++q) {
                const Lane3<T>& shear = batches[q].shear;
                store_rows<T>({shear.x, shear.y, shear.z, zero}, c.history[first + q * n].shear);
            }
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
            c.scratch[found++] = static_cast<std::int32_t>(word * most_lanes) + __builtin_ctz(left);
        c.touching[word] = static_cast<std::uint16_t>(now);
    }
    return found;
}

/// The candidates picked out by find_touching().
template <class T, bool Friction, bool PerSphere, bool Sums>
HWY_INLINE void picked_forces(const PairCall<T>& call, LaneMask<T>& too_deep, LaneSums<T>& sums,
                              PassResult& result) {
    constexpr std::size_t n = lanes<T>;
    const Candidates<T>& c = call.candidates;
    const std::size_t picked = find_touching<T>(call);
    result.contacts += static_cast<std::int64_t>(picked);
    for (std::size_t l = 0; l < n; ++l) c.scratch[picked + l] = static_cast<std::int32_t>(c.idle);
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
        PairBatch<T> batch;
        batch.a = a.data();
        batch.b = b.data();
        if constexpr (Friction) batch.shear = load4<T>(history, 0).xyz();
        approach_batch<T, Friction, PerSphere>(call, load4<T>(separation, 0), batch, too_deep);
        finish_batches<T, Friction, Sums>(call, &batch, 1, sums);
        if constexpr (Friction)
            store4<T>({batch.shear.x, batch.shear.y, batch.shear.z, hn::Zero(Tag<T>())}, history_to,
                      0);
    }
}

template <class T, bool Friction, bool PerSphere, bool Sums>
PassResult pair_forces(const SphereRecord<T>* records, Candidates<T> c, SphereLoad<T>* loads,
                       const PairParameters<T>& p) {
    const Tag<T> d;
    PassResult result;
    const PairCall<T> call{records, c, loads, p};
    auto too_deep = hn::Lt(hn::Zero(d), hn::Zero(d));
    LaneSums<T> sums;
    close_forces<T, Friction, PerSphere, Sums>(call, too_deep, sums, result);
    picked_forces<T, Friction, PerSphere, Sums>(call, too_deep, sums, result);
    if constexpr (Sums) result.sums = sums.total();
    result.too_deep = !hn::AllFalse(d, too_deep);
    return result;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
