// Records of spheres loaded into and stored from lanes, and loads of contacts added to them.

#if defined(GRAINFIELD_RECORD_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_RECORD_LANES_INL
#undef GRAINFIELD_RECORD_LANES_INL
#else
#define GRAINFIELD_RECORD_LANES_INL
#endif

#include <array>
#include <cstdint>

#include "kernels/vector/blocks-inl.hpp"
#include "kernels/vector/records.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// The two records of each lane made one, component by component as in SphereRecord: b - a for u
/// and v, a + b for all else. Where asked for, the friction is the smaller of the two.
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

#if HWY_TARGET == HWY_SCALAR

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

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
