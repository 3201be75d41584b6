#pragma once
// "did you mean": the known key that an unknown one was probably meant to be, or why there is none.

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace grainfield::triaxial {

/// The known dotted key with the fewest typing errors to `unknown`, or with the same last part in
/// another table; nullopt where none is near.
std::optional<std::string> nearest_key(std::string_view unknown,
                                       const std::set<std::string>& known);

/// "; ..." on a key that other programs have and this one does not; empty where nothing is known.
std::string_view absent_feature(std::string_view unknown);

}  // namespace grainfield::triaxial
