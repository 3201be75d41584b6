#include "triaxial/report/campaign/axis_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/files/text_file.hpp"
#include "triaxial/config/config_keys.hpp"

namespace grainfield::triaxial::report {
namespace {

/// The unit that stands first in a key's note, empty where none does.
std::string config_unit(const std::string& key) {
    constexpr std::array units{"Pa", "Pa/m", "rad", "rad/m", "m", "m/s2", "s", "1/s", "kg/m3"};
    Config config;
    for (const ConfigKey& known : config_keys(config)) {
        if (known.path != key) continue;
        const std::string unit = known.note.substr(0, known.note.find_first_of(",:"));
        if (std::ranges::find(units, unit) != units.end()) return unit;
    }
    return {};
}

/// "particle.normal_stiffness" as words: "normal stiffness". Tables that say nothing are left out.
std::string words_of(const std::string& key) {
    std::string words = key;
    for (const std::string_view table : {"triaxial.", "particle.", "field."})
        if (key.starts_with(table)) words = key.substr(table.size());
    std::ranges::replace(words, '_', ' ');
    std::ranges::replace(words, '.', ' ');
    return words;
}

/// The numbers of a value: one, or those of a list. None where it is something else.
std::vector<double> numbers_of(std::string_view toml) {
    if (toml.size() > 1 && toml.front() == '[' && toml.back() == ']')
        toml = toml.substr(1, toml.size() - 2);
    std::vector<double> numbers;
    while (!toml.empty()) {
        double number = 0;
        if (!core::parse_number(core::trim(core::next_field(toml, ',')), number)) return {};
        numbers.push_back(number);
    }
    return numbers;
}

}  // namespace

AxisName axis_name(const std::string& key) {
    const auto known = [](Markup markup, std::string symbol, std::string unit,
                          double scale = 1) -> AxisName {
        return {std::string(markup.text), scale, markup, std::move(symbol), std::move(unit)};
    };
    if (key == "field.stiffness.cov") return known("COV of {/:Italic k}_n (-)", "COV of kₙ", "");
    if (key == "field.correlation_length") return known("Correlation length θ_y (m)", "θ", "m");
    if (key == "triaxial.confining_stress")
        return known("Confining stress σ_3 (kPa)", "σ₃", "kPa", 1e-3);
    if (key == "particle.friction_angle") return known("Friction angle φ (rad)", "φ", "rad");
    AxisName name;
    name.symbol = words_of(key);
    name.unit = config_unit(key);
    if (name.unit.starts_with("Pa")) {
        const bool stiffness = key.find("stiffness") != std::string::npos;
        name.scale = stiffness ? 1e-6 : 1e-3;
        name.unit.insert(0, stiffness ? "M" : "k");
    }
    name.text = name.symbol;
    if (name.text[0] >= 'a' && name.text[0] <= 'z') name.text[0] += 'A' - 'a';
    if (!name.unit.empty()) name.text += fmt::format(" ({})", name.unit);
    return name;
}

std::optional<double> axis_value(const std::string& toml) {
    std::string_view text = toml;
    double value = 0;
    if (core::parse_number(text, value)) return value;
    if (text.size() < 2 || text.front() != '[' || text.back() != ']') return std::nullopt;
    text = text.substr(1, text.size() - 2);
    core::next_field(text, ',');
    const std::string_view second = core::trim(core::next_field(text, ','));
    if (!core::parse_number(second, value) || text.empty()) return std::nullopt;
    return value;
}

std::string value_in_words(const std::string& key, const std::optional<std::string>& toml) {
    const AxisName name = axis_name(key);
    if (!toml) return name.symbol + " = not set";
    std::string value;
    for (const double number : numbers_of(*toml))
        value += fmt::format("{}{:.6g}", value.empty() ? "" : ", ", number * name.scale);
    if (value.empty()) {
        value = *toml;
        std::erase(value, '"');  // TOML's own
    } else if (!name.unit.empty()) {
        value += " " + name.unit;
    }
    return fmt::format("{} = {}", name.symbol, value);
}

}  // namespace grainfield::triaxial::report
