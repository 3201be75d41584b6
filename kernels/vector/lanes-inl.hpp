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

/// Which of the entries that follow each other in memory are below a bound (of 2^24 at most).
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

/// What two records of a lane have in common, component by component as in SphereRecord: b - a of
/// u and v, a + b of all else; of the friction the smaller one where it was asked for.
template <class T>
struct PairColumns {
    std::array<Lane<T>, 16> column;
    HWY_INLINE Lane3<T> xyz(std::size_t first) const {
        return {column[first], column[first + 1], column[first + 2]};
    }
};
// Places in it.
inline constexpr std::size_t moved_columns = 0, reach_column = 3, velocity_columns = 4,
                             compliance_column = 7, spin_columns = 8, friction_column = 11,
                             rolled_columns = 12;
/// Signs of the first record of a pair.
template <class T>
alignas(128) inline constexpr T pair_signs[16] = {-1, -1, -1, 1, -1, -1, -1, 1,
                                                  1,  1,  1,  1, 1,  1,  1,  1};
/// Signs of force and moment of the second of a pair, as in SphereLoad.
template <class T>
alignas(64) inline constexpr T load_signs[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

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
HWY_INLINE void transpose_square(Lane<T>*) {}  // of one

template <class T, bool SmallerFriction>
HWY_INLINE PairColumns<T> load_pairs(const SphereRecord<T>* records, const std::int32_t* a,
                                     const std::int32_t* b) {
    const Tag<T> d;
    const T *ra = record_of(records, *a).u, *rb = record_of(records, *b).u;
    PairColumns<T> pair;
    for (std::size_t c = 0; c < 16; ++c)
        pair.column[c] =
            hn::MulAdd(hn::Load(d, ra + c), set(pair_signs<T>[c]), hn::Load(d, rb + c));
    if constexpr (SmallerFriction)
        pair.column[friction_column] =
            hn::Min(hn::Load(d, ra + friction_column), hn::Load(d, rb + friction_column));
    return pair;
}
/// Of these u and the radii alone.
template <class T>
HWY_INLINE Lane4<T> load_pair_places(const SphereRecord<T>* records, const std::int32_t* a,
                                     const std::int32_t* b) {
    const Lane4<T> pa = load4<T>({record_of(records, *a).u}, 0);
    const Lane4<T> pb = load4<T>({record_of(records, *b).u}, 0);
    return {hn::Sub(pb.x, pa.x), hn::Sub(pb.y, pa.y), hn::Sub(pb.z, pa.z), hn::Add(pb.w, pa.w)};
}
/// All components of rows that follow each other in memory.
template <class T, class Row>
HWY_INLINE std::array<Lane<T>, 16> load_columns(const Row* rows) {
    const T* row = reinterpret_cast<const T*>(rows);
    std::array<Lane<T>, 16> column;
    for (std::size_t c = 0; c < sizeof(Row) / sizeof(T); ++c)
        column[c] = hn::Load(Tag<T>(), row + c);
    return column;
}
template <class T>
HWY_INLINE void store_columns(const std::array<Lane<T>, 16>& column, SphereRecord<T>* rows) {
    for (std::size_t c = 0; c < 16; ++c) hn::Store(column[c], Tag<T>(), rows->u + c);
}
template <class T>
HWY_INLINE void add_pair_loads(SphereLoad<T>* loads, const std::int32_t* a, const std::int32_t* b,
                               Lane3<T> force, Lane3<T> moment) {
    const Lane<T> zero = hn::Zero(Tag<T>());
    T *la = load_of(loads, *a).force, *lb = load_of(loads, *b).force;
    add4<T>({force.x, force.y, force.z, zero}, {la}, 0);
    add4<T>({moment.x, moment.y, moment.z, zero}, {la}, 4);
    add4<T>({hn::Neg(force.x), hn::Neg(force.y), hn::Neg(force.z), zero}, {lb}, 0);
    add4<T>({moment.x, moment.y, moment.z, zero}, {lb}, 4);
}

#else

template <class T>
using Block = hn::Full128<T>;
template <class T>
inline constexpr std::size_t block_lanes = 16 / sizeof(T);
template <class T>
inline constexpr std::size_t blocks = lanes<T> / block_lanes<T>;

/// A vector of the blocks of lanes first, first + block_lanes, ...; block(lane) gives one.
template <class T, class Get>
HWY_INLINE Lane<T> joined(std::size_t first, const Get& block) {
    constexpr std::size_t b = block_lanes<T>;
    if constexpr (blocks<T> == 1) {
        return block(first);
    } else if constexpr (blocks<T> == 2) {
        return hn::Combine(Tag<T>(), block(first + b), block(first));
    } else {
        const hn::Half<Tag<T>> half;
        return hn::Combine(Tag<T>(), hn::Combine(half, block(first + 3 * b), block(first + 2 * b)),
                           hn::Combine(half, block(first + b), block(first)));
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

/// Four numbers of every lane; block(lane, offset) gives as many of them as fit in a block.
template <class T, class Get>
HWY_INLINE Lane4<T> gather4(const Get& block) {
    const auto join = [&](std::size_t first, std::size_t offset) HWY_ATTR {
        return joined<T>(first, [&](std::size_t lane) HWY_ATTR { return block(lane, offset); });
    };
    if constexpr (sizeof(T) == 4) {
        Lane4<T> v{join(0, 0), join(1, 0), join(2, 0), join(3, 0)};
        transpose(v.x, v.y, v.z, v.w);
        return v;
    } else {
        const Tag<T> d;
        const auto a = join(0, 0), b = join(1, 0), c = join(0, 2), e = join(1, 2);
        return {hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b),
                hn::InterleaveLower(d, c, e), hn::InterleaveUpper(d, c, e)};
    }
}
/// The four numbers at at[l] + offset of every lane l.
template <class T>
HWY_INLINE Lane4<T> load4(const std::array<const T*, lanes<T>>& at, std::size_t offset) {
    const Block<T> d;
    return gather4<T>([&](std::size_t lane, std::size_t o)
                          HWY_ATTR { return hn::LoadU(d, at[lane] + offset + o); });
}

/// Calls put(lane, offset, block) for every block of what is to be written or added.
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

/// Transposes as many vectors as they have lanes.
template <class T>
HWY_INLINE void transpose_square(Lane<T>* v) {
    const Tag<T> d;
    constexpr std::size_t b = block_lanes<T>;
    // Within blocks ...
    for (std::size_t g = 0; g < lanes<T>; g += b) {
        if constexpr (sizeof(T) == 4) {
            transpose(v[g], v[g + 1], v[g + 2], v[g + 3]);
        } else {
            const auto lower = hn::InterleaveLower(d, v[g], v[g + 1]);
            v[g + 1] = hn::InterleaveUpper(d, v[g], v[g + 1]);
            v[g] = lower;
        }
    }
    // ... and the blocks.
    for (std::size_t c = 0; c < b; ++c) {
        if constexpr (blocks<T> == 2) {
            const auto lower = hn::ConcatLowerLower(d, v[b + c], v[c]);
            v[b + c] = hn::ConcatUpperUpper(d, v[b + c], v[c]);
            v[c] = lower;
        } else if constexpr (blocks<T> == 4) {
            const auto pick = [&](auto even, auto odd, Lane<T>& first, Lane<T>& second) HWY_ATTR {
                first = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd), even);
                second = hn::OddEvenBlocks(odd, hn::SwapAdjacentBlocks(even));
            };
            const auto low_even = hn::ConcatLowerLower(d, v[2 * b + c], v[c]);
            const auto low_odd = hn::ConcatLowerLower(d, v[3 * b + c], v[b + c]);
            const auto high_even = hn::ConcatUpperUpper(d, v[2 * b + c], v[c]);
            const auto high_odd = hn::ConcatUpperUpper(d, v[3 * b + c], v[b + c]);
            pick(low_even, low_odd, v[c], v[b + c]);
            pick(high_even, high_odd, v[2 * b + c], v[3 * b + c]);
        }
    }
}

