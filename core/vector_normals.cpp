#include "core/vector_normals.hpp"

#include <algorithm>
#include <cmath>

#include "core/normal_quantile.hpp"
#include "core/random.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/vector_normals.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grainfield::core::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace as241;

constexpr std::size_t kBlock = 256;  // numbers between the two passes

// Horner, product and sum rounded apart as in the plain code.
template <class V>
V polynomial(const double (&c)[8], V x) {
    const hn::DFromV<V> d;
    V sum = hn::Set(d, c[7]);
    for (int i = 6; i >= 0; --i) sum = hn::Add(hn::Mul(sum, x), hn::Set(d, c[i]));
    return sum;
}

// tail_log() of every lane.
template <class V>
V logarithm(V x) {
    const hn::DFromV<V> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    const hn::RebindToSigned<decltype(d)> di;
    const auto above = hn::Sub(hn::BitCast(du, x), hn::Set(du, kRootHalf));
    const auto m = hn::BitCast(
        d, hn::Add(hn::And(above, hn::Set(du, 0xFFFFFFFFFFFFFu)), hn::Set(du, kRootHalf)));
    // k in [-1022, 0] as a double: added to the last bits of 2^52 + 2^51.
    const auto k = hn::Sub(hn::BitCast(d, hn::Add(hn::ShiftRight<52>(hn::BitCast(di, above)),
                                                  hn::Set(di, std::int64_t{0x4338000000000000}))),
                           hn::Set(d, 0x1.8p52));
    const auto s = hn::Div(hn::Sub(m, hn::Set(d, 1.0)), hn::Add(m, hn::Set(d, 1.0)));
    const auto z = hn::Mul(s, s);
    auto sum = hn::Set(d, kArtanh[9]);
    for (int i = 8; i >= 0; --i) sum = hn::Add(hn::Mul(sum, z), hn::Set(d, kArtanh[i]));
    const auto twice = hn::Add(s, s);
    return hn::Add(hn::Mul(k, hn::Set(d, kLog2)), hn::Add(twice, hn::Mul(twice, hn::Mul(z, sum))));
}

// Uniforms in (0, 1) at the indices of one vector: Philox4x32-10 with a counter in each lane of 64
// bits. What the words carry above their 32 bits is never looked at.
template <class D, class U>
hn::Vec<D> uniforms(D d, U index, const std::array<std::uint32_t, 2>& key,
                    std::uint64_t realization) {
    const hn::RebindToUnsigned<D> du;
    const auto product = [&](auto a, std::uint64_t b) HWY_ATTR {
#if HWY_TARGET == HWY_SCALAR
        return hn::Set(du, (hn::GetLane(a) & 0xFFFFFFFFu) * b);
#else
        const hn::Repartition<std::uint32_t, decltype(du)> d32;
        return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, hn::Set(du, b)));
#endif
    };
    auto c0 = index, c1 = hn::ShiftRight<32>(index);
    auto c2 = hn::Set(du, realization), c3 = hn::Set(du, realization >> 32);
    std::uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; ++round) {
        const auto p0 = product(c0, 0xD2511F53u), p1 = product(c2, 0xCD9E8D57u);
        c0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(p1), c1), hn::Set(du, std::uint64_t{k0}));
        c2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(p0), c3), hn::Set(du, std::uint64_t{k1}));
        c1 = p1;
        c3 = p0;
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    // The upper 52 bits of c1 c0, and a half. As a double of exponent 52 they are 2^52 too much.
    const auto low = hn::And(c0, hn::Set(du, 0xFFFFFFFFu));
    const auto bits = hn::ShiftRight<12>(hn::Or(hn::ShiftLeft<32>(c1), low));
    const auto whole =
        hn::Sub(hn::BitCast(d, hn::Or(bits, hn::Set(du, 0x4330000000000000u))), hn::Set(d, 0x1p52));
    return hn::Mul(hn::Add(whole, hn::Set(d, 0.5)), hn::Set(d, 0x1p-52));
}

// Numbers of the tails, one in seven: their places, distances to the nearer end of (0, 1), signs.
struct Tails {
    std::size_t count = 0;
    std::size_t place[kBlock + HWY_MAX_BYTES / 8];
    double r[kBlock + HWY_MAX_BYTES / 8];  // magnitude of the normal
    double p[kBlock + HWY_MAX_BYTES / 8];
};

void normals(const std::array<std::uint32_t, 2>& key, std::uint64_t realization,
             std::uint64_t first, double* values, std::size_t size) {
    const hn::ScalableTag<double> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    constexpr std::size_t n = HWY_LANES(double);
    Tails tails;
    double uniform[kBlock + HWY_MAX_BYTES / 4];
    double end[kBlock + HWY_MAX_BYTES / 8];  // the last, incomplete block
    for (std::size_t from = 0; from < size; from += kBlock) {
        const std::size_t count = std::min(kBlock, size - from);
        double* const value = count == kBlock ? values + from : end;
        tails.count = 0;
        // Apart from what follows: two long chains of operations in one loop would not overlap.
        for (std::size_t i = 0; i < count; i += 2 * n) {
            const auto index = hn::Iota(du, first + from + i);
            const auto p0 = uniforms(d, index, key, realization);
            const auto p1 = uniforms(d, hn::Add(index, hn::Set(du, n)), key, realization);
            hn::StoreU(p0, d, uniform + i);
            hn::StoreU(p1, d, uniform + i + n);
        }
        for (std::size_t i = 0; i < count; i += n) {
            const auto p = hn::LoadU(d, uniform + i);
            const auto q = hn::Sub(p, hn::Set(d, 0.5));
            const auto r = hn::Sub(hn::Set(d, kCentre2), hn::Mul(q, q));
            hn::StoreU(hn::Div(hn::Mul(q, polynomial(kA, r)), polynomial(kB, r)), d, value + i);
        }
        for (std::size_t i = 0; i < count; ++i) {  // without a branch: it would be mispredicted
            tails.place[tails.count] = i;
            tails.p[tails.count] = uniform[i];
            tails.count += std::abs(uniform[i] - 0.5) > kCentre ? 1 : 0;
        }
        // What the last vector holds beyond the count is some normal number or none, and not used.
        for (std::size_t t = 0; t < tails.count; t += n) {
            const auto p = hn::LoadU(d, tails.p + t);
            const auto r = hn::Sqrt(hn::Neg(logarithm(hn::Min(p, hn::Sub(hn::Set(d, 1.0), p)))));
            const auto x = hn::Sub(r, hn::Set(d, kTailShift));
            hn::StoreU(hn::Div(polynomial(kC, x), polynomial(kD, x)), d, tails.r + t);
        }
        for (std::size_t t = 0; t < tails.count; ++t) {
            const double p = tails.p[t];
            // The far tails, one in 1e10, by the plain code.
            const bool far = std::min(p, 1.0 - p) < 2e-11;
            value[tails.place[t]] = far ? normal_quantile(p) : p < 0.5 ? -tails.r[t] : tails.r[t];
        }
        if (value == end) std::copy_n(end, count, values + from);
    }
}

}  // namespace grainfield::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainfield::core {

HWY_EXPORT(normals);

void vector_normals(const std::array<std::uint32_t, 2>& key, std::uint64_t realization,
                    std::uint64_t first, std::span<double> values) noexcept {
    HWY_DYNAMIC_DISPATCH(normals)(key, realization, first, values.data(), values.size());
}

}  // namespace grainfield::core
#endif
