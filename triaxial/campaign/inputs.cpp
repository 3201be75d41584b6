#include "triaxial/campaign/inputs.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include "triaxial/config/write_config.hpp"

namespace grainfield::triaxial {
namespace {

Inputs hashed(Config config) {
    const std::string text = write_config(config);
    return {std::move(config), fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()))};
}

}  // namespace

Inputs run_inputs(const Config& config, bool deterministic) {
    Config part = config;
    part.montecarlo = {};
    if (deterministic) part.field.variable = randomfield::Variable::none;
    if (part.field.variable == randomfield::Variable::none) part.field = {};
    return hashed(std::move(part));
}

Inputs start_inputs(const Config& config) {
    Config part = config;
    part.field = {};
    part.triaxial = {};
    part.triaxial.confining_stress = config.triaxial.confining_stress;
    part.triaxial.gravity = config.triaxial.gravity;
    part.montecarlo = {};
    return hashed(std::move(part));
}

Inputs packing_inputs(const Config& config) {
    Config part = config;
    part.field = {};
    part.triaxial = {};
    part.montecarlo = {};
    return hashed(std::move(part));
}

}  // namespace grainfield::triaxial