template <class T, bool SmallerFriction>
HWY_INLINE PairColumns<T> load_pairs(const SphereRecord<T>* records, const std::int32_t* a,
                                     const std::int32_t* b) {
    constexpr std::size_t n = lanes<T>;
    const Tag<T> d;
    PairColumns<T> pair;
    for (std::size_t part = 0; part < 16; part += n) {
        const auto signs = hn::Load(d, pair_signs<T> + part);
        Lane<T>* row = pair.column.data() + part;
        for (std::size_t l = 0; l < n; ++l) {
            const auto ra = hn::Load(d, record_of(records, a[l]).u + part);
            const auto rb = hn::Load(d, record_of(records, b[l]).u + part);
            row[l] = hn::MulAdd(ra, signs, rb);
            if constexpr (SmallerFriction) {
                if (part > friction_column || part + n <= friction_column) continue;
                const auto here =
                    hn::Eq(hn::Iota(d, static_cast<T>(part)), set<T>(T(friction_column)));
                row[l] = hn::IfThenElse(here, hn::Min(ra, rb), row[l]);
            }
        }
        transpose_square<T>(row);
    }
    return pair;
}
/// Of these u and the radii alone.
template <class T>
HWY_INLINE Lane4<T> load_pair_places(const SphereRecord<T>* records, const std::int32_t* a,
                                     const std::int32_t* b) {
    const Block<T> d;
    return gather4<T>([&](std::size_t lane, std::size_t o) HWY_ATTR {
        return hn::MulAdd(hn::Load(d, record_of(records, a[lane]).u + o),
                          hn::Load(d, pair_signs<T> + o),
                          hn::Load(d, record_of(records, b[lane]).u + o));
    });
}
/// All components of rows that follow each other in memory.
template <class T, class Row>
HWY_INLINE std::array<Lane<T>, 16> load_columns(const Row* rows) {
    constexpr std::size_t n = lanes<T>, size = sizeof(Row) / sizeof(T);
    std::array<Lane<T>, 16> column;
    if constexpr (n <= size) {
        for (std::size_t part = 0; part < size; part += n) {
            for (std::size_t l = 0; l < n; ++l)
                column[part + l] = hn::Load(Tag<T>(), reinterpret_cast<const T*>(rows + l) + part);
            transpose_square<T>(column.data() + part);
        }
    } else {
        std::array<const T*, n> at;
        for (std::size_t l = 0; l < n; ++l) at[l] = reinterpret_cast<const T*>(rows + l);
        for (std::size_t part = 0; part < size; part += 4) {
            const Lane4<T> four = load4<T>(at, part);
            column[part] = four.x;
            column[part + 1] = four.y;
            column[part + 2] = four.z;
            column[part + 3] = four.w;
        }
    }
    return column;
}
template <class T>
HWY_INLINE void store_columns(std::array<Lane<T>, 16> column, SphereRecord<T>* rows) {
    constexpr std::size_t n = lanes<T>;
    for (std::size_t part = 0; part < 16; part += n) {
        transpose_square<T>(column.data() + part);
        for (std::size_t l = 0; l < n; ++l) hn::Store(column[part + l], Tag<T>(), rows[l].u + part);
    }
}

