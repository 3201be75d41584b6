#pragma once
// The sample that step rates are measured on: clones of Tran et al.'s block at 100 kPa.

#include <array>
#include <cstdint>
#include <filesystem>

#include "core/scene/scene.hpp"

namespace grainfield::bench {

/// So many blocks of Tran et al.'s sample, held at 100 kPa without gravity: read from `file` (.h5),
/// or packed and left there for the next time. Throws what packing and files throw.
core::Scene stressed_sample(const std::filesystem::path& file,
                            const std::array<std::int32_t, 3>& blocks);

/// The same of Tran et al.'s whole sample (some minutes where it has to be packed).
core::Scene full_sample(const std::filesystem::path& file);

/// Mirror images of a scene's spheres, `times` along each axis, in a box that fits.
core::Scene mirrored(const core::Scene& scene, const std::array<int, 3>& times);

/// The spheres of a scene in blocks below `blocks`, in a box that fits.
core::Scene part(const core::Scene& scene, const std::array<int, 3>& blocks);

}  // namespace grainfield::bench
