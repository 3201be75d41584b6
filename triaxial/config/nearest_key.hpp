#pragma once
// "did you mean": the known key that an unknown one was probably meant to be.

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace grainfield::triaxial {

/// The known dotted key with the fewest typing errors to `unknown`, or with the same last part in
/// another table; nullopt where none is near.
std::optional<std::string> nearest_key(std::string_view unknown,
                                       const std::set<std::string>& known);

}  // namespace grainfield::triaxial
