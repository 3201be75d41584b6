#pragma once
// How a block comes to its density: the procedures of docs/method.md, section 4.2.

#include "packing/density_range.hpp"
#include "packing/shaken_box.hpp"

namespace grainfield::packing {

/// The spheres fall with the material's friction, are levelled by the lid and come to rest under a
/// light one, with true springs: the loosest state.
void let_fall(ShakenBox& box);

/// Shakes a bed with this friction [rad] for a fixed number of bouts and lets it come to rest under
/// a light lid, with true springs and the same friction. Without friction: the densest state.
void shake_with(ShakenBox& box, double friction_angle);

/// Gives a bed that was shaken with another friction the material's, its lid held where it is.
void restore_friction(ShakenBox& box);

/// Shakes a bed down to a height [m], the friction lowered only as far as that needs. It ends at
/// rest with the material's friction, true springs, the lid at that height and a mean stress of no
/// more than twice that of the block's own weight. Returns the lowest friction that was needed
/// [rad]. Throws InputError if the height is not reached; `help` says what may.
double compact_to(ShakenBox& box, double height, const DensityRange& range,
                  const std::string& help);

/// Turns gravity round until the bed is at rest again below its lid, which stays where it is.
void stand_on_head(ShakenBox& box);

}  // namespace grainfield::packing
