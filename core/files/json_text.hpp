#pragma once
// JSON as text on one line.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace grainfield::core {

/// What is not UTF-8 is replaced: paths may be in any encoding, and that is no reason to lose what
/// else there is to write.
std::string json_text(const nlohmann::json& json);

/// A path or any other bytes as JSON: a text where they are UTF-8, else numbers; and back.
nlohmann::json json_of_bytes(const std::string& bytes);
std::string bytes_of_json(const nlohmann::json& json);

/// Levels that a JSON document may be nested, at most [-].
inline constexpr int most_json_levels = 100;
/// True where a text, read as JSON, is nested deeper: parsers and what goes through their values
/// call themselves level by level.
bool nested_too_deep(std::string_view text);

}  // namespace grainfield::core
