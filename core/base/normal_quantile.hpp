#pragma once
// Wichura's PPND16: the coefficients that the plain and the vector code share, and those of the
// logarithm in its tails.

#include <bit>
#include <cstdint>

namespace grainfield::core::as241 {

// Coefficients as published in AS 241: a/b for |p - 0.5| <= 0.425, c/d and e/f for the tails.
inline constexpr double kA[8] = {3.3871328727963666080e0,  1.3314166789178437745e+2,
                                 1.9715909503065514427e+3, 1.3731693765509461125e+4,
                                 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                 3.3430575583588128105e+4, 2.5090809287301226727e+3};
inline constexpr double kB[8] = {1.0,
                                 4.2313330701600911252e+1,
                                 6.8718700749205790830e+2,
                                 5.3941960214247511077e+3,
                                 2.1213794301586595867e+4,
                                 3.9307895800092710610e+4,
                                 2.8729085735721942674e+4,
                                 5.2264952788528545610e+3};
inline constexpr double kC[8] = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                 5.76949722146069140550e0,  3.64784832476320460504e0,
                                 1.27045825245236838258e0,  2.41780725177450611770e-1,
                                 2.27238449892691845833e-2, 7.74545014278341407640e-4};
inline constexpr double kD[8] = {1.0,
                                 2.05319162663775882187e0,
                                 1.67638483018380384940e0,
                                 6.89767334985100004550e-1,
                                 1.48103976427480074590e-1,
                                 1.51986665636164571966e-2,
                                 5.47593808499534494600e-4,
                                 1.05075007164441684324e-9};
inline constexpr double kE[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                 1.78482653991729133580e0,  2.96560571828504891230e-1,
                                 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                 2.71155556874348757815e-5, 2.01033439929228813265e-7};
inline constexpr double kF[8] = {1.0,
                                 5.99832206555887937690e-1,
                                 1.36929880922735805310e-1,
                                 1.48753612908506148525e-2,
                                 7.86869131145613259100e-4,
                                 1.84631831751005468180e-5,
                                 1.42151175831644588870e-7,
                                 2.04426310338993978564e-15};
inline constexpr double kCentre = 0.425;      // |p - 0.5| up to here by a/b
inline constexpr double kCentre2 = 0.180625;  // its square
inline constexpr double kTail = 5.0;          // sqrt(-log p) up to here by c/d, beyond by e/f
inline constexpr double kTailShift = 1.6;

// log x = k log 2 + 2 artanh s, x = 2^k m, s = (m - 1)/(m + 1), m in [1/sqrt 2, sqrt 2): the series
//   artanh s = s (1 + z/3 + z^2/5 + ...), z = s^2 <= 0.0295,
// to z^10 (the next term is below 2e-18). Our own, for the same bits in plain and in vector code;
// good to 2 ulp for the tails' x < 0.075, where nothing cancels.
inline constexpr double kArtanh[10] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                       1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
inline constexpr double kLog2 = 0.693147180559945309417;
inline constexpr std::uint64_t kRootHalf = 0x3FE6A09E667F3BCDu;  // bits of sqrt(1/2)

/// log x of a normal number; every operation rounded on its own.
inline double tail_log(double x) {
    const auto above = std::bit_cast<std::uint64_t>(x) - kRootHalf;  // k 2^52 and more
    const auto k = static_cast<std::int64_t>(above) >> 52;
    const auto m = std::bit_cast<double>((above & 0xFFFFFFFFFFFFFu) + kRootHalf);
    const double s = (m - 1.0) / (m + 1.0), z = s * s;
    double sum = kArtanh[9];
    for (int i = 8; i >= 0; --i) sum = sum * z + kArtanh[i];
    const double twice = s + s;
    return static_cast<double>(k) * kLog2 + (twice + twice * (z * sum));
}

}  // namespace grainfield::core::as241
