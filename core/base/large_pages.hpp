#pragma once
// Memory on large pages (2 MB) for the arrays that every step streams through: with pages of 4 kB
// a processor spends a fifth of the step looking up addresses.

#include <cstddef>

namespace grainfield::core {

/// Blocks smaller than this are not worth a place there [B].
inline constexpr std::size_t least_large_block = std::size_t{16} << 10;

/// A block of the process's region of large pages, `alignment` a power of two [B]; nullptr where
/// there is no such region, or no room left in it. Safe to call from any thread.
void* allocate_large(std::size_t bytes, std::size_t alignment) noexcept;

/// Gives back a block. False if it is none of allocate_large().
bool free_large(void* block) noexcept;

/// What of the region is in use [B].
std::size_t large_bytes_in_use() noexcept;

}  // namespace grainfield::core
