#pragma once
// Many normals of one stream at once, in the widest vectors of this machine.

#include <array>
#include <cstdint>
#include <span>

namespace grainfield::core {

/// values[i] = normal_quantile of the uniform at (realization, first + i) under a RandomStream's
/// key: the same bits as one by one (same operations in the same order, each rounded on its own),
/// on every instruction set.
void vector_normals(const std::array<std::uint32_t, 2>& key, std::uint64_t realization,
                    std::uint64_t first, std::span<double> values) noexcept;

}  // namespace grainfield::core
