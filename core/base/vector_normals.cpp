#include "core/base/vector_normals.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/normal_quantile.hpp"
#include "core/base/random.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/base/vector_normals.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grainfield::core::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace as241;

constexpr std::size_t kBlock = 512;  // numbers between the passes
constexpr std::size_t kAbreast = 4;  // vectors of random bits drawn together

// Numerator and denominator at `width` vectors x: Horner, product and sum rounded apart as in the
// plain code. All abreast, because each waits for itself at every step.
template <std::size_t width, class V>
HWY_INLINE void polynomials(const double (&above)[8], const double (&below)[8], const V (&x)[width],
                            V (&numerator)[width], V (&denominator)[width]) {
    const hn::DFromV<V> d;
    for (std::size_t v = 0; v < width; ++v) {
        numerator[v] = hn::Set(d, above[7]);
        denominator[v] = hn::Set(d, below[7]);
    }
    for (int i = 6; i >= 0; --i) {
        for (std::size_t v = 0; v < width; ++v) {
            numerator[v] = hn::Add(hn::Mul(numerator[v], x[v]), hn::Set(d, above[i]));
            denominator[v] = hn::Add(hn::Mul(denominator[v], x[v]), hn::Set(d, below[i]));
        }
    }
}

// tail_log() of every lane of `width` vectors.
template <std::size_t width, class V>
HWY_INLINE void logarithms(V (&x)[width]) {
    const hn::DFromV<V> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    const hn::RebindToSigned<decltype(d)> di;
    V k[width], s[width], z[width], sum[width];
    for (std::size_t v = 0; v < width; ++v) {
        const auto above = hn::Sub(hn::BitCast(du, x[v]), hn::Set(du, kRootHalf));
        const auto m = hn::BitCast(
            d, hn::Add(hn::And(above, hn::Set(du, 0xFFFFFFFFFFFFFu)), hn::Set(du, kRootHalf)));
        // k in [-1022, 0] as a double: added to the last bits of 2^52 + 2^51.
        k[v] = hn::Sub(hn::BitCast(d, hn::Add(hn::ShiftRight<52>(hn::BitCast(di, above)),
                                              hn::Set(di, std::int64_t{0x4338000000000000}))),
                       hn::Set(d, 0x1.8p52));
        s[v] = hn::Div(hn::Sub(m, hn::Set(d, 1.0)), hn::Add(m, hn::Set(d, 1.0)));
        z[v] = hn::Mul(s[v], s[v]);
        sum[v] = hn::Set(d, kArtanh[9]);
    }
    for (int i = 8; i >= 0; --i) {
        for (std::size_t v = 0; v < width; ++v) {
            sum[v] = hn::Add(hn::Mul(sum[v], z[v]), hn::Set(d, kArtanh[i]));
        }
    }
    for (std::size_t v = 0; v < width; ++v) {
        const auto twice = hn::Add(s[v], s[v]);
        x[v] = hn::Add(hn::Mul(k[v], hn::Set(d, kLog2)),
                       hn::Add(twice, hn::Mul(twice, hn::Mul(z[v], sum[v]))));
    }
}

// The 32 bits of every lane of 64, times a number of 32 bits.
template <class V>
V product(V a, std::uint64_t b) {
    const hn::DFromV<V> du;
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(du, (hn::GetLane(a) & 0xFFFFFFFFu) * b);
#else
    const hn::Repartition<std::uint32_t, decltype(du)> d32;
    return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, hn::Set(du, b)));
#endif
}

