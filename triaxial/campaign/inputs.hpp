#pragma once
// What a run, its start and its packing are made from: each depends on a part of its config only,
// and configs that agree in that part share the result.

#include <string>

#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

struct Inputs {
    Config config;     ///< what does not matter is as it comes by default
    std::string hash;  ///< 16 digits, over all values of the config
};

/// Of a run, random or deterministic, but for the realization of its field.
Inputs run_inputs(const Config& config, bool deterministic);
/// Of the start of a run: the sample at its isotropic stress.
Inputs start_inputs(const Config& config);
/// Of the packing that a start is made from; of a start's own config it is the same.
Inputs packing_inputs(const Config& config);

}  // namespace grainfield::triaxial
