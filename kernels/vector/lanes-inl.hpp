// Lanes: vectors of three components, and records loaded into and stored from lanes. Compiled once
// a target (Highway).

#if defined(GRAINFIELD_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_LANES_INL
#undef GRAINFIELD_LANES_INL
#else
#define GRAINFIELD_LANES_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

#include "kernels/vector/records.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Tag = hn::ScalableTag<T>;
template <class T>
using Lane = hn::Vec<Tag<T>>;
template <class T>
using LaneMask = hn::Mask<Tag<T>>;
template <class T>
inline constexpr std::size_t lanes = HWY_LANES(T);

template <class T>
HWY_INLINE Lane<T> set(T value) {
    return hn::Set(Tag<T>(), value);
}

/// Three components, one contact or sphere a lane.
template <class T>
struct Lane3 {
    Lane<T> x, y, z;
};
template <class T>
HWY_INLINE Lane3<T> operator+(Lane3<T> a, Lane3<T> b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class T>
HWY_INLINE Lane3<T> operator-(Lane3<T> a, Lane3<T> b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// s v.
template <class T, class V = Lane<T>>
HWY_INLINE Lane3<T> scaled(V s, Lane3<T> v) {
    return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}
/// a + s v.
template <class T, class V = Lane<T>>
HWY_INLINE Lane3<T> plus_scaled(Lane3<T> a, V s, Lane3<T> v) {
    return {hn::MulAdd(s, v.x, a.x), hn::MulAdd(s, v.y, a.y), hn::MulAdd(s, v.z, a.z)};
}
/// a - s v.
template <class T, class V = Lane<T>>
HWY_INLINE Lane3<T> minus_scaled(Lane3<T> a, V s, Lane3<T> v) {
    return {hn::NegMulAdd(s, v.x, a.x), hn::NegMulAdd(s, v.y, a.y), hn::NegMulAdd(s, v.z, a.z)};
}
template <class T>
HWY_INLINE Lane<T> dot(Lane3<T> a, Lane3<T> b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class T>
HWY_INLINE Lane3<T> cross(Lane3<T> a, Lane3<T> b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
/// v without its part along the unit vector n.
template <class T>
HWY_INLINE Lane3<T> tangential(Lane3<T> v, Lane3<T> n) {
    return minus_scaled(v, dot(v, n), n);
}
/// How much a pair has come closer or apart: |b|^2 - |b0|^2 of the branch b since the lists were
/// built.
template <class T>
HWY_INLINE Lane<T> growth2(Lane3<T> built, Lane3<T> moved) {
    return dot(moved, plus_scaled(moved, set<T>(2), built));
}

template <class T>
HWY_INLINE Lane3<T> set3(const T* v) {
    return {set(v[0]), set(v[1]), set(v[2])};
}

/// Which of the indices that follow each other in memory are below a bound (of 2^24 at most).
template <class T>
HWY_INLINE LaneMask<T> below(const std::int32_t* index, std::int32_t bound) {
    const Tag<T> d;
    const auto whole = hn::LoadU(hn::Rebind<std::int32_t, Tag<T>>(), index);
    const auto bounds = hn::Set(d, static_cast<T>(bound));
    if constexpr (sizeof(T) == 8)
        return hn::Lt(hn::PromoteTo(d, whole), bounds);
    else
        return hn::Lt(hn::ConvertTo(d, whole), bounds);
}

/// Four numbers that follow each other in memory, in four vectors.
template <class T>
struct Lane4 {
    Lane<T> x, y, z, w;
    HWY_INLINE Lane3<T> xyz() const { return {x, y, z}; }
};

/// The blocks u, v, w of one record a lane.
template <class T>
struct RecordLanes {
    Lane4<T> u, v, w;
};

// Vectors are built from and taken apart into blocks of 128 bits: four floats or two doubles.
#if HWY_TARGET == HWY_SCALAR

template <class T>
HWY_INLINE Lane4<T> load4(const std::array<const T*, 1>& at, std::size_t offset) {
    const T* p = at[0] + offset;
    const Tag<T> d;
    return {hn::Load(d, p), hn::Load(d, p + 1), hn::Load(d, p + 2), hn::Load(d, p + 3)};
}
template <class T>
HWY_INLINE void store4(Lane4<T> v, const std::array<T*, 1>& at, std::size_t offset) {
    T* p = at[0] + offset;
    const Tag<T> d;
    hn::Store(v.x, d, p);
    hn::Store(v.y, d, p + 1);
    hn::Store(v.z, d, p + 2);
    hn::Store(v.w, d, p + 3);
}
template <class T>
HWY_INLINE void add4(Lane4<T> v, const std::array<T*, 1>& at, std::size_t offset) {
    const Lane4<T> old = load4<T>({at[0]}, offset);
    store4<T>({hn::Add(old.x, v.x), hn::Add(old.y, v.y), hn::Add(old.z, v.z), hn::Add(old.w, v.w)},
              at, offset);
}

template <class T>
HWY_INLINE RecordLanes<T> load_records(const SphereRecord<T>* records, const std::int32_t* index) {
    const std::array<const T*, 1> at{records[*index].u};
    return {load4<T>(at, 0), load4<T>(at, 4), load4<T>(at, 8)};
}
template <class T>
HWY_INLINE Lane4<T> load_places(const SphereRecord<T>* records, const std::int32_t* index) {
    return load4<T>({records[*index].u}, 0);
}
template <class T>
HWY_INLINE void add_loads(SphereLoad<T>* loads, const std::int32_t* index, Lane3<T> force,
                          Lane3<T> moment) {
    const Lane<T> zero = hn::Zero(Tag<T>());
    add4<T>({force.x, force.y, force.z, zero}, {loads[*index].force}, 0);
    add4<T>({moment.x, moment.y, moment.z, zero}, {loads[*index].force}, 4);
}
template <class T>
HWY_INLINE Lane4<T> load_rows(const T* rows) {
    return load4<T>({rows}, 0);
}
template <class T>
HWY_INLINE void store_rows(Lane4<T> v, T* rows) {
    store4<T>(v, {rows}, 0);
}

#else

template <class T>
using Block = hn::Full128<T>;
template <class T>
inline constexpr std::size_t block_lanes = 16 / sizeof(T);
template <class T>
inline constexpr std::size_t blocks = lanes<T> / block_lanes<T>;

/// A vector of the blocks at at[first], at[first + block_lanes], ...
template <class T>
HWY_INLINE Lane<T> join(const std::array<const T*, lanes<T>>& at, std::size_t first,
                        std::size_t offset) {
    constexpr std::size_t b = block_lanes<T>;
    const Block<T> d;
    const auto block = [&](std::size_t q)
                           HWY_ATTR { return hn::LoadU(d, at[first + q * b] + offset); };
    if constexpr (blocks<T> == 1) {
        return block(0);
    } else if constexpr (blocks<T> == 2) {
        return hn::Combine(Tag<T>(), block(1), block(0));
    } else {
        const hn::Half<Tag<T>> half;
        return hn::Combine(Tag<T>(), hn::Combine(half, block(3), block(2)),
                           hn::Combine(half, block(1), block(0)));
    }
}
/// Calls use(q, block) for the blocks of a vector.
template <class T, class Use>
HWY_INLINE void split(Lane<T> v, const Use& use) {
    if constexpr (blocks<T> == 1) {
        use(std::size_t{0}, v);
    } else if constexpr (blocks<T> == 2) {
        use(std::size_t{0}, hn::LowerHalf(Block<T>(), v));
        use(std::size_t{1}, hn::UpperHalf(Block<T>(), v));
    } else {
        const hn::Half<Tag<T>> half;
        const auto low = hn::LowerHalf(half, v), high = hn::UpperHalf(half, v);
        use(std::size_t{0}, hn::LowerHalf(Block<T>(), low));
        use(std::size_t{1}, hn::UpperHalf(Block<T>(), low));
        use(std::size_t{2}, hn::LowerHalf(Block<T>(), high));
        use(std::size_t{3}, hn::UpperHalf(Block<T>(), high));
    }
}

/// Transposes 4 x 4 within each block of floats.
HWY_INLINE void transpose(Lane<float>& a, Lane<float>& b, Lane<float>& c, Lane<float>& d) {
    const Tag<float> f;
    const hn::Repartition<double, Tag<float>> g;
    const auto ab0 = hn::BitCast(g, hn::InterleaveLower(f, a, b));
    const auto ab1 = hn::BitCast(g, hn::InterleaveUpper(f, a, b));
    const auto cd0 = hn::BitCast(g, hn::InterleaveLower(f, c, d));
    const auto cd1 = hn::BitCast(g, hn::InterleaveUpper(f, c, d));
    a = hn::BitCast(f, hn::InterleaveLower(g, ab0, cd0));
    b = hn::BitCast(f, hn::InterleaveUpper(g, ab0, cd0));
    c = hn::BitCast(f, hn::InterleaveLower(g, ab1, cd1));
    d = hn::BitCast(f, hn::InterleaveUpper(g, ab1, cd1));
}

/// The four numbers at at[l] + offset of every lane l.
template <class T>
HWY_INLINE Lane4<T> load4(const std::array<const T*, lanes<T>>& at, std::size_t offset) {
    if constexpr (sizeof(T) == 4) {
        Lane4<T> v{join<T>(at, 0, offset), join<T>(at, 1, offset), join<T>(at, 2, offset),
                   join<T>(at, 3, offset)};
        transpose(v.x, v.y, v.z, v.w);
        return v;
    } else {
        const Tag<T> d;
        const auto a = join<T>(at, 0, offset), b = join<T>(at, 1, offset);
        const auto c = join<T>(at, 0, offset + 2), e = join<T>(at, 1, offset + 2);
        return {hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b),
                hn::InterleaveLower(d, c, e), hn::InterleaveUpper(d, c, e)};
    }
}

/// Calls put(lane, offset, block) for every block of what store4 or add4 has to write.
template <class T, class Put>
HWY_INLINE void rows(Lane4<T> v, std::size_t offset, const Put& put) {
    if constexpr (sizeof(T) == 4) {
        transpose(v.x, v.y, v.z, v.w);
        split<T>(v.x, [&](std::size_t q, auto block) HWY_ATTR { put(4 * q, offset, block); });
        split<T>(v.y, [&](std::size_t q, auto block) HWY_ATTR { put(4 * q + 1, offset, block); });
        split<T>(v.z, [&](std::size_t q, auto block) HWY_ATTR { put(4 * q + 2, offset, block); });
        split<T>(v.w, [&](std::size_t q, auto block) HWY_ATTR { put(4 * q + 3, offset, block); });
    } else {
        const Tag<T> d;
        const auto a = hn::InterleaveLower(d, v.x, v.y), b = hn::InterleaveUpper(d, v.x, v.y);
        const auto c = hn::InterleaveLower(d, v.z, v.w), e = hn::InterleaveUpper(d, v.z, v.w);
        split<T>(a, [&](std::size_t q, auto block) HWY_ATTR { put(2 * q, offset, block); });
        split<T>(b, [&](std::size_t q, auto block) HWY_ATTR { put(2 * q + 1, offset, block); });
        split<T>(c, [&](std::size_t q, auto block) HWY_ATTR { put(2 * q, offset + 2, block); });
        split<T>(e, [&](std::size_t q, auto block) HWY_ATTR { put(2 * q + 1, offset + 2, block); });
    }
}
template <class T>
HWY_INLINE void store4(Lane4<T> v, const std::array<T*, lanes<T>>& at, std::size_t offset) {
    rows<T>(v, offset, [&](std::size_t lane, std::size_t o, auto block) HWY_ATTR {
        hn::StoreU(block, Block<T>(), at[lane] + o);
    });
}
/// Adds to the four numbers at at[l] + offset, in a fixed order of the lanes: two lanes may point
/// to the same place.
template <class T>
HWY_INLINE void add4(Lane4<T> v, const std::array<T*, lanes<T>>& at, std::size_t offset) {
    const Block<T> d;
    rows<T>(v, offset, [&](std::size_t lane, std::size_t o, auto block) HWY_ATTR {
        T* p = at[lane] + o;
        hn::StoreU(hn::Add(hn::LoadU(d, p), block), d, p);
    });
}

/// Loads whole records: every index is read once.
template <class T>
HWY_INLINE RecordLanes<T> load_records(const SphereRecord<T>* records, const std::int32_t* index) {
    std::array<const T*, lanes<T>> at;
    for (std::size_t l = 0; l < lanes<T>; ++l) at[l] = records[index[l]].u;
    if constexpr (sizeof(T) == 4) {
        RecordLanes<T> r{
            {join<T>(at, 0, 0), join<T>(at, 1, 0), join<T>(at, 2, 0), join<T>(at, 3, 0)},
            {join<T>(at, 0, 4), join<T>(at, 1, 4), join<T>(at, 2, 4), join<T>(at, 3, 4)},
            {join<T>(at, 0, 8), join<T>(at, 1, 8), join<T>(at, 2, 8), join<T>(at, 3, 8)}};
        transpose(r.u.x, r.u.y, r.u.z, r.u.w);
        transpose(r.v.x, r.v.y, r.v.z, r.v.w);
        transpose(r.w.x, r.w.y, r.w.z, r.w.w);
        return r;
    } else {
        return {load4<T>(at, 0), load4<T>(at, 4), load4<T>(at, 8)};
    }
}
/// Loads the first block of records.
template <class T>
HWY_INLINE Lane4<T> load_places(const SphereRecord<T>* records, const std::int32_t* index) {
    std::array<const T*, lanes<T>> at;
    for (std::size_t l = 0; l < lanes<T>; ++l) at[l] = records[index[l]].u;
    return load4<T>(at, 0);
}

/// Adds force and moment to the loads of every lane, in a fixed order of the lanes.
template <class T>
HWY_INLINE void add_loads(SphereLoad<T>* loads, const std::int32_t* index, Lane3<T> force,
                          Lane3<T> moment) {
    const Lane<T> zero = hn::Zero(Tag<T>());
    Lane4<T> f{force.x, force.y, force.z, zero}, m{moment.x, moment.y, moment.z, zero};
    if constexpr (sizeof(T) == 4 && 1 < blocks<T>) {
        // A load of eight floats at once: blocks of force and moment side by side.
        const hn::Full256<T> d;
        transpose(f.x, f.y, f.z, f.w);
        transpose(m.x, m.y, m.z, m.w);
        const auto add = [&](std::size_t lane, auto sum) HWY_ATTR {
            T* p = loads[index[lane]].force;
            hn::Store(hn::Add(hn::Load(d, p), sum), d, p);
        };
        const auto row = [&](std::size_t first, Lane<T> force_row, Lane<T> moment_row) HWY_ATTR {
            const auto even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(moment_row), force_row);
            const auto odd = hn::OddEvenBlocks(moment_row, hn::SwapAdjacentBlocks(force_row));
            if constexpr (blocks<T> == 2) {
                add(first, even);
                add(first + 4, odd);
            } else {
                add(first, hn::LowerHalf(d, even));
                add(first + 4, hn::LowerHalf(d, odd));
                add(first + 8, hn::UpperHalf(d, even));
                add(first + 12, hn::UpperHalf(d, odd));
            }
        };
        row(0, f.x, m.x);
        row(1, f.y, m.y);
        row(2, f.z, m.z);
        row(3, f.w, m.w);
    } else {
        std::array<T*, lanes<T>> at;
        for (std::size_t l = 0; l < lanes<T>; ++l) at[l] = loads[index[l]].force;
        add4<T>(f, at, 0);
        add4<T>(m, at, 4);
    }
}

/// Rows of four that follow each other in memory, one a lane.
template <class T>
HWY_INLINE Lane4<T> load_rows(const T* rows) {
    Lane4<T> v;
    hn::LoadInterleaved4(Tag<T>(), rows, v.x, v.y, v.z, v.w);
    return v;
}
template <class T>
HWY_INLINE void store_rows(Lane4<T> v, T* rows) {
    hn::StoreInterleaved4(v.x, v.y, v.z, v.w, Tag<T>(), rows);
}

#endif

/// A bit for every lane that is set.
template <class T>
HWY_INLINE std::uint32_t bits_of(LaneMask<T> mask) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag<T>(), mask, bytes);
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// Sum of the lanes in double, in their order.
template <class T>
HWY_INLINE double sum_lanes(Lane<T> v) {
    alignas(64) T lane[lanes<T>];
    hn::Store(v, Tag<T>(), lane);
    double sum = 0;
    for (T value : lane) sum += static_cast<double>(value);
    return sum;
}
}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
