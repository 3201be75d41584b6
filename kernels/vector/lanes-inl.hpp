// Lanes: vectors of three components. Compiled once a target (Highway).

#if defined(GRAINFIELD_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_LANES_INL
#undef GRAINFIELD_LANES_INL
#else
#define GRAINFIELD_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

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

/// A bit for every lane that is set.
template <class T>
HWY_INLINE std::uint32_t bits_of(LaneMask<T> mask) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag<T>(), mask, bytes);
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
