#include "packing/size_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace grainfield::packing {
namespace {

constexpr double class_ratio = 2;   // largest over smallest radius of a class [-]
constexpr double round_off = 1e-9;  // of the reach of a look [-]

using Cell = std::array<std::int64_t, 3>;

/// Cells far apart may share a key: they are then looked at together.
std::uint64_t key_of(const Cell& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t index : cell) key = key << 21 ^ static_cast<std::uint64_t>(index);
    return key;
}

Cell cell_of(const Vec3& x, double size) {
    Cell cell{};
    for (std::size_t a = 0; a < 3; ++a)
        cell[a] = static_cast<std::int64_t>(std::floor(x[static_cast<int>(a)] / size));
    return cell;
}

}  // namespace

SizeGrid::SizeGrid(const core::ParticleStore& spheres)
    : spheres_(spheres), next_(spheres.size(), -1) {}

void SizeGrid::add(std::size_t i) {
    const double r = spheres_.radius[i];
    if (classes_.empty() || classes_.back().largest > class_ratio * r) classes_.push_back({r, {}});
    SizeClass& own = classes_.back();
    const auto [head, fresh] = own.head.try_emplace(
        key_of(cell_of(spheres_.position[i], 2 * own.largest)), static_cast<std::int64_t>(i));
    if (fresh) return;
    next_[i] = head->second;
    head->second = static_cast<std::int64_t>(i);
}

bool SizeGrid::overlaps(const Vec3& x, double r) const {
    // Large spheres fill most of the room: they come first.
    return std::any_of(classes_.begin(), classes_.end(),
                       [&](const SizeClass& one) { return overlaps(one, x, r); });
}

bool SizeGrid::overlaps(const SizeClass& spheres, const Vec3& x, double r) const {
    const double size = 2 * spheres.largest;
    const Vec3 reach = Vec3::Constant((1 + round_off) * (r + spheres.largest));
    const Cell from = cell_of(x - reach, size), to = cell_of(x + reach, size);
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
        for (std::int64_t j = from[1]; j <= to[1]; ++j)
            for (std::int64_t k = from[2]; k <= to[2]; ++k) {
                const auto head = spheres.head.find(key_of({i, j, k}));
                if (head == spheres.head.end()) continue;
                for (std::int64_t n = head->second; n >= 0;
                     n = next_[static_cast<std::size_t>(n)]) {
                    const auto sphere = static_cast<std::size_t>(n);
                    const double touching = r + spheres_.radius[sphere];
                    if ((spheres_.position[sphere] - x).squaredNorm() < touching * touching)
                        return true;
                }
            }
    return false;
}

}  // namespace grainfield::packing
