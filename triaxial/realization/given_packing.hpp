#pragma once
// What a packing that was given says of itself, and the config that is true for tests of it.

#include <filesystem>
#include <set>
#include <string>

#include "core/files/sphere_file.hpp"
#include "packing/pack.hpp"
#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

/// The config with what the packing in `file` knows in place of what nobody asked for: how it was
/// packed, its density, and blocks that cover its box, the grid of its random field. `given` are
/// the keys that the user gave. InputError (key, value, what the packing has) where one of them
/// contradicts the packing, and where blocks do not fit its box; `path` stands for it in messages.
Config config_of_packing(const core::SphereFile& file, const std::filesystem::path& path,
                         Config config, const std::set<std::string>& given);

/// The box that a test of these spheres starts with. That of packings, starts and states of
/// grainfield are their walls; of other files walls start at the spheres, and a larger box is
/// trimmed. `note`: a sentence on that, where there is something to say.
core::Box box_of_packing(const core::SphereFile& file, std::string* note = nullptr);

/// Attributes of a packing's file: how it was made, as config_of_packing() reads them.
std::string packing_attributes(const packing::Packing& packing);

/// "2600 kg/m3", or the range where spheres differ.
std::string density_text(const core::ParticleStore& spheres);

}  // namespace grainfield::triaxial
