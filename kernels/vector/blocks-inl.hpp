// Blocks of four numbers loaded into, transposed in and added from lanes.

#if defined(GRAINFIELD_BLOCKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_BLOCKS_INL
#undef GRAINFIELD_BLOCKS_INL
#else
#define GRAINFIELD_BLOCKS_INL
#endif

#include <array>

#include "kernels/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// Four numbers that follow each other in memory, in four vectors.
template <class T>
struct Lane4 {
    Lane<T> x, y, z, w;
    HWY_INLINE Lane3<T> xyz() const { return {x, y, z}; }
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
HWY_INLINE void transpose_square(Lane<T>*) {}  // of one

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
        const hn::Half<Tag<T> > half;
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
        const hn::Half<Tag<T> > half;
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
    const hn::Repartition<double, Tag<float> > g;
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
HWY_INLINE Lane4<T> load4(const std::array<const T*, lanes<T> >& at, std::size_t offset) {
    const Block<T> d;
    return gather4<T>([&](std::size_t lane, std::size_t o)
                          HWY_ATTR { return hn::LoadU(d, at[lane] + offset + o); });
}

/// Calls put(part, lane, offset, block) for every block of what is to be written or added: rows of
/// all parts before the next row.
template <class T, std::size_t Parts, class Put>
HWY_INLINE void rows(std::array<Lane4<T>, Parts> v, std::size_t offset, const Put& put) {
    const auto put_row = [&](std::size_t first, std::size_t o, const auto& row) HWY_ATTR {
        for (std::size_t p = 0; p < Parts; ++p)
            split<T>(row(p), [&](std::size_t q, auto block)
                                 HWY_ATTR { put(p, block_lanes<T> * q + first, o, block); });
    };
    if constexpr (sizeof(T) == 4) {
        for (Lane4<T>& part : v) transpose(part.x, part.y, part.z, part.w);
        put_row(0, offset, [&](std::size_t p) HWY_ATTR { return v[p].x; });
        put_row(1, offset, [&](std::size_t p) HWY_ATTR { return v[p].y; });
        put_row(2, offset, [&](std::size_t p) HWY_ATTR { return v[p].z; });
        put_row(3, offset, [&](std::size_t p) HWY_ATTR { return v[p].w; });
    } else {
        const Tag<T> d;
        const auto xy = [&](std::size_t p)
                            HWY_ATTR { return hn::InterleaveLower(d, v[p].x, v[p].y); };
        const auto xy_odd = [&](std::size_t p)
                                HWY_ATTR { return hn::InterleaveUpper(d, v[p].x, v[p].y); };
        const auto zw = [&](std::size_t p)
                            HWY_ATTR { return hn::InterleaveLower(d, v[p].z, v[p].w); };
        const auto zw_odd = [&](std::size_t p)
                                HWY_ATTR { return hn::InterleaveUpper(d, v[p].z, v[p].w); };
        put_row(0, offset, xy);
        put_row(1, offset, xy_odd);
        put_row(0, offset + 2, zw);
        put_row(1, offset + 2, zw_odd);
    }
}
/// Adds to the four numbers at at[l] + offset; no two lanes may point to the same place.
template <class T>
HWY_INLINE void add4(Lane4<T> v, const std::array<T*, lanes<T> >& at, std::size_t offset) {
    const Block<T> d;
    rows<T, 1>({v}, offset, [&](std::size_t, std::size_t lane, std::size_t o, auto block) HWY_ATTR {
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

#endif

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
