#pragma once
// Grids too large for this machine are refused before anything is allocated.

#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// InputError that names the grid, what the method ("las", "cholesky", ...) needs and what is
/// there, if `bytes` [B] are more than the memory of this machine.
void require_memory(const GridSpec& grid, double bytes, const char* method);

}  // namespace grainfield::randomfield
