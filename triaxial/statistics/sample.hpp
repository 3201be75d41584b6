#pragma once
// What the statistics of this folder share: checks of a sample, its order, settings of resampling.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grainfield::triaxial::statistics {

/// A range that holds an unknown number with a stated confidence.
struct Interval {
    double lower = 0;  ///< [as what it bounds]
    double upper = 0;  ///< [as what it bounds]

    bool operator==(const Interval&) const = default;
};

/// How a sample is drawn again. The same numbers always give the same result.
struct Resampling {
    std::size_t resamples = 2'000;  ///< samples drawn, at least 100 [-]
    std::uint64_t seed = 1;         ///< of the streams `bootstrap`, `parametric_bootstrap` [-]

    /// Throws InputError that names the field, its value and what is allowed.
    void validate() const;
};

/// Throws InputError that names the first value that is NaN or infinite.
void require_finite(std::span<const double> values);

/// Throws InputError that names the first value that is not finite and above zero.
void require_positive(std::span<const double> values);

/// (1 - confidence)/2, what a two-sided interval leaves out on either side [-]. Throws InputError
/// unless 0 < confidence < 1.
double tail_of(double confidence);

/// The values in ascending order.
std::vector<double> sorted(std::span<const double> values);

/// Quantile at p in [0, 1] of one or more values in ascending order, linear between the k-th at
/// p = (k-1)/(n-1): definition 7 of Hyndman & Fan 1996 (American Statistician 50), as in NumPy.
double sample_quantile(std::span<const double> ascending, double p);

}  // namespace grainfield::triaxial::statistics
