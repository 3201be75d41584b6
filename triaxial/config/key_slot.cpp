#include "triaxial/config/key_slot.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

TomlNode text_node(std::string text) {
    return std::make_shared<toml::value<std::string>>(std::move(text));
}

/// "a number", "a number > 0"
std::string with_range(std::string_view noun, std::string_view range) {
    return range.empty() ? std::string(noun) : fmt::format("{} {}", noun, range);
}

/// An integer is a number too: `gravity = 0`.
std::optional<double> as_number(const toml::node& value, const Range& allowed) {
    double number = std::nan("");
    if (const auto* real = value.as_floating_point()) number = real->get();
    if (const auto* whole = value.as_integer()) number = static_cast<double>(whole->get());
    return allowed.contains(number) ? std::optional(number) : std::nullopt;
}

std::optional<std::int64_t> as_whole(const toml::node& value, const WholeRange& allowed) {
    const auto* whole = value.as_integer();
    return whole != nullptr && allowed.contains(whole->get()) ? std::optional(whole->get())
                                                              : std::nullopt;
}

/// All elements, each through `one`; nullopt where the value is no array or an element is refused.
template <class T, class One>
std::optional<std::vector<T>> as_array(const toml::node& value, const One& one) {
    const toml::array* array = value.as_array();
    if (array == nullptr) return std::nullopt;
    std::vector<T> result;
    for (const toml::node& element : *array) {
        const auto converted = one(element);
        if (!converted) return std::nullopt;
        result.push_back(*converted);
    }
    return result;
}

template <class Numbers>
TomlNode array_node(const Numbers& numbers) {
    auto array = std::make_shared<toml::array>();
    for (const auto number : numbers) array->push_back(number);
    return array;
}

std::optional<std::vector<double>> as_numbers(const toml::node& value, const Range& allowed) {
    return as_array<double>(value, [&](const toml::node& v) { return as_number(v, allowed); });
}

std::string choice_text(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + toml_string(name);
    return names.size() == 1 ? text : "one of " + text;
}

}  // namespace

bool Range::contains(double value) const {
    return std::isfinite(value) && (value > low || (low_allowed && value == low)) &&
           (value < high || (high_allowed && value == high));
}

std::string WholeRange::text() const {
    return high == std::numeric_limits<std::int64_t>::max() ? fmt::format(">= {}", low)
                                                            : fmt::format("in [{}, {}]", low, high);
}

TomlNode number_node(std::int64_t value) {
    return std::make_shared<toml::value<std::int64_t>>(value);
}

TomlNode number_node(double value) {
    return std::make_shared<toml::value<double>>(value);
}

Slot slot(bool& target) {
    return {"true or false",
            [&target](const toml::node& value) {
                const auto* truth = value.as_boolean();
                if (truth != nullptr) target = truth->get();
                return truth != nullptr;
            },
            [&target] { return std::make_shared<const toml::value<bool>>(target); }};
}

Slot slot(double& target, const Range& allowed) {
    return {with_range("a number", allowed.text),
            [&target, allowed](const toml::node& value) {
                const auto number = as_number(value, allowed);
                if (number) target = *number;
                return number.has_value();
            },
            [&target] { return number_node(target); }};
}

Slot slot(std::optional<double>& target, const Range& allowed) {
    return {with_range("a number", allowed.text),
            [&target, allowed](const toml::node& value) {
                const auto number = as_number(value, allowed);
                if (number) target = number;
                return number.has_value();
            },
            [&target] { return target ? number_node(*target) : nullptr; }};
}

Slot slot_or_auto(std::optional<double>& target, const Range& allowed) {
    return {"\"auto\" or " + with_range("a number", allowed.text),
            [&target, allowed](const toml::node& value) {
                const auto* text = value.as_string();
                const bool automatic = text != nullptr && text->get() == "auto";
                const auto number = as_number(value, allowed);
                if (automatic || number) target = number;
                return automatic || number;
            },
            [&target] { return target ? number_node(*target) : text_node("auto"); }};
}

Slot slot(std::vector<double>& target, const Range& allowed) {
    return {"an array of " + with_range("2 or more numbers", allowed.text),
            [&target, allowed](const toml::node& value) {
                auto numbers = as_numbers(value, allowed);
                if (!numbers || numbers->size() < 2) return false;
                target = std::move(*numbers);
                return true;
            },
            [&target] { return array_node(target); }};
}

Slot slot(Vec3& target, const Range& allowed) {
    return {"an array of " + with_range("3 numbers", allowed.text),
            [&target, allowed](const toml::node& value) {
                const auto numbers = as_numbers(value, allowed);
                if (!numbers || numbers->size() != 3) return false;
                target = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
                return true;
            },
            [&target] { return array_node(target); }};
}

Slot slot(std::array<std::int32_t, 3>& target, std::int64_t lowest) {
    const WholeRange allowed = whole_range<std::int32_t>(lowest);
    return {"an array of 3 whole numbers " + allowed.text(),
            [&target, allowed](const toml::node& value) {
                const auto one = [&](const toml::node& v) { return as_whole(v, allowed); };
                const auto wholes = as_array<std::int64_t>(value, one);
                if (!wholes || wholes->size() != 3) return false;
                std::transform(wholes->begin(), wholes->end(), target.begin(),
                               [](std::int64_t n) { return static_cast<std::int32_t>(n); });
                return true;
            },
            [&target] { return array_node(target); }};
}

Slot text_slot(std::string& target, std::string expected) {
    return {std::move(expected),
            [&target](const toml::node& value) {
                const auto* text = value.as_string();
                if (text == nullptr || text->get().empty()) return false;
                target = text->get();
                return true;
            },
            [&target] { return text_node(target); }};
}

Slot optional_text_slot(std::string& target, std::string expected) {
    Slot slot = text_slot(target, std::move(expected));
    slot.get = [&target] { return target.empty() ? nullptr : text_node(target); };
    return slot;
}

Slot slot(std::string& target, std::span<const std::string_view> texts) {
    return {choice_text(texts),
            [&target, texts](const toml::node& value) {
                const auto* text = value.as_string();
                if (text == nullptr || std::ranges::find(texts, text->get()) == texts.end())
                    return false;
                target = text->get();
                return true;
            },
            [&target] { return text_node(target); }};
}

Slot whole_slot(const WholeRange& allowed, std::function<void(std::int64_t)> set,
                std::function<TomlNode()> get) {
    return {"a whole number " + allowed.text(),
            [allowed, set = std::move(set)](const toml::node& value) {
                const auto whole = as_whole(value, allowed);
                if (whole) set(*whole);
                return whole.has_value();
            },
            std::move(get)};
}

Slot choice_slot(std::vector<std::string_view> names, std::function<void(std::size_t)> set,
                 std::function<std::optional<std::size_t>()> get) {
    std::string expected = choice_text(names);
    const auto name_of = [names, get = std::move(get)] {
        const auto i = get();  // nullopt: an enumerator made by a cast, refused by set
        return text_node(std::string(i ? names[*i] : "no enumerator"));
    };
    return {std::move(expected),
            [names = std::move(names), set = std::move(set)](const toml::node& value) {
                const auto* text = value.as_string();
                const auto found = text ? std::ranges::find(names, text->get()) : names.end();
                if (found == names.end()) return false;
                set(static_cast<std::size_t>(found - names.begin()));
                return true;
            },
            name_of};
}

}  // namespace grainfield::triaxial
