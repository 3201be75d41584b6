#pragma once
// A section of a checkpoint from one function that lists its state, for both directions.

#include <cereal/archives/binary.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <string_view>
#include <utility>

#include "core/state/checkpoint.hpp"

namespace grainfield::core {

/// state(archive) lists references to all that the level carries:
///     const auto section = core::section_of(checkpoint, "settling", [&](auto& a) { a(steps,
///     ratio); });
template <class State>
Checkpoint::Section section_of(Checkpoint* checkpoint, std::string_view name, State state) {
    return Checkpoint::Section(
        checkpoint, name, [state](StateWriter& archive) { state(archive); },
        [state](StateReader& archive) { state(archive); });
}

}  // namespace grainfield::core
