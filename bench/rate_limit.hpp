#pragma once
// The value that a result tends to as the test becomes endlessly slow, from tests at several rates
// and dampings.

#include <span>
#include <vector>

namespace grainfield::bench {

/// Mean of `runs` tests that differ in their start positions alone.
struct RatePoint {
    int damping = 0;   ///< which of the dampings
    double rate = 0;   ///< axial strain rate [1/s]
    double value = 0;  ///< [as the result]
    int runs = 1;
};

/// What is taken of a damping: value = limit + slope rate^exponent.
struct RateLaw {
    double slope = 0;     ///< at 1/s [as the result]
    double exponent = 1;  ///< [-]
};

struct RateLimit {
    double value = 0;           ///< [as the result]
    double low = 0, high = 0;   ///< 95 % interval [as the result]
    double misfit = 0;          ///< chi-square over the degrees of freedom [-]
    std::vector<RateLaw> laws;  ///< of each damping
    /// The fastest rate up to which the law of a damping stays within a share of the limit [1/s];
    /// infinite where it has no slope.
    double rate_within(std::size_t damping, double share) const;
};

/// One limit for all dampings, since an endlessly slow test has nothing to damp; a power of the
/// rate of its own, of either sign, for each damping. Least squares over all points, `deviation`
/// [as the result] being that of one run; the interval is that of the profile likelihood, widened
/// by the misfit where that is above 1. Exponents are looked for in [0.3, 1.2]: rates in this range
/// have a say on the limit, others would be a constant or nothing at the slowest tests; limits from
/// 0.3 times the least value to 1.3 times the largest. Three points of different rates a damping
/// are needed. std::invalid_argument where the deviation is not above 0.
RateLimit rate_limit(std::span<const RatePoint> points, std::size_t dampings, double deviation);

}  // namespace grainfield::bench
