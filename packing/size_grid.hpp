#pragma once
// Finds the placed spheres near a place, for spheres of very different sizes.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/scene/particle_store.hpp"

namespace grainfield::packing {

/// Spheres of a store in cells: one grid for each size class, whose largest sphere is less than
/// twice its smallest and fills a cell. Looking around a place costs a few cells a class, whatever
/// the number of spheres.
class SizeGrid {
  public:
    /// The store must outlive the grid.
    explicit SizeGrid(const core::ParticleStore& spheres);

    /// Adds sphere i at its position [m, none below 0]. It must be no larger than any before.
    void add(std::size_t i);

    /// Whether a sphere of radius r [m] at x [m] would overlap one of the grid; r must be no larger
    /// than the radius of any of them.
    bool overlaps(const Vec3& x, double r) const;

  private:
    struct SizeClass {
        double largest;                                        // radius [m]
        std::unordered_map<std::uint64_t, std::int64_t> head;  // of a cell's list
    };
    bool overlaps(const SizeClass& spheres, const Vec3& x, double r) const;

    const core::ParticleStore& spheres_;
    std::vector<SizeClass> classes_;
    std::vector<std::int64_t> next_;  // in the same cell; -1: none
};

}  // namespace grainfield::packing
