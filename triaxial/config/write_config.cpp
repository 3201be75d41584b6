#include "triaxial/config/write_config.hpp"

#include <fmt/format.h>

#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {

std::string write_config(const Config& config) {
    Config copy = config;  // slots refer to something they may set
    std::string text = "# Grainfield: every key as it was used. SI units, angles in radians.\n";
    std::string table;
    for (const ConfigKey& key : config_keys(copy)) {
        const auto dot = key.path.rfind('.');
        if (key.path.substr(0, dot) != table) {
            table = key.path.substr(0, dot);
            text += fmt::format("\n[{}]\n", table);
        }
        const std::string name = key.path.substr(dot + 1);
        const auto value = key.slot.get();
        text += value ? fmt::format("{} = {}  # {}\n", name, toml_text(*value), key.note)
                      : fmt::format("# {} is not set  # {}\n", name, key.note);
    }
    return text;
}

}  // namespace grainfield::triaxial
