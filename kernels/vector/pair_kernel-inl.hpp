// Forces of candidate pairs of spheres. A lane costs the same whether its pair touches or not.
// Close candidates mostly touch, so all of them go through the law. The others mostly do not, so
// those that touch are picked out first.

#if defined(GRAINFIELD_PAIR_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_PAIR_KERNEL_INL
#undef GRAINFIELD_PAIR_KERNEL_INL
#else
#define GRAINFIELD_PAIR_KERNEL_INL
#endif

#include <algorithm>

#include "kernels/vector/law-inl.hpp"
#include "kernels/vector/record_lanes-inl.hpp"
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
inline constexpr std::size_t group = 2;

/// Candidates are read in order, but faster than the processor foresees: batches to ask for early.
inline constexpr std::size_t ahead = 24;

/// Asks memory for one group's worth of a column of `components` from candidate k on; may lie
/// beyond the end.
template <class T, class Column>
HWY_INLINE void fetch_ahead(const Column* column, std::size_t k, std::size_t components,
                            std::size_t batches = group) {
    const char* at = reinterpret_cast<const char*>(column + k * components);
    const std::size_t bytes = batches * lanes<T> * components * sizeof(Column);
    for (std::size_t line = 0; line < bytes; line += 64) __builtin_prefetch(at + line);
}

/// Components of a batch in a column of `components` in blocks.
template <class T>
HWY_INLINE Lane<T> load_component(const T* column, std::size_t k, std::size_t component,
                                  std::size_t components) {
    return hn::Load(Tag<T>(), column + in_block(k, component, components));
}

/// One batch between the stages.
template <class T>
struct PairBatch {
    const std::int32_t *a, *b;  ///< records
    PairLanes<T> pair;
    Lane<T> kn, friction;
    Lane3<T> velocity, spins, rolled;  ///< of b relative to a; sums, as sphere_motion() wants them
    Lane3<T> shear;                    ///< before, then the new one
    Approach<T> approach;
    Lane3<T> force;
    std::uint32_t touching;  ///< a bit a lane
    std::size_t slot;        ///< of WideSum
};

/// True if an overlap of the batch exceeds half the smaller radius; called where one exceeds half
/// the smallest radius of all.
template <class T>
HWY_NOINLINE bool too_deep_in(const SphereRecord<T>* records, const std::int32_t* a,
                              const std::int32_t* b, Lane<T> depth) {
    alignas(64) T lane[lanes<T>];
    hn::Store(depth, Tag<T>(), lane);
    bool deep = false;
    for (std::size_t l = 0; l < lanes<T>; ++l)
        deep |= lane[l] >
                T(0.5) * std::min(record_of(records, a[l]).radius, record_of(records, b[l]).radius);
    return deep;
}

/// First stage: loads the records; where the spheres are.
template <class T, bool Friction, bool PerSphere>
HWY_INLINE void approach_batch(const PairCall<T>& call, Lane4<T> separation, PairBatch<T>& batch,
                               bool& too_deep) {
    const Tag<T> d;
    const auto half = set<T>(T(0.5)), one = set<T>(1), zero = hn::Zero(d);
    const PairParameters<T>& p = call.parameters;
    const PairColumns<T> both_of = load_pairs < T,
                         Friction && PerSphere > (call.records, batch.a, batch.b);
    const Lane3<T> built = separation.xyz(), moved = both_of.xyz(moved_columns);
    PairLanes<T>& pair = batch.pair;
    pair.branch = built + moved;
    pair.reach = both_of.column[reach_column];
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
    if (!hn::AllFalse(d, hn::Gt(depth, set<T>(T(0.5) * p.smallest_radius))))
        too_deep |= too_deep_in<T>(call.records, batch.a, batch.b, depth);
    // Eq. (4) of Tran et al., r the mean radius.
    const auto mean_radius = hn::Mul(half, pair.reach);
    if constexpr (PerSphere)
        batch.kn = contact_stiffness<T>(mean_radius, both_of.column[compliance_column]);
    else
        batch.kn = hn::Mul(mean_radius, set<T>(T(0.5) * p.uniform_stiffness));
    if constexpr (Friction) {
        batch.velocity = both_of.xyz(velocity_columns);
        batch.spins = both_of.xyz(spin_columns);
        batch.rolled = both_of.xyz(rolled_columns);
        if constexpr (PerSphere)
            batch.friction = both_of.column[friction_column];
        else
            batch.friction = set<T>(p.uniform_friction);
    }
}

