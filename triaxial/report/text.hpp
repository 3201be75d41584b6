#pragma once
// Numbers and text as the page prints them.

#include <cstddef>
#include <string>
#include <string_view>

namespace grainfield::triaxial::report {

/// `value` rounded to so many significant digits, never in exponent form between 1e-4 and 1e7.
std::string significant(double value, int digits = 4);
/// A count with commas: 151,632.
std::string count(double value);
/// A duration: "0.8 s", "4 min 12 s", "1 h 05 min".
std::string duration(double seconds);
/// How many characters a text in UTF-8 has [-].
std::size_t characters(std::string_view text);
/// Text of `most` characters at most: of a longer one the beginning and the end, "…" between.
std::string shortened(std::string_view text, std::size_t most);
/// Text with &, <, > and quotes made safe for HTML.
std::string escape(std::string_view text);
/// RFC 4648 base64 with padding.
std::string base64(std::string_view bytes);

}  // namespace grainfield::triaxial::report
