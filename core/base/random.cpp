#include "core/base/random.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/normal_quantile.hpp"
#include "core/base/parallel.hpp"
#include "core/base/vector_normals.hpp"

// Random123 is C89-style code from the system; its warnings are not ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

namespace grainfield::core {

using namespace as241;

namespace {

std::uint32_t low(std::uint64_t x) {
    return static_cast<std::uint32_t>(x);
}
std::uint32_t high(std::uint64_t x) {
    return static_cast<std::uint32_t>(x >> 32);
}

// 52 bits and a half: the centre of one of 2^52 equal intervals of (0, 1), exact in a double.
double open_uniform(std::uint32_t low_word, std::uint32_t high_word) {
    const std::uint64_t word = (static_cast<std::uint64_t>(high_word) << 32) | low_word;
    return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
}

// (c[0] + c[1] x + ... + c[7] x^7), Horner.
double polynomial(const double (&c)[8], double x) {
    double sum = c[7];
    for (int i = 6; i >= 0; --i) sum = sum * x + c[i];
    return sum;
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) noexcept {
    const philox4x32_ctr_t c = {{counter[0], counter[1], counter[2], counter[3]}};
    const philox4x32_key_t k = {{key[0], key[1]}};
    const philox4x32_ctr_t r = philox4x32_R(10, c, k);
    return {r.v[0], r.v[1], r.v[2], r.v[3]};
}

double normal_quantile(double p) noexcept {
    const double q = p - 0.5;
    if (std::abs(q) <= kCentre) {
        const double r = kCentre2 - q * q;
        return q * polynomial(kA, r) / polynomial(kB, r);
    }
    // 1 - p is exact for p in (0.5, 1): the tails are as accurate on the right as on the left.
    const double tail = q < 0.0 ? p : 1.0 - p;
    const double r = std::sqrt(-(tail >= 0x1p-1022 ? tail_log(tail) : std::log(tail)));
    const double x = r <= kTail ? polynomial(kC, r - kTailShift) / polynomial(kD, r - kTailShift)
                                : polynomial(kE, r - kTail) / polynomial(kF, r - kTail);
    return q < 0.0 ? -x : x;
}

RandomStream::RandomStream(std::uint64_t seed, Stream stream) noexcept
    // 56 bits of the seed and 8 of the stream fill the key; the seed's last byte is folded in.
    : key_{low(seed) ^ ((high(seed) >> 24) * 0x9E3779B9u),
           static_cast<std::uint32_t>(stream) | (high(seed) << 8)} {}

std::array<std::uint32_t, 4> RandomStream::bits(std::uint64_t realization,
                                                std::uint64_t index) const noexcept {
    return philox({low(index), high(index), low(realization), high(realization)}, key_);
}

double RandomStream::uniform(std::uint64_t realization, std::uint64_t index) const noexcept {
    const auto words = bits(realization, index);
    return open_uniform(words[0], words[1]);
}

std::array<double, 2> RandomStream::uniform_pair(std::uint64_t realization,
                                                 std::uint64_t index) const noexcept {
    const auto words = bits(realization, index);
    return {open_uniform(words[0], words[1]), open_uniform(words[2], words[3])};
}

double RandomStream::normal(std::uint64_t realization, std::uint64_t index) const noexcept {
    return normal_quantile(uniform(realization, index));
}

void RandomStream::normals(std::uint64_t realization, std::uint64_t first,
                           std::span<double> values) const noexcept {
    // Blocks that are worth a thread; each number is its own, whoever computes it.
    constexpr std::size_t block = 16384;
    for_many((values.size() + block - 1) / block, 2, [&](std::size_t b) {
        const std::size_t at = b * block;
        vector_normals(key_, realization, first + at,
                       values.subspan(at, std::min(block, values.size() - at)));
    });
}

}  // namespace grainfield::core
