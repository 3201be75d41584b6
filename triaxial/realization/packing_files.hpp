#pragma once
// A packing as files: P.h5 with the spheres and P.json with what is known about them.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "packing/pack.hpp"
#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

/// What the packing takes from the whole config.
packing::Material packing_material(const Config& config);

/// packing::pack() of a whole config.
packing::Packing pack(const Config& config, core::Monitor& monitor,
                      core::Checkpoint* checkpoint = nullptr);

/// The contents of P.json (docs/interface.md), with the grading and the stress profile for the
/// report.
nlohmann::json packing_json(const packing::Packing& packing, double wall_seconds);

/// P.json beside a packing file: the same name with the suffix .json.
std::filesystem::path json_beside(const std::filesystem::path& packing_file);

/// Writes the spheres (suffix of `path`) and the .json beside it, each whole or not at all.
/// Throws FileError; InputError for an unknown suffix.
void write_packing(const std::filesystem::path& path, const packing::Packing& packing,
                   double wall_seconds);

/// Packs and writes the packing with the time it took. Throws what the two throw.
packing::Packing pack_into(const std::filesystem::path& path, const Config& config,
                           core::Monitor& monitor, core::Checkpoint* checkpoint = nullptr);

}  // namespace grainfield::triaxial
