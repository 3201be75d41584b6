#pragma once
// The distributions a property may have, each as the function of a standard normal score g that
// gives the property, and back. Parameters are those of MarginalOptions, in the property's unit.

#include "randomfield/marginals/marginal_options.hpp"

namespace grainfield::randomfield {

/// Values lie between these, the ends included only where a family's value() rounds to them.
struct Interval {
    double low = 0.0;   ///< [rad or Pa]
    double high = 0.0;  ///< [rad or Pa]
};

// Every family: value(g) grows with g and holds for any finite g; score() is its inverse, for
// values inside range(). All good to some 1e-15 relative to the spread, in both tails.

/// Eq. (7) of Tran et al., symmetric between minimum and maximum.
struct Bounded {
    explicit Bounded(const MarginalOptions& options);
    [[nodiscard]] double value(double g) const;
    [[nodiscard]] double score(double value) const;
    [[nodiscard]] Interval range() const { return {minimum, maximum}; }
    double minimum, maximum, s;
};

/// Eqs. (8)-(9) of Tran et al.
struct Lognormal {
    explicit Lognormal(const MarginalOptions& options);
    [[nodiscard]] double value(double g) const;
    [[nodiscard]] double score(double value) const;
    [[nodiscard]] Interval range() const;
    double sigma_ln, mu_ln;
};

struct Normal {
    explicit Normal(const MarginalOptions& options);
    [[nodiscard]] double value(double g) const { return mean + deviation * g; }
    [[nodiscard]] double score(double value) const { return (value - mean) / deviation; }
    [[nodiscard]] Interval range() const;
    double mean, deviation;
};

/// A normal distribution of the given mean and deviation, cut to [minimum, maximum]: its own mean
/// and deviation are others.
struct TruncatedNormal {
    explicit TruncatedNormal(const MarginalOptions& options);
    [[nodiscard]] double value(double g) const;
    [[nodiscard]] double score(double value) const;
    [[nodiscard]] Interval range() const { return {minimum, maximum}; }
    double mean, deviation, minimum, maximum;
    double below, above;  ///< probabilities that are cut off [-]
    double window;        ///< probability of [minimum, maximum] before the cut [-]
};

/// Beta distribution stretched to [minimum, maximum].
struct Beta {
    explicit Beta(const MarginalOptions& options);
    [[nodiscard]] double value(double g) const;
    [[nodiscard]] double score(double value) const;
    [[nodiscard]] Interval range() const { return {minimum, maximum}; }
    double minimum, maximum;
    double a, b;  ///< its two shapes [-]
};

/// Weibull distribution from 0 on, exp(-(x/scale)^shape) above x.
struct Weibull {
    static constexpr double least_cov = 1e-3, largest_cov = 100.0;  // [-]
    explicit Weibull(const MarginalOptions& options);
    [[nodiscard]] double value(double g) const;
    [[nodiscard]] double score(double value) const;
    [[nodiscard]] Interval range() const;
    double shape, scale;
};

/// Phi(g), the standard normal distribution; good in the lower tail [-].
double normal_cdf(double g);

}  // namespace grainfield::randomfield
