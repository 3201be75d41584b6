#include "triaxial/config/toml_text.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace grainfield::triaxial {
namespace {

std::string shortest(double value, std::chars_format format) {
    char buffer[400];  // -1.7976931348623157e308 in fixed notation has 310 characters
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format).ptr;
    return {buffer, end};
}

/// 9e+08 -> 9e8, 1e-05 -> 1e-5: as people write it.
std::string without_padding(std::string scientific) {
    const auto e = scientific.find('e');
    std::string exponent = scientific.substr(e + 1);
    const bool negative = exponent[0] == '-';
    exponent.erase(0, 1);
    exponent.erase(0, std::min(exponent.find_first_not_of('0'), exponent.size() - 1));
    return scientific.substr(0, e + 1) + (negative ? "-" : "") + exponent;
}

}  // namespace

std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            (result += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
            result += c;
    }
    return result + '"';
}

std::string number_text(double value) {
    if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
    if (value == 0 && std::signbit(value)) return "-0.0";  // "-0" would come back as the integer 0
    const std::string fixed = shortest(value, std::chars_format::fixed);
    constexpr std::size_t readable =
        6;  // 100000, 0.0001: no exponent for the sake of one character
    if (fixed.size() <= readable) return fixed;
    const std::string scientific = without_padding(shortest(value, std::chars_format::scientific));
    // Large whole numbers would read as integers, which end at 2^63.
    constexpr double largest_whole = 9007199254740992.0;  // 2^53
    const bool too_large = std::abs(value) >= largest_whole;
    return too_large || scientific.size() < fixed.size() ? scientific : fixed;
}

std::string toml_text(const toml::node& value) {
    std::string text;
    if (const toml::table* table = value.as_table()) {
        for (const auto& [key, entry] : *table)
            text += fmt::format("{} {} = {}", text.empty() ? "" : ",", key_text(key.str()),
                                toml_text(entry));
        return "{" + text + (text.empty() ? "}" : " }");
    }
    if (const toml::array* array = value.as_array()) {
        for (const toml::node& element : *array)
            text += (text.empty() ? "" : ", ") + toml_text(element);
        return "[" + text + "]";
    }
    if (const auto* truth = value.as_boolean()) return truth->get() ? "true" : "false";
    if (const auto* whole = value.as_integer()) return fmt::format("{}", whole->get());
    if (const auto* number = value.as_floating_point()) return number_text(number->get());
    if (const auto* string = value.as_string()) return toml_string(string->get());
    return "a date";
}

std::string short_text(const toml::node& value) {
    constexpr std::size_t longest = 80;
    std::string text = toml_text(value);
    if (text.size() <= longest) return text;
    std::size_t end = longest - 3;
    // Not in the middle of a UTF-8 character.
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return text.substr(0, end) + "...";
}

std::string key_text(std::string_view key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    return bare ? std::string(key) : toml_string(key);
}

}  // namespace grainfield::triaxial