/// Adds force and moment of every lane's contact to the loads of its two spheres, the force with
/// the other sign to the second; in the order of the lanes.
template <class T>
HWY_INLINE void add_pair_loads(SphereLoad<T>* loads, const std::int32_t* a, const std::int32_t* b,
                               Lane3<T> force, Lane3<T> moment) {
    const Lane<T> zero = hn::Zero(Tag<T>());
    Lane4<T> f{force.x, force.y, force.z, zero}, m{moment.x, moment.y, moment.z, zero};
    if constexpr (sizeof(T) == 4 && 1 < blocks<T>) {
        // A load of eight floats at once: blocks of force and moment side by side.
        const hn::FixedTag<T, 8> d;
        transpose(f.x, f.y, f.z, f.w);
        transpose(m.x, m.y, m.z, m.w);
        const auto signs = hn::Load(d, load_signs<T>);
        const auto add = [&](std::size_t lane, auto sum) HWY_ATTR {
            T* first = load_of(loads, a[lane]).force;
            hn::Store(hn::Add(hn::Load(d, first), sum), d, first);
            T* second = load_of(loads, b[lane]).force;
            hn::Store(hn::MulAdd(sum, signs, hn::Load(d, second)), d, second);
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
        const Block<T> d;
        const auto put = [&](std::size_t lane, std::size_t o, auto block) HWY_ATTR {
            T* first = load_of(loads, a[lane]).force + o;
            hn::StoreU(hn::Add(hn::LoadU(d, first), block), d, first);
            T* second = load_of(loads, b[lane]).force + o;
            const auto signs = hn::LoadU(d, load_signs<T> + o);
            hn::StoreU(hn::MulAdd(block, signs, hn::LoadU(d, second)), d, second);
        };
        rows<T>(f, 0, put);
        rows<T>(m, 4, put);
    }
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
