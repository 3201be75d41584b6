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

template <class Numbers>
TomlNode array_node(const Numbers& numbers) {
    auto array = std::make_shared<toml::array>();
    for (const auto number : numbers) array->push_back(number);
    return array;
}

/// The slot of a variable by what a node means to it (nullopt: not allowed) and the node of its
/// value.
template <class T, class ValueOf, class NodeOf>
Slot made_slot(T& target, std::string expected, ValueOf value_of, NodeOf node_of) {
    return {std::move(expected),
            [&target, value_of = std::move(value_of)](const toml::node& node) {
                auto value = value_of(node);
                if (value) target = *std::move(value);
                return value.has_value();
            },
            [&target, node_of] { return node_of(target); }};
}

/// "a number", "a number > 0"
std::string with_range(std::string_view noun, std::string_view range) {
    return range.empty() ? std::string(noun) : fmt::format("{} {}", noun, range);
}

/// An integer is a number too: `gravity = 0`.
std::optional<double> as_number(const toml::node& node, const Range& allowed) {
    double number = node.value_exact<double>().value_or(std::nan(""));
    if (const auto* whole = node.as_integer()) number = static_cast<double>(whole->get());
    return allowed.contains(number) ? std::optional(number) : std::nullopt;
}

auto number_in(const Range& allowed) {
    return [allowed](const toml::node& node) { return as_number(node, allowed); };
}

auto whole_in(const WholeRange& allowed) {
    return [allowed](const toml::node& node) {
        const auto whole = node.value_exact<std::int64_t>();
        return whole && allowed.contains(*whole) ? whole : std::nullopt;
    };
}

std::optional<std::string> as_text(const toml::node& node) {
    auto text = node.value_exact<std::string>();
    return text && !text->empty() ? text : std::nullopt;
}

/// All elements, each through `one`; nullopt where the node is no array, an element is refused or
/// there are fewer than `fewest` or more than `most`.
template <class T, class One>
std::optional<std::vector<T>> as_array(const toml::node& node, const One& one, std::size_t fewest,
                                       std::size_t most) {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() < fewest || array->size() > most) return std::nullopt;
    std::vector<T> result;
    for (const toml::node& element : *array) {
        const auto converted = one(element);
        if (!converted) return std::nullopt;
        result.push_back(static_cast<T>(*converted));
    }
    return result;
}

std::string choice_text(const std::vector<std::string_view>& names) {
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
    return made_slot(
        target, "true or false", [](const toml::node& node) { return node.value_exact<bool>(); },
        [](bool truth) { return std::make_shared<toml::value<bool>>(truth); });
}

Slot slot(double& target, const Range& allowed) {
    return made_slot(target, with_range("a number", allowed.text), number_in(allowed),
                     [](double number) { return number_node(number); });
}

Slot slot(std::optional<double>& target, const Range& allowed) {
    return made_slot(target, with_range("a number", allowed.text), number_in(allowed),
                     [](const auto& number) { return number ? number_node(*number) : nullptr; });
}

Slot slot_or_auto(std::optional<double>& target, const Range& allowed) {
    using Answer = std::optional<std::optional<double>>;
    return made_slot(
        target, "\"auto\" or " + with_range("a number", allowed.text),
        [allowed](const toml::node& node) {
            const auto number = as_number(node, allowed);
            return number || as_text(node) == "auto" ? Answer(number) : std::nullopt;
        },
        [](const auto& number) { return number ? number_node(*number) : text_node("auto"); });
}

Slot slot(std::vector<double>& target, const Range& allowed) {
    return made_slot(
        target, "an array of " + with_range("2 or more numbers", allowed.text),
        [allowed](const toml::node& node) {
            return as_array<double>(node, number_in(allowed), 2, std::string::npos);
        },
        [](const auto& numbers) { return array_node(numbers); });
}

Slot slot(Vec3& target, const Range& allowed) {
    return made_slot(
        target, "an array of " + with_range("3 numbers", allowed.text),
        [allowed](const toml::node& node) {
            const auto n = as_array<double>(node, number_in(allowed), 3, 3);
            return n ? std::optional(Vec3((*n)[0], (*n)[1], (*n)[2])) : std::nullopt;
        },
        [](const Vec3& vector) { return array_node(vector); });
}

Slot slot(std::array<std::int32_t, 3>& target, std::int64_t lowest) {
    const WholeRange allowed = whole_range<std::int32_t>(lowest);
    using Answer = std::optional<std::array<std::int32_t, 3>>;
    return made_slot(
        target, "an array of 3 whole numbers " + allowed.text(),
        [allowed](const toml::node& node) {
            const auto n = as_array<std::int32_t>(node, whole_in(allowed), 3, 3);
            return n ? Answer({(*n)[0], (*n)[1], (*n)[2]}) : std::nullopt;
        },
        [](const auto& wholes) { return array_node(wholes); });
}

Slot text_slot(std::string& target, std::string expected) {
    return made_slot(target, std::move(expected), as_text, text_node);
}

Slot optional_text_slot(std::string& target, std::string expected) {
    return made_slot(target, std::move(expected), as_text, [](const std::string& text) {
        return text.empty() ? nullptr : text_node(text);
    });
}

Slot whole_slot(const WholeRange& allowed, std::function<void(std::int64_t)> set,
                std::function<TomlNode()> get) {
    return {"a whole number " + allowed.text(),
            [whole_of = whole_in(allowed), set = std::move(set)](const toml::node& node) {
                const auto whole = whole_of(node);
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
            [names = std::move(names), set = std::move(set)](const toml::node& node) {
                const auto text = as_text(node);
                const auto found = text ? std::ranges::find(names, *text) : names.end();
                if (found == names.end()) return false;
                set(static_cast<std::size_t>(found - names.begin()));
                return true;
            },
            name_of};
}

}  // namespace grainfield::triaxial
