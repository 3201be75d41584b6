#pragma once
// The resolved config as TOML.

#include <string>

#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

/// All keys with their values and units, in the order of docs/interface.md; optional keys that are
/// unset as comments. For any valid config, load_config gives back the same values, bit for bit.
std::string write_config(const Config& config);

}  // namespace grainfield::triaxial
