#pragma once
// Sphere files that HDF5 wrote itself and that are wrong all the same: something is missing, of
// another type or shape, or holds other values. Mutations of bytes hardly ever make such a file,
// for HDF5 keeps checksums of what it writes.

#include <string>
#include <string_view>

namespace grainfield::fuzz {

/// A file of two spheres, changed as the recipe's bytes say; none or zeros change nothing.
std::string made_h5(std::string_view recipe);

}  // namespace grainfield::fuzz
