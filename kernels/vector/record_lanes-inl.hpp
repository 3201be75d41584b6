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

/// Contacts of a vector with what they add to the loads of their spheres.
template <class T>
struct LoadedPairs {
    const std::int32_t *a, *b;  ///< records
    Lane3<T> force, moment;     ///< on a; over the radius
};
/// Vectors that are added to loads together: as many as make one of the widest ones.
#if HWY_TARGET == HWY_SCALAR
template <class T>
inline constexpr std::size_t parts_of_load = 1;
#else
template <class T>
inline constexpr std::size_t parts_of_load = 64 / sizeof(T) / lanes<T>;
#endif

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
HWY_INLINE void add_pair_loads(SphereLoad<T>* loads,
                               const std::array<LoadedPairs<T>, parts_of_load<T>>& pairs) {
    const Lane<T> zero = hn::Zero(Tag<T>());
    const LoadedPairs<T>& p = pairs[0];
    T *la = load_of(loads, *p.a).force, *lb = load_of(loads, *p.b).force;
    const Lane3<T>&f = p.force, &m = p.moment;
    add4<T>({f.x, f.y, f.z, zero}, {la}, 0);
    add4<T>({m.x, m.y, m.z, zero}, {la}, 4);
    add4<T>({hn::Neg(f.x), hn::Neg(f.y), hn::Neg(f.z), zero}, {lb}, 0);
    add4<T>({m.x, m.y, m.z, zero}, {lb}, 4);
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

/// Adds force and moment of every contact to the loads of its two spheres, the force with the other
/// sign to the second. The order, in which spheres come that have several of the contacts, is that
/// of the widest vectors: rows of their blocks, one after the other. So it is the same for every
/// width, and spheres in neighbouring lanes, often the same ones, do not wait for each other.
template <class T>
HWY_INLINE void add_pair_loads(SphereLoad<T>* loads,
                               const std::array<LoadedPairs<T>, parts_of_load<T>>& pairs) {
    constexpr std::size_t parts = parts_of_load<T>;
    const Lane<T> zero = hn::Zero(Tag<T>());
    if constexpr (sizeof(T) == 4 && 1 < blocks<T>) {
        // A load of eight floats at once: blocks of force and moment side by side.
        const hn::FixedTag<T, 8> d;
        const auto signs = hn::Load(d, load_signs<T>);
        Lane<T> force[parts][4], moment[parts][4];
        for (std::size_t p = 0; p < parts; ++p) {
            const Lane3<T>&f = pairs[p].force, &m = pairs[p].moment;
            Lane<T>*fr = force[p], *mr = moment[p];
            fr[0] = f.x, fr[1] = f.y, fr[2] = f.z, fr[3] = zero;
            mr[0] = m.x, mr[1] = m.y, mr[2] = m.z, mr[3] = zero;
            transpose(fr[0], fr[1], fr[2], fr[3]);
            transpose(mr[0], mr[1], mr[2], mr[3]);
        }
        for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t p = 0; p < parts; ++p) {
                const auto add = [&](std::size_t lane, auto sum) HWY_ATTR {
                    T* first = load_of(loads, pairs[p].a[lane]).force;
                    hn::Store(hn::Add(hn::Load(d, first), sum), d, first);
                    T* second = load_of(loads, pairs[p].b[lane]).force;
                    hn::Store(hn::MulAdd(sum, signs, hn::Load(d, second)), d, second);
                };
                const auto f = force[p][r], m = moment[p][r];
                const auto even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(m), f);
                const auto odd = hn::OddEvenBlocks(m, hn::SwapAdjacentBlocks(f));
                if constexpr (blocks<T> == 2) {
                    add(r, even);
                    add(r + 4, odd);
                } else {
                    add(r, hn::LowerHalf(d, even));
                    add(r + 4, hn::LowerHalf(d, odd));
                    add(r + 8, hn::UpperHalf(d, even));
                    add(r + 12, hn::UpperHalf(d, odd));
                }
            }
    } else {
        const Block<T> d;
        for (const std::size_t o : {std::size_t{0}, std::size_t{4}}) {
            std::array<Lane4<T>, parts> v;
            for (std::size_t p = 0; p < parts; ++p) {
                const Lane3<T>& whole = o == 0 ? pairs[p].force : pairs[p].moment;
                v[p] = {whole.x, whole.y, whole.z, zero};
            }
            rows<T>(v, o,
                    [&](std::size_t p, std::size_t lane, std::size_t offset, auto block) HWY_ATTR {
                        T* first = load_of(loads, pairs[p].a[lane]).force + offset;
                        hn::StoreU(hn::Add(hn::LoadU(d, first), block), d, first);
                        T* second = load_of(loads, pairs[p].b[lane]).force + offset;
                        const auto signs = hn::LoadU(d, load_signs<T> + offset);
                        hn::StoreU(hn::MulAdd(block, signs, hn::LoadU(d, second)), d, second);
                    });
        }
    }
}

#endif

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
