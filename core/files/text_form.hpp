#pragma once
// Why a text is not the table that it should be: its separator, its line ends, the form of its
// numbers. For messages; nothing is read by guess.

#include <string>
#include <string_view>

namespace grainfield::core {

/// What is foreign in the form of a table whose first line of content is `header`: its encoding,
/// line ends, separator, quotes. Empty where nothing is; `separator` is what should stand there.
std::string foreign_form(std::string_view text, std::string_view header, char separator = ',');

/// Names of a header in any of the forms that foreign_form() knows, in lower case and without
/// quotes: `x;y;"Radius"` has "radius".
bool names_column(std::string_view header, std::string_view name);

/// Why this text is no number though it looks like one: a decimal comma, an exponent D, quotes.
/// "; ..." to append to a message, empty where nothing is known.
std::string foreign_number(std::string_view field);

/// "NAME = FIELD: ALLOWED" of a value that is not as it must be, with what foreign_number() says.
std::string bad_value(std::string_view name, std::string_view field, std::string_view allowed);

/// As foreign_number(), for a row that has too many fields because its decimals are commas.
std::string foreign_row(std::string_view row, std::size_t expected);

}  // namespace grainfield::core
