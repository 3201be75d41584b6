#include "triaxial/report/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace grainfield::triaxial::report {
namespace {

/// UTF-8 has several bytes for some characters.
bool begins_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;
}

}  // namespace

std::string significant(double value, int digits) {
    if (!std::isfinite(value)) return "not a number";
    if (value == 0.0) return "0";
    const double magnitude = std::abs(value);
    if (magnitude < 1e-4 || magnitude >= 1e7) return fmt::format("{:.{}e}", value, digits - 1);
    int leading = static_cast<int>(std::floor(std::log10(magnitude)));
    if (magnitude >= (1 - 0.5 * std::pow(10.0, -digits)) * std::pow(10.0, leading + 1)) ++leading;
    return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - leading));
}

std::string count(double value) {
    if (!std::isfinite(value) || std::abs(value) > 9e15) return significant(value);
    const auto whole = static_cast<std::int64_t>(std::llround(value));
    const std::string digits = std::to_string(std::abs(whole));
    std::string text = whole < 0 ? "-" : "";
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

std::string duration(double seconds) {
    if (!std::isfinite(seconds)) return "not a number";
    if (seconds < 100) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

std::string shortened(std::string_view text, std::size_t most) {
    std::vector<std::size_t> begins;
    for (std::size_t at = 0; at < text.size(); ++at)
        if (begins_character(text[at])) begins.push_back(at);
    if (begins.size() <= most) return std::string(text);
    const std::size_t behind = most / 2, front = most - 1 - behind;
    return fmt::format("{}…{}", text.substr(0, begins[front]),
                       text.substr(begins[begins.size() - behind]));
}

std::string escape(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    static constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
    };
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        out += alphabet[group >> 18 & 63];
        out += alphabet[group >> 12 & 63];
        out += i + 1 < bytes.size() ? alphabet[group >> 6 & 63] : '=';
        out += i + 2 < bytes.size() ? alphabet[group & 63] : '=';
    }
    return out;
}

}  // namespace grainfield::triaxial::report
