#include "core/random.hpp"

#include <cmath>

// Random123 is C89-style code from the system; its warnings are not ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

namespace grainfield::core {
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

// Coefficients as published in AS 241: a/b for |p - 0.5| <= 0.425, c/d and e/f for the tails.
constexpr double kA[8] = {3.3871328727963666080e0,  1.3314166789178437745e+2,
                          1.9715909503065514427e+3, 1.3731693765509461125e+4,
                          4.5921953931549871457e+4, 6.7265770927008700853e+4,
                          3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr double kB[8] = {1.0,
                          4.2313330701600911252e+1,
                          6.8718700749205790830e+2,
                          5.3941960214247511077e+3,
                          2.1213794301586595867e+4,
                          3.9307895800092710610e+4,
                          2.8729085735721942674e+4,
                          5.2264952788528545610e+3};
constexpr double kC[8] = {1.42343711074968357734e0,  4.63033784615654529590e0,
                          5.76949722146069140550e0,  3.64784832476320460504e0,
                          1.27045825245236838258e0,  2.41780725177450611770e-1,
                          2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr double kD[8] = {1.0,
                          2.05319162663775882187e0,
                          1.67638483018380384940e0,
                          6.89767334985100004550e-1,
                          1.48103976427480074590e-1,
                          1.51986665636164571966e-2,
                          5.47593808499534494600e-4,
                          1.05075007164441684324e-9};
constexpr double kE[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,
                          1.78482653991729133580e0,  2.96560571828504891230e-1,
                          2.65321895265761230930e-2, 1.24266094738807843860e-3,
                          2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr double kF[8] = {1.0,
                          5.99832206555887937690e-1,
                          1.36929880922735805310e-1,
                          1.48753612908506148525e-2,
                          7.86869131145613259100e-4,
                          1.84631831751005468180e-5,
                          1.42151175831644588870e-7,
                          2.04426310338993978564e-15};

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
    if (std::abs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(kA, r) / polynomial(kB, r);
    }
    // 1 - p is exact for p in (0.5, 1): the tails are as accurate on the right as on the left.
    const double r = std::sqrt(-std::log(q < 0.0 ? p : 1.0 - p));
    const double x = r <= 5.0 ? polynomial(kC, r - 1.6) / polynomial(kD, r - 1.6)
                              : polynomial(kE, r - 5.0) / polynomial(kF, r - 5.0);
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
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = normal(realization, first + i);
}

}  // namespace grainfield::core
