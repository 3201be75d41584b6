#pragma once
// The part of [montecarlo] that varies other keys: sweep and cases.

#include "triaxial/config/toml_reader.hpp"

namespace grainfield::triaxial {

/// Takes montecarlo.sweep and montecarlo.case and checks that every key in them is one of a config
/// and every value one that it may have. Throws InputError.
void check_campaign(TomlReader& reader);

}  // namespace grainfield::triaxial