// Philox4x32-10 under counters of which the upper word of the index and the realization are the
// same in all lanes. So is half of what the first two rounds compute: it is computed once.
class Philox {
  public:
    Philox(const std::array<std::uint32_t, 2>& key, std::uint64_t realization,
           std::uint32_t index_high) {
        for (std::size_t round = 0; round < 10; ++round) {
            k0_[round] = key[0] + static_cast<std::uint32_t>(round) * 0x9E3779B9u;
            k1_[round] = key[1] + static_cast<std::uint32_t>(round) * 0xBB67AE85u;
        }
        const std::uint64_t first = (realization & 0xFFFFFFFFu) * kM1;
        const std::uint64_t second = ((first >> 32) ^ index_high ^ k0_[0]) * kM0;
        k1_[0] ^= realization >> 32;  // c3 of the first round
        c1_ = first;                  // of the second round
        k1_[1] ^= second >> 32;
        c3_ = second;  // of the third round
    }

    // Uniforms in (0, 1) at `kAbreast` vectors of indices from the one on whose lower word is
    // given. Round by round: a chain of ten rounds is long, and the next would begin too late to
    // overlap.
    template <class D>
    HWY_INLINE void uniforms(D d, std::uint64_t index_low, double* to) const {
        const hn::RebindToUnsigned<D> du;
        using U = hn::Vec<decltype(du)>;
        const auto set = [du](std::uint64_t x) HWY_ATTR { return hn::Set(du, x); };
        // What the words carry above their 32 bits is never looked at.
        U c0[kAbreast], c1[kAbreast], c2[kAbreast], c3[kAbreast];
        for (std::size_t v = 0; v < kAbreast; ++v) {
            const auto p = product(hn::Iota(du, index_low + v * hn::Lanes(d)), kM0);
            c2[v] = hn::Xor(p, set(k1_[1]));
            c1[v] = product(hn::Xor(hn::ShiftRight<32>(p), set(k1_[0])), kM1);
            c0[v] = hn::Xor(hn::ShiftRight<32>(c1[v]), set(c1_ ^ k0_[1]));
            c3[v] = set(c3_);
        }
        for (std::size_t round = 2; round < 10; ++round) {
            for (std::size_t v = 0; v < kAbreast; ++v) {
                const auto p0 = product(c0[v], kM0), p1 = product(c2[v], kM1);
                c0[v] = hn::Xor3(hn::ShiftRight<32>(p1), c1[v], set(k0_[round]));
                c2[v] = hn::Xor3(hn::ShiftRight<32>(p0), c3[v], set(k1_[round]));
                c1[v] = p1;
                c3[v] = p0;
            }
        }
        for (std::size_t v = 0; v < kAbreast; ++v) {
            // The upper 52 bits of c1 c0, and a half. As a double of exponent 52 they are 2^52 too
            // much.
            const auto low = hn::And(c0[v], set(0xFFFFFFFFu));
            const auto bits = hn::ShiftRight<12>(hn::Or(hn::ShiftLeft<32>(c1[v]), low));
            const auto whole =
                hn::Sub(hn::BitCast(d, hn::Or(bits, set(0x4330000000000000u))), hn::Set(d, 0x1p52));
            hn::StoreU(hn::Mul(hn::Add(whole, hn::Set(d, 0.5)), hn::Set(d, 0x1p-52)), d,
                       to + v * hn::Lanes(d));
        }
    }

  private:
    static constexpr std::uint64_t kM0 = 0xD2511F53u, kM1 = 0xCD9E8D57u;
    std::uint64_t k0_[10], k1_[10], c1_, c3_;
};

// Numbers of the tails, one in seven: where they stand, their uniforms, then the normals.
struct Tails {
    std::size_t count = 0;
    std::uint16_t place[kBlock];
    double p[kBlock + HWY_MAX_BYTES / 4];
    double normal[kBlock + HWY_MAX_BYTES / 4];
};

