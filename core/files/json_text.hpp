#pragma once
// JSON as text on one line.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace grainfield::core {

/// What is not UTF-8 is replaced: paths may be in any encoding, and that is no reason to lose what
/// else there is to write.
std::string json_text(const nlohmann::json& json);

}  // namespace grainfield::core
