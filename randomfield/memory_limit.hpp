#pragma once
// Fields too large for this machine are refused before anything is allocated.

#include <cstdint>

#include "core/base/memory_limit.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

using core::memory_of_process;

/// InputError that names the grid, what `work` ("field.method = \"las\"", ...) needs, what is
/// there and what to lower, if `bytes` [B] are more than memory_of_process().
void require_memory(const GridSpec& grid, double bytes, const char* work);

/// The same for the fields of `count` realizations held at once.
void require_memory(const GridSpec& grid, double bytes, std::uint64_t count, const char* work);

}  // namespace grainfield::randomfield
