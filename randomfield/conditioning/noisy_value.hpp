#pragma once
// What a measured value with an error says of the Gaussian field behind it.

#include <optional>

#include "randomfield/marginals/marginals.hpp"

namespace grainfield::randomfield {

/// A measurement value = T(G) + error e, e standard normal and T the marginal of its cell.
struct NoisyValue {
    const Marginal* marginal = nullptr;
    double value = 0.0;  ///< inside the marginal's range or not [rad or Pa]
    double error = 0.0;  ///< standard deviation, above 0 [rad or Pa]
};

/// Mean and variance of G [-].
struct GaussianMoments {
    double mean = 0.0;
    double variance = 1.0;
};

/// Mean and variance of G given the measurement, where without it G is normal with the moments
/// `before`: by quadrature of the density, relative to the deviation good to 1e-12 (1e-6 where the
/// error is at its least). Empty where the density is zero in double precision wherever one looks,
/// below exp(-700) times what it is where value and prior agree.
std::optional<GaussianMoments> moments_given(const NoisyValue& measured,
                                             const GaussianMoments& before);

/// The least error that double precision tells from none: 1e-9 of a unit of the score (of the score
/// itself in the tails), and 1e-12 of the value [rad or Pa].
double least_error(const Marginal& marginal, double value);

/// What is known of G in one cell as if it had been measured directly: the density of the
/// measurement is replaced by exp(weighted g - precision g^2 / 2).
struct GaussianSite {
    double precision = 0.0;  ///< [-]
    double weighted = 0.0;   ///< precision times the score measured [-]
};

/// The site that turns a normal prior `before` into a normal distribution with the moments `after`.
/// Where those are wider than `before` (a heavy tail takes over from the middle) no direct
/// measurement does that: then the mean is met, and the variance stays, but for 1e-10 of it, that
/// of `before`. The same where the measurement says nothing.
GaussianSite site_between(const GaussianMoments& before, const GaussianMoments& after);

}  // namespace grainfield::randomfield
