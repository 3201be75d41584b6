#include "kernels/vector/near_points.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/vector/near_points.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::size_t find_near(const PointColumns& points, std::size_t begin, std::size_t end, float x,
                      float y, float z, float radius, float margin, std::int32_t* found) {
    const hn::ScalableTag<float> d;
    constexpr std::size_t n = HWY_LANES(float);
    const auto x0 = hn::Set(d, x), y0 = hn::Set(d, y), z0 = hn::Set(d, z);
    const auto reach0 = hn::Set(d, radius + margin);
    std::size_t count = 0;
    for (std::size_t m = begin; m < end; m += n) {
        const auto dx = hn::Sub(hn::LoadU(d, points.x + m), x0);
        const auto dy = hn::Sub(hn::LoadU(d, points.y + m), y0);
        const auto dz = hn::Sub(hn::LoadU(d, points.z + m), z0);
        const auto reach = hn::Add(hn::LoadU(d, points.radius + m), reach0);
        const auto distance2 = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const auto near = hn::Lt(distance2, hn::Mul(reach, reach));
        alignas(8) std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, near, bytes);
        std::uint32_t bits =
            static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
        if (end - m < n) bits &= (1u << (end - m)) - 1u;
        for (; bits != 0; bits &= bits - 1)
            found[count++] = static_cast<std::int32_t>(m) + __builtin_ctz(bits);
    }
    return count;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainfield::kernels {

HWY_EXPORT(find_near);

std::size_t find_near(const PointColumns& points, std::size_t begin, std::size_t end, float x,
                      float y, float z, float radius, float margin, std::int32_t* found) {
    return HWY_DYNAMIC_DISPATCH(find_near)(points, begin, end, x, y, z, radius, margin, found);
}

}  // namespace grainfield::kernels
#endif