template <class T>
HWY_INLINE Approach<T> motion_of(const PairBatch<T>& batch, Lane<T> step) {
    return sphere_motion<T>(batch.pair, batch.velocity, batch.spins, batch.rolled, batch.shear,
                            step);
}

/// motion_of() for the lanes that turn too much for the short way. Lane by lane, so that what a
/// pair gets does not depend on the batch that it is in.
template <class T>
HWY_NOINLINE void correct_motion(PairBatch<T>& batch, LaneMask<T> lanes_meant, Lane<T> step) {
    const Approach<T> right = motion_of<T>(batch, step);
    const auto choose = [&](Lane<T> value, Lane<T>& in_place)
                            HWY_ATTR { in_place = hn::IfThenElse(lanes_meant, value, in_place); };
    const auto choose3 = [&](const Lane3<T>& value, Lane3<T>& in_place) HWY_ATTR {
        choose(value.x, in_place.x);
        choose(value.y, in_place.y);
        choose(value.z, in_place.z);
    };
    choose3(right.motion.displacement, batch.approach.motion.displacement);
    choose3(right.motion.turned, batch.approach.motion.turned);
    choose(right.gap_before, batch.approach.gap_before);
}

/// Second stage: how the spheres moved past each other.
template <class T>
HWY_INLINE void motion_batch(const PairCall<T>& call, PairBatch<T>& batch) {
    const auto step = set<T>(call.parameters.step);
    if constexpr (sizeof(T) == 8) {
        batch.approach = motion_of<T>(batch, step);
    } else {
        const SmallMotion<T> small(batch.pair, batch.velocity, batch.spins, batch.rolled,
                                   batch.shear, step);
        batch.approach = small.approach;
        if (!hn::AllFalse(Tag<T>(), small.too_large))
            correct_motion<T>(batch, small.too_large, step);
    }
}

/// Third stage: forces. Of pairs that do not touch they are zero, and their history is gone.
template <class T, bool Friction, bool Sums, bool Replay>
HWY_INLINE void force_batch(const PairCall<T>& call, PairBatch<T>& batch, LaneSums<T>& sums) {
    const PairLanes<T>& pair = batch.pair;
    const auto fn = hn::Mul(batch.kn, pair.overlap);  // Eq. (3a) of Tran et al.
    batch.force = scaled(hn::Neg(fn), pair.normal);
    [[maybe_unused]] LaneMask<T> counted;
    if constexpr (Sums) {
        counted = below<T>(batch.a, call.parameters.counted);
        sums.add_normal(batch.slot, counted, fn, pair.overlap);
        sums.contacts += __builtin_popcount(batch.touching & bits_of<T>(counted));
    }
    // The force on the centres does the work of the spring, whose lever arms are the radii.
    const auto lever = hn::Mul(pair.reach, pair.inverse_distance);
    if constexpr (Replay) {
        batch.force = plus_scaled(batch.force, lever, batch.shear);
    } else if constexpr (Friction) {
        const ShearLanes<T> spring =
            load_shear<T, Sums>(batch.approach.motion, batch.approach.gap_before, pair.overlap,
                                hn::Mul(set<T>(call.parameters.stiffness_ratio), batch.kn),
                                hn::Mul(batch.friction, fn));
        batch.shear = spring.shear;
        batch.force = plus_scaled(batch.force, lever, spring.shear);
        if constexpr (Sums) sums.add_shear(batch.slot, counted, spring);
    }
}

/// Last stage: onto the loads of both spheres, of as many batches as are added together.
template <class T, bool Friction>
HWY_INLINE void load_batches(const PairCall<T>& call, const PairBatch<T>* batches) {
    const auto zero = hn::Zero(Tag<T>());
    std::array<LoadedPairs<T>, parts_of_load<T>> pairs;
    for (std::size_t q = 0; q < parts_of_load<T>; ++q) {
        const PairBatch<T>& batch = batches[q];
        Lane3<T> moment{zero, zero, zero};
        if constexpr (Friction) moment = cross(batch.pair.normal, batch.shear);
        pairs[q] = {batch.a, batch.b, batch.force, moment};
    }
    add_pair_loads<T>(call.loads, pairs);
}

