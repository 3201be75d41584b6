#pragma once
// Values as TOML text: for the resolved config (exact) and for error messages (short). toml++
// writes numbers for machines: 900000000.0 where this writes 9e8.

#include <string>
#include <string_view>

#include "triaxial/config/toml_file.hpp"

namespace grainfield::triaxial {

/// A TOML basic string with quotes, special characters escaped.
std::string toml_string(std::string_view text);

/// Fewest digits that read back as the same double; 9e8 rather than 900000000.
std::string number_text(double value);

/// The value as TOML on one line; reading it gives the same value back. Dates become "a date".
std::string toml_text(const toml::node& value);

/// The same for messages: long values are cut, with "..." at the end.
std::string short_text(const toml::node& value);

/// One part of a dotted key, quoted where TOML needs it.
std::string key_text(std::string_view key);

}  // namespace grainfield::triaxial