// Normals at `count` indices, as many as kBlock; `value` has room for whole vectors.
void block_of_normals(const Philox& philox, std::uint64_t first, std::size_t count, double* value) {
    const hn::ScalableTag<double> d;
    using V = hn::Vec<decltype(d)>;
    constexpr std::size_t n = HWY_LANES(double);
    double uniform[kBlock + kAbreast * HWY_MAX_BYTES / 8];
    std::uint64_t outside[kBlock / 64] = {};  // a bit for each number of the tails
    Tails tails;
    for (std::size_t i = 0; i < count; i += kAbreast * n) {
        philox.uniforms(d, first + i, uniform + i);
    }
    for (std::size_t i = 0; i < count; i += 2 * n) {
        const V p[2] = {hn::LoadU(d, uniform + i), hn::LoadU(d, uniform + i + n)};
        V q[2], r[2], numerator[2], denominator[2];
        for (std::size_t v = 0; v < 2; ++v) {
            q[v] = hn::Sub(p[v], hn::Set(d, 0.5));
            r[v] = hn::Sub(hn::Set(d, kCentre2), hn::Mul(q[v], q[v]));
        }
        polynomials(kA, kB, r, numerator, denominator);
        for (std::size_t v = 0; v < 2; ++v) {
            hn::StoreU(hn::Div(hn::Mul(q[v], numerator[v]), denominator[v]), d, value + i + v * n);
            std::uint8_t lanes[8] = {};
            hn::StoreMaskBits(d, hn::Gt(hn::Abs(q[v]), hn::Set(d, kCentre)), lanes);
            outside[i / 64] |= std::uint64_t{lanes[0]} << (i % 64 + v * n);
        }
    }
    for (std::size_t word = 0; word < kBlock / 64; ++word) {
        for (std::uint64_t bits = outside[word]; bits != 0; bits &= bits - 1) {
            const std::size_t i = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
            tails.place[tails.count] = static_cast<std::uint16_t>(i);
            tails.p[tails.count++] = uniform[i];
        }
    }
    // What the last vectors hold beyond the count is some number, and not used.
    for (std::size_t t = 0; t < tails.count; t += 2 * n) {
        V p[2], x[2], numerator[2], denominator[2];
        for (std::size_t v = 0; v < 2; ++v) {
            p[v] = hn::LoadU(d, tails.p + t + v * n);
            x[v] = hn::Min(p[v], hn::Sub(hn::Set(d, 1.0), p[v]));
        }
        logarithms(x);
        for (V& r : x) r = hn::Sub(hn::Sqrt(hn::Neg(r)), hn::Set(d, kTailShift));
        polynomials(kC, kD, x, numerator, denominator);
        for (std::size_t v = 0; v < 2; ++v) {
            const V sign = hn::Sub(p[v], hn::Set(d, 0.5));
            hn::StoreU(hn::CopySign(hn::Div(numerator[v], denominator[v]), sign), d,
                       tails.normal + t + v * n);
        }
    }
    for (std::size_t t = 0; t < tails.count; ++t) {
        if (tails.place[t] >= count) break;  // of the last vector, beyond the end
        const double p = tails.p[t];
        // The far tails, one in 1e10, by the plain code.
        const bool far = std::min(p, 1.0 - p) < 2e-11;
        value[tails.place[t]] = far ? normal_quantile(p) : tails.normal[t];
    }
}

void normals(const std::array<std::uint32_t, 2>& key, std::uint64_t realization,
             std::uint64_t first, double* values, std::size_t size) {
    double end[kBlock + HWY_MAX_BYTES / 4];  // the last, incomplete block
    while (size > 0) {
        // Up to where the upper word of the index changes.
        const std::uint64_t same = 0x100000000u - (first & 0xFFFFFFFFu);
        std::size_t left = static_cast<std::size_t>(std::min<std::uint64_t>(size, same));
        const Philox philox(key, realization, static_cast<std::uint32_t>(first >> 32));
        for (; left >= kBlock; left -= kBlock) {
            block_of_normals(philox, first, kBlock, values);
            first += kBlock;
            values += kBlock;
            size -= kBlock;
        }
        if (left == 0) continue;
        block_of_normals(philox, first, left, end);
        std::copy_n(end, left, values);
        first += left;
        values += left;
        size -= left;
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
