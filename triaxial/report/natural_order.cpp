#include "triaxial/report/natural_order.hpp"

#include <compare>
#include <string>

#include "core/files/text_file.hpp"

namespace grainfield::triaxial::report {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Takes a number with its decimals and its exponent, or one character, off the front of a name.
struct Piece {
    Piece(std::string_view& rest, bool may_be_negative) {
        std::size_t end = may_be_negative && rest.size() > 1 && rest[0] == '-' ? 1 : 0;
        const auto digits = [&] {
            const std::size_t begin = end;
            while (end < rest.size() && is_digit(rest[end])) ++end;
            return end > begin;
        };
        is_number = digits();
        if (is_number) {
            const std::size_t whole = end;
            if (end < rest.size() && rest[end] == '.') ++end;
            if (end > whole && !digits()) end = whole;
            const std::size_t mantissa = end;
            if (end < rest.size() && rest[end] == 'e') {
                ++end;
                if (end < rest.size() && (rest[end] == '-' || rest[end] == '+')) ++end;
                if (!digits()) end = mantissa;
            }
        } else {
            end = 1;
        }
        text = rest.substr(0, end);
        if (is_number) is_number = core::parse_number(text, number);
        rest.remove_prefix(end);
    }
    std::string_view text;
    double number = 0;
    bool is_number = false;
};

std::weak_ordering compared(const Piece& a, const Piece& b) {
    if (a.is_number != b.is_number) return b.is_number <=> a.is_number;  // numbers first
    if (!a.is_number) return a.text <=> b.text;
    return a.number < b.number   ? std::weak_ordering::less
           : a.number > b.number ? std::weak_ordering::greater
                                 : std::weak_ordering::equivalent;
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
    std::string_view rest_a = a, rest_b = b;
    bool value_follows = false;  // behind a "=" a minus is a sign, elsewhere it is a dash
    while (!rest_a.empty() && !rest_b.empty()) {
        const Piece of_a(rest_a, value_follows), of_b(rest_b, value_follows);
        if (const auto order = compared(of_a, of_b); order != 0) return order < 0;
        value_follows = of_a.text == "=" || (value_follows && of_a.text == " ");
    }
    if (rest_a.empty() != rest_b.empty()) return rest_a.empty();
    return a < b;
}

}  // namespace grainfield::triaxial::report
