#pragma once
// Ticks of an axis that are chosen here instead of by gnuplot: where a margin must have room for
// their labels, and where they must be whole numbers.

#include <cstddef>

namespace grainfield::triaxial::report {

/// The least of 1, 2, 5 and their decades that cuts `span` into so many intervals or fewer. `span`
/// must be positive.
double round_step(double span, int intervals);

/// Characters of the widest label between these ends, as gnuplot prints the multiples of `step`
/// (%g) [-].
std::size_t widest_label(double low, double high, double step);

}  // namespace grainfield::triaxial::report
