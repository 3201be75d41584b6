#pragma once
// Distributions of two parameters that strength and stiffness may follow, and their fits.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace grainfield::triaxial::statistics {

enum class Family { normal, lognormal, gamma, weibull };

constexpr std::array<Family, 4> all_families = {Family::normal, Family::lognormal, Family::gamma,
                                                Family::weibull};

/// "normal", "lognormal", "gamma", "Weibull".
std::string_view name(Family family);

/// True where the family has positive values only: all but the normal.
bool is_positive(Family family);

/// A distribution, and how well it explains the values it was fitted to.
struct Fit {
    Family family = Family::normal;

    /// normal: mean, deviation [as the values]; lognormal: mean, deviation of the logarithm [-];
    /// gamma: shape k [-], scale theta; Weibull: shape k [-], scale lambda [as the values].
    std::array<double, 2> parameters{0, 1};

    std::size_t fitted = 0;     ///< how many of the parameters were estimated from values [-]
    std::size_t count = 0;      ///< values it was fitted to [-]
    double log_likelihood = 0;  ///< sum of ln(density) over these values, 0 of none [-]

    /// Akaike's criterion 2 fitted - 2 log_likelihood: the lower, the better [-].
    double aic() const;

    /// Probability density [1/unit of the values]. Zero at and below zero for positive families.
    /// Like the next three it throws InputError where x is not finite.
    double pdf(double x) const;

    /// Logarithm of the density, where the density itself may be too small for a double.
    double log_pdf(double x) const;

    /// P(X <= x) [-].
    double cdf(double x) const;

    /// P(X > x) [-], to full relative accuracy where 1 - cdf(x) would have none.
    double exceedance(double x) const;

    /// The x of cdf(x) = p [as the values]. Throws InputError unless 0 < p < 1.
    double quantile(double p) const;

    double mean() const;       ///< [as the values]
    double deviation() const;  ///< [as the values]
};

/// Maximum-likelihood fit of two or more values. Throws InputError where there are fewer, all are
/// equal, one is not finite or, for a positive family, not above zero. Normal and lognormal in
/// closed form; gamma and Weibull by Newton's method on the likelihood's profile over the shape
/// (Johnson, Kotz & Balakrishnan 1994, vol. 1, sections 17.7.2 and 21.4.1).
Fit fit(Family family, std::span<const double> values);

/// The fits of all families, the lowest AIC first; positive families are left out where a value
/// is not above zero. Throws InputError as above.
std::vector<Fit> fits(std::span<const double> values);

/// The lognormal of a given mean and standard deviation, both above zero [one unit]:
/// sigma_ln^2 = ln(1 + (deviation/mean)^2), mu_ln = ln(mean) - sigma_ln^2/2. Nothing is fitted.
Fit lognormal_of(double mean, double deviation);

/// The lognormal of the sample's mean and standard deviation (over n - 1): the fit by moments.
/// Throws InputError as fit().
Fit lognormal_by_moments(std::span<const double> values);

}  // namespace grainfield::triaxial::statistics
