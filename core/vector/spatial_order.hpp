#pragma once
// An order of the spheres in which neighbours in space are neighbours in memory, cut into domains.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/scene/particle_store.hpp"

namespace grainfield::core {

struct SpatialOrder {
    std::vector<std::int32_t> sphere;  ///< sphere of each slot
    std::vector<std::size_t> first;    ///< first slot of each domain, and one past the last slot

    /// Domain of a slot.
    std::size_t domain_of(std::int32_t slot) const {
        const auto after =
            std::upper_bound(first.begin(), first.end(), static_cast<std::size_t>(slot));
        return static_cast<std::size_t>(after - first.begin()) - 1;
    }
};

/// Bisects the spheres along the longest side of their box, again and again (a k-d tree): first
/// into compact domains of nearly equal count, about `domain_size` spheres each, then on to a few
/// spheres. Depends on positions [m] and domain_size alone.
SpatialOrder order_in_space(const Vec3Column& position, std::size_t domain_size);

}  // namespace grainfield::core
