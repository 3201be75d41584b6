#pragma once
// Names as a reader sorts them: by their numbers where they differ in a number.

#include <string_view>

namespace grainfield::triaxial::report {

/// "theta=0.1" before "theta=1" before "theta=10"; "stress=50000" before "stress=1e6". A strict
/// order of all texts: those that read the same ("1", "1.0") stand in the order of their letters.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace grainfield::triaxial::report
