#pragma once
// What a config key is called in figures, and its values in the unit that the figures have.

#include <optional>
#include <string>

#include "triaxial/report/gnuplot_variables.hpp"

namespace grainfield::triaxial::report {

struct AxisName {
    std::string text;                             ///< name and unit, for an axis
    double scale = 1;                             ///< from SI to the unit
    std::optional<Markup> markup = std::nullopt;  ///< `text`, where it is ours
    std::string symbol = {};                      ///< for legends: "σ₃"
    std::string unit = {};                        ///< of legends: "kPa"; may be empty
};

/// Of a config key, by its dotted path. Keys that are not known get the unit that the config has
/// for them, stresses in kPa and stiffnesses in MPa.
AxisName axis_name(const std::string& key);

/// The number that a key's value, as TOML, stands for: itself, or the second of three.
std::optional<double> axis_value(const std::string& toml);

/// A key and its value for a legend: "σ₃ = 200 kPa", "θ = 10, 1, 10 m", "variable = friction".
std::string value_in_words(const std::string& key, const std::optional<std::string>& toml);

}  // namespace grainfield::triaxial::report
