#pragma once
// Starts of repeated tests: the same sample with its spheres shifted by next to nothing. What the
// results scatter by is chaos, which a single test cannot tell.

#include <cstdint>

#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial {

/// Starts differ by no more than this along each axis [m].
inline constexpr double start_spread = 1e-12;

/// The sample of one repeat: every coordinate is off by a uniform random of at most half of
/// start_spread, a function of (seed, repeat, sphere). Repeat 0 is the sample as it is.
Sample start_of_repeat(Sample sample, std::uint64_t seed, std::int32_t repeat);

}  // namespace grainfield::triaxial
