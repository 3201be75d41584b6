#pragma once
// One config key: its path, what it may be, and the variable it stands for. Reading, writing and
// checking a config are three loops over the same list of these, so they cannot disagree.

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernels/vec3.hpp"
#include "triaxial/config/toml_file.hpp"

namespace grainfield::triaxial {

/// Interval of allowed numbers; nan and inf are never allowed.
struct Range {
    double low;
    double high;
    bool low_allowed;
    bool high_allowed;
    std::string_view text;  ///< "> 0", "in [0, 1)"; may be empty

    bool contains(double value) const;
};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();
inline constexpr Range any_number{-no_limit, no_limit, false, false, ""};
inline constexpr Range positive{0, no_limit, false, false, "> 0"};
inline constexpr Range non_negative{0, no_limit, true, false, ">= 0"};
inline constexpr Range at_least_one{1, no_limit, true, false, ">= 1"};
inline constexpr Range below_one{0, 1, true, false, "in [0, 1)"};
inline constexpr Range below_right_angle{0, 1.5707963267948966, true, false, "in [0, pi/2)"};

struct WholeRange {
    std::int64_t low;
    std::int64_t high = std::numeric_limits<std::int64_t>::max();

    bool contains(std::int64_t value) const { return low <= value && value <= high; }
    std::string text() const;  ///< ">= 1" or "in [1, 2147483647]"
};

/// The name of an enumerator in files.
template <class E>
struct Named {
    E value;
    std::string_view name;
};

/// A value made here; null: none.
using TomlNode = std::shared_ptr<const toml::node>;

/// The variable behind a key. It is referred to, not copied, and must outlive the slot.
struct Slot {
    std::string expected;                        ///< "a number in (0.2, 0.9)", for messages
    std::function<bool(const toml::node&)> set;  ///< false (and no change): not allowed
    std::function<TomlNode()> get;               ///< null: optional and unset
};

struct ConfigKey {
    std::string path;  ///< dotted, as in the file
    Slot slot;
    std::string note;  ///< unit and meaning, the comment behind the key in a written config
};

Slot slot(bool& target);
Slot slot(double& target, const Range& allowed);
Slot slot(std::optional<double>& target, const Range& allowed);
Slot slot(std::vector<double>& target, const Range& allowed);  ///< of two numbers or more
Slot slot(Vec3& target, const Range& allowed);
Slot slot(std::array<std::int32_t, 3>& target, std::int64_t lowest);
Slot slot_or_auto(std::optional<double>& target, const Range& allowed);  ///< unset: "auto"
Slot text_slot(std::string& target, std::string expected);               ///< any but empty text
/// Any but empty text in a file; unset where the target is empty.
Slot optional_text_slot(std::string& target, std::string expected);
/// What the two templates below have in common. set gets a value in range; get: null, nullopt:
/// unset.
Slot whole_slot(const WholeRange& allowed, std::function<void(std::int64_t)> set,
                std::function<TomlNode()> get);
Slot choice_slot(std::vector<std::string_view> names, std::function<void(std::size_t)> set,
                 std::function<std::optional<std::size_t>()> get);

template <std::integral T>
WholeRange whole_range(std::int64_t lowest) {
    constexpr auto high = std::numeric_limits<T>::max();
    return std::cmp_less(high, std::numeric_limits<std::int64_t>::max())
               ? WholeRange{lowest, static_cast<std::int64_t>(high)}
               : WholeRange{lowest};
}

TomlNode number_node(std::int64_t value);
TomlNode number_node(double value);

/// A whole number as TOML; one that TOML's 64 bits cannot hold becomes a (never allowed) float.
template <std::integral T>
TomlNode whole_node(T value) {
    return std::in_range<std::int64_t>(value) ? number_node(static_cast<std::int64_t>(value))
                                              : number_node(static_cast<double>(value));
}

template <std::integral T>
Slot slot(T& target, std::int64_t lowest) {
    return whole_slot(
        whole_range<T>(lowest), [&target](std::int64_t value) { target = static_cast<T>(value); },
        [&target] { return whole_node(target); });
}

template <std::integral T>
Slot slot(std::optional<T>& target, std::int64_t lowest) {
    return whole_slot(
        whole_range<T>(lowest), [&target](std::int64_t value) { target = static_cast<T>(value); },
        [&target] { return target ? whole_node(*target) : nullptr; });
}

/// One of an enumeration's names; the array must outlive the slot.
template <class E, std::size_t n>
Slot slot(E& target, const std::array<Named<E>, n>& names) {
    std::vector<std::string_view> texts;
    for (const Named<E>& named : names) texts.push_back(named.name);
    return choice_slot(
        std::move(texts), [&](std::size_t i) { target = names[i].value; },
        [&]() -> std::optional<std::size_t> {
            for (std::size_t i = 0; i < n; ++i)
                if (names[i].value == target) return i;
            return std::nullopt;
        });
}

}  // namespace grainfield::triaxial
