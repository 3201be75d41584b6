#include "core/files/text_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

constexpr std::string_view separators = ",;\t|: ";
constexpr std::string_view quotes = "\"'";

std::string_view separator_name(char separator) {
    switch (separator) {
        case ';':
            return "semicolons (;)";
        case '\t':
            return "tabs";
        case '|':
            return "bars (|)";
        case ':':
            return "colons (:)";
        case ' ':
            return "blanks";
        default:
            return "commas (,)";
    }
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool quoted(std::string_view text) {
    return text.find_first_of(quotes) != std::string_view::npos;
}

std::string_view without_quotes(std::string_view text) {
    text = trim(text);
    while (!text.empty() && quotes.find(text.front()) != std::string_view::npos)
        text.remove_prefix(1);
    while (!text.empty() && quotes.find(text.back()) != std::string_view::npos)
        text.remove_suffix(1);
    return text;
}

bool looks_like_utf16(std::string_view text) {
    return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
           text.substr(0, 64).find('\0') != std::string_view::npos;
}

/// A comma between two digits, as in 0,05.
bool has_decimal_comma(std::string_view text) {
    for (std::size_t i = 1; i + 1 < text.size(); ++i)
        if (text[i] == ',' && is_digit(text[i - 1]) && is_digit(text[i + 1])) return true;
    return false;
}

/// 1.0-101: what Fortran prints where an exponent of three digits leaves no room for its letter.
bool lacks_exponent_letter(std::string_view text) {
    const std::size_t sign = text.find_last_of("+-");
    double value = 0;
    return sign != std::string_view::npos && sign > 0 && is_digit(text[sign - 1]) &&
           parse_number(std::string(text.substr(0, sign)) + "e" + std::string(text.substr(sign)),
                        value);
}

/// "0.05 m", "5mm", "80 %".
bool has_unit(std::string_view text) {
    const std::size_t end = text.find_last_of("0123456789.");
    if (end == std::string_view::npos || end + 1 == text.size()) return false;
    const std::string_view unit = trim(text.substr(end + 1));
    double value = 0;
    return parse_number(text.substr(0, end + 1), value) &&
           std::ranges::all_of(unit, [](unsigned char c) {
               return std::isalpha(c) != 0 || c == '%' || c == '/' || c >= 0x80;
           });
}

}  // namespace

std::string foreign_form(std::string_view text, std::string_view header, char separator) {
    if (looks_like_utf16(text))
        return "the text is not UTF-8 (it looks like UTF-16): must be UTF-8";
    const std::size_t cr = text.find('\r');
    if (cr != std::string_view::npos && text.find('\n') > cr + 1)
        return "its lines end with CR alone (old Mac): must end with LF or CRLF";
    if (header.find(separator) == std::string_view::npos) {
        for (char other : separators) {
            if (other == separator || trim(header).find(other) == std::string_view::npos) continue;
            std::string form = fmt::format("its fields are separated by {}: must be {}",
                                           separator_name(other), separator_name(separator));
            if (other != ',' && has_decimal_comma(text.substr(0, 4096)))
                form += "; its numbers have decimal commas: must be points";
            return form;
        }
    }
    if (quoted(header)) return "its names stand in quotes: must stand without";
    if (trim(header).ends_with(separator))
        return fmt::format("it ends with '{}', behind which no name stands: must end with a name",
                           separator);
    double value = 0;
    if (parse_number(trim(header.substr(0, header.find(separator))), value))
        return "it begins with a number: the first line must be a header";
    return {};
}

bool names_column(std::string_view header, std::string_view name) {
    while (!header.empty()) {
        const std::size_t end = header.find_first_of(separators);
        const std::string_view field = without_quotes(header.substr(0, end));
        header.remove_prefix(std::min(end, header.size()));
        if (!header.empty()) header.remove_prefix(1);
        if (std::ranges::equal(field, name, [](unsigned char a, unsigned char b) {
                return std::tolower(a) == std::tolower(b);
            }))
            return true;
    }
    return false;
}

std::string foreign_number(std::string_view field) {
    const std::string_view text = trim(field);
    if (looks_like_utf16(text))
        return "; the text is not UTF-8 (it looks like UTF-16): must be UTF-8";
    if (text.find("\xc2\xa0") != std::string_view::npos)
        return "; a non-breaking blank (U+00A0) stands in it: must not";
    if (!text.empty() && (quoted(text.substr(0, 1)) || quoted(text.substr(text.size() - 1))))
        return "; the number stands in quotes: must stand without";
    double value = 0;
    std::string as_e(text);
    const std::size_t d = as_e.find_first_of("dD");
    if (d != std::string::npos && d > 0) {
        as_e[d] = 'e';
        if (parse_number(as_e, value))
            return fmt::format("; its exponent begins with {}: must be e or E", text[d]);
    }
    std::string as_point(text);
    if (std::count(as_point.begin(), as_point.end(), ',') == 1) {
        std::replace(as_point.begin(), as_point.end(), ',', '.');
        if (as_point.back() == '.') return "; a comma follows it: must be separated by blanks";
        if (parse_number(as_point, value)) return "; it has a decimal comma: must be a point";
    }
    if (text.starts_with("\xe2\x88\x92")) return "; its minus is not the ASCII one: must be -";
    if (const std::size_t other = text.find_first_of(";|\t"); other != std::string_view::npos)
        return fmt::format("; {} stand in it: must not", separator_name(text[other]));
    if (lacks_exponent_letter(text)) return "; its exponent has no letter: must be e or E";
    if (has_unit(text)) return "; a unit follows the number: must stand without, in SI";
    return {};
}

std::string bad_value(std::string_view name, std::string_view field, std::string_view allowed) {
    return fmt::format("{} = {}: {}{}", name, field.empty() ? "(nothing)" : shortened(field),
                       allowed, foreign_number(field));
}

std::string foreign_row(std::string_view row, std::size_t expected) {
    for (char other : std::string_view(";\t|"))
        if (row.find(other) != std::string_view::npos)
            return fmt::format("; {} stand in it: fields must be separated by commas",
                               separator_name(other));
    const auto fields = static_cast<std::size_t>(std::count(row.begin(), row.end(), ',')) + 1;
    if (fields > expected && !trim(row).ends_with(',') && has_decimal_comma(row))
        return "; if its numbers have decimal commas: must be points";
    if (fields == 1 && expected > 1 && trim(row).find(' ') != std::string_view::npos)
        return "; blanks stand in it: fields must be separated by commas";
    return {};
}

}  // namespace grainfield::core