/// All stages but the first, of `count` batches, a multiple of parts_of_load.
template <class T, bool Friction, bool Sums, bool Replay>
HWY_INLINE void finish_batches(const PairCall<T>& call, PairBatch<T>* batches, std::size_t count,
                               LaneSums<T>& sums) {
    if constexpr (Friction && !Replay)
        for (std::size_t q = 0; q < count; ++q) motion_batch<T>(call, batches[q]);
    for (std::size_t q = 0; q < count; ++q)
        force_batch<T, Friction, Sums, Replay>(call, batches[q], sums);
    for (std::size_t q = 0; q < count; q += parts_of_load<T>)
        load_batches<T, Friction>(call, batches + q);
}

/// Candidates that are close: one batch after the other, history in place.
template <class T, bool Friction, bool PerSphere, bool Sums, bool Replay>
HWY_INLINE void close_forces(const PairCall<T>& call, bool& too_deep, LaneSums<T>& sums,
                             PassResult& result) {
    constexpr std::size_t n = lanes<T>;
    const Candidates<T>& c = call.candidates;
    for (std::size_t word = 0; word < c.close / most_lanes; ++word) c.touching[word] = 0;
    PairBatch<T> batches[group];
    constexpr std::size_t line = 64;  // [B]
    const char *coming = c.coming, *const coming_end = c.coming + c.coming_bytes;
    const std::size_t coming_share =
        line * (c.coming_bytes * group * n / line / std::max<std::size_t>(c.close, 1) + 1);
    for (std::size_t first = 0; first < c.close; first += group * n) {
        // Into the outer cache: the inner one is in use.
        for (const char* end = std::min(coming + coming_share, coming_end); coming < end;
             coming += line)
            __builtin_prefetch(coming, 0, 2);
        const std::size_t count = std::min(group, (c.close - first) / n);
        fetch_ahead<T>(c.a, first + ahead * n, 1);
        fetch_ahead<T>(c.b, first + ahead * n, 1);
        fetch_ahead<T>(c.separation, first + ahead * n, separation_size);
        if constexpr (Friction) fetch_ahead<T>(c.history, first + ahead * n, history_size);
        for (std::size_t q = 0; q < count; ++q) {
            const std::size_t k = first + q * n;
            const auto separation = [&](std::size_t component) HWY_ATTR {
                return load_component(c.separation, k, component, separation_size);
            };
            PairBatch<T>& batch = batches[q];
            batch.a = c.a + k;
            batch.b = c.b + k;
            batch.slot = slot_of<T>(k);
            if constexpr (Friction)
                batch.shear = {load_component(c.history, k, 0, history_size),
                               load_component(c.history, k, 1, history_size),
                               load_component(c.history, k, 2, history_size)};
            approach_batch<T, Friction, PerSphere>(
                call, {separation(0), separation(1), separation(2), separation(3)}, batch,
                too_deep);
            c.touching[k / most_lanes] = static_cast<std::uint16_t>(
                c.touching[k / most_lanes] | batch.touching << (k % most_lanes));
            result.contacts += __builtin_popcount(batch.touching);
        }
        finish_batches<T, Friction, Sums, Replay>(call, batches, count, sums);
        if constexpr (Friction && !Replay)
            for (std::size_t q = 0; q < count; ++q) {
                const Lane3<T>& shear = batches[q].shear;
                T* history = c.history + in_block(first + q * n, 0, history_size);
                hn::Store(shear.x, Tag<T>(), history);
                hn::Store(shear.y, Tag<T>(), history + most_lanes);
                hn::Store(shear.z, Tag<T>(), history + 2 * most_lanes);
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
        const std::size_t coming = word * most_lanes + ahead * most_lanes;
        fetch_ahead<T>(c.a, coming, 1, most_lanes / n);
        fetch_ahead<T>(c.b, coming, 1, most_lanes / n);
        fetch_ahead<T>(c.separation, coming, separation_size, most_lanes / n);
        for (std::size_t part = 0; part < most_lanes; part += n) {
            const std::size_t k = word * most_lanes + part;
            const auto separation = [&](std::size_t component) HWY_ATTR {
                return load_component(c.separation, k, component, separation_size);
            };
            const Lane4<T> place = load_pair_places<T>(call.records, c.a + k, c.b + k);
            const auto gap = separation(gap_component);
            // Touching: |b| < reach, with |b0| = reach - gap.
            const auto room = hn::Mul(gap, hn::Sub(hn::Add(place.w, place.w), gap));
            const Lane3<T> built{separation(0), separation(1), separation(2)};
            now |= bits_of<T>(hn::Lt(growth2<T>(built, place.xyz()), room)) << part;
        }
        for (std::uint32_t left = now | c.touching[word]; left != 0; left &= left - 1)
            c.scratch[found++] = static_cast<std::int32_t>(word * most_lanes) + __builtin_ctz(left);
        c.touching[word] = static_cast<std::uint16_t>(now);
    }
    return found;
}

/// A batch of candidates picked out, with what they have in the columns.
template <class T>
struct PickedBatch {
    std::array<std::int32_t, lanes<T>> a, b;
    alignas(64) T separation[separation_size][lanes<T>], history[history_size][lanes<T>];
};

/// The candidates picked out by find_touching().
template <class T, bool Friction, bool PerSphere, bool Sums, bool Replay>
HWY_INLINE void picked_forces(const PairCall<T>& call, bool& too_deep, LaneSums<T>& sums,
                              PassResult& result) {
    constexpr std::size_t n = lanes<T>, parts = parts_of_load<T>;
    const Tag<T> d;
    const Candidates<T>& c = call.candidates;
    const std::size_t picked = find_touching<T>(call);
    result.contacts += static_cast<std::int64_t>(picked);
    for (std::size_t l = 0; l < parts * n; ++l)
        c.scratch[picked + l] = static_cast<std::int32_t>(c.idle);
    for (std::size_t k = 0; k < picked; k += parts * n) {
        PickedBatch<T> from[parts];
        PairBatch<T> batches[parts];
        const auto place = [&](std::size_t q, std::size_t l) HWY_ATTR {
            return static_cast<std::size_t>(c.scratch[k + q * n + l]);
        };
        for (std::size_t q = 0; q < parts; ++q) {
            PickedBatch<T>& picked_here = from[q];
            for (std::size_t l = 0; l < n; ++l) {
                const std::size_t at = place(q, l);
                picked_here.a[l] = c.a[at];
                picked_here.b[l] = c.b[at];
                for (std::size_t s = 0; s < separation_size; ++s)
                    picked_here.separation[s][l] = c.separation[in_block(at, s, separation_size)];
                if constexpr (Friction)
                    for (std::size_t s = 0; s < history_size; ++s)
                        picked_here.history[s][l] = c.history[in_block(at, s, history_size)];
            }
            PairBatch<T>& batch = batches[q];
            batch.a = picked_here.a.data();
            batch.b = picked_here.b.data();
            batch.slot = slot_of<T>(k + q * n);
            if constexpr (Friction)
                batch.shear = {hn::Load(d, picked_here.history[0]),
                               hn::Load(d, picked_here.history[1]),
                               hn::Load(d, picked_here.history[2])};
            approach_batch<T, Friction, PerSphere>(
                call,
                {hn::Load(d, picked_here.separation[0]), hn::Load(d, picked_here.separation[1]),
                 hn::Load(d, picked_here.separation[2]), hn::Load(d, picked_here.separation[3])},
                batch, too_deep);
        }
        finish_batches<T, Friction, Sums, Replay>(call, batches, parts, sums);
        if constexpr (Friction && !Replay)
            for (std::size_t q = 0; q < parts; ++q) {
                auto& history = from[q].history;
                hn::Store(batches[q].shear.x, d, history[0]);
                hn::Store(batches[q].shear.y, d, history[1]);
                hn::Store(batches[q].shear.z, d, history[2]);
                for (std::size_t l = 0; l < n; ++l)
                    for (std::size_t s = 0; s < history_size; ++s)
                        c.history[in_block(place(q, l), s, history_size)] = history[s][l];
            }
    }
}

template <class T, bool Friction, bool PerSphere, bool Sums, bool Replay>
PassResult pair_forces(const SphereRecord<T>* records, Candidates<T> c, SphereLoad<T>* loads,
                       const PairParameters<T>& p) {
    PassResult result;
    const PairCall<T> call{records, c, loads, p};
    LaneSums<T> sums;
    close_forces<T, Friction, PerSphere, Sums, Replay>(call, result.too_deep, sums, result);
    picked_forces<T, Friction, PerSphere, Sums, Replay>(call, result.too_deep, sums, result);
    if constexpr (Sums) result.sums = sums.total();
    return result;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
