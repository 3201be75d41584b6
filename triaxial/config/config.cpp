#include "triaxial/config/config.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {

void Config::validate() const {
    Config copy = *this;  // slots refer to something they may set
    for (const ConfigKey& key : config_keys(copy)) {
        const auto value = key.slot.get();
        // A value that its own key would refuse in a file is refused here too.
        if (value && !key.slot.set(*value))
            throw InputError(fmt::format("{} = {}: {} is expected", key.path, short_text(*value),
                                         key.slot.expected));
    }
    grading.validate();
    packing.validate();
    field.validate({packing.blocks, packing.block});
}

}  // namespace grainfield::triaxial
