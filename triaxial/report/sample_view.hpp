#pragma once
// What of a sample is seen from outside: an oblique parallel view of its three faces x max (right),
// y max (top) and z max (front), as discs from back to front.

#include <array>
#include <cstddef>
#include <vector>

#include "core/scene/particle_store.hpp"

namespace grainfield::triaxial::report {

/// A sphere in the picture plane.
struct Disc {
    std::size_t sphere = 0;  ///< index in the store [-]
    double x = 0;            ///< to the right [m]
    double y = 0;            ///< up [m]
    double radius = 0;       ///< [m]
    double light = 1;        ///< of its face and of how deep it lies in a gap, 0 < light <= 1 [-]
};

/// Turns points of space into the picture plane.
class Camera {
  public:
    Camera();
    double right(const Vec3& p) const { return right_.dot(p); }      ///< [m]
    double up(const Vec3& p) const { return up_.dot(p); }            ///< [m]
    double nearness(const Vec3& p) const { return toward_.dot(p); }  ///< greater: in front [m]

  private:
    Vec3 right_, up_, toward_;
};

/// Spheres that can be seen, back to front: near a visible face and not hidden behind others
/// (checked on a raster of a third of the smallest radius, 4,000 cells across at most).
/// Reads positions and radii.
std::vector<Disc> visible_discs(const core::ParticleStore& spheres, const core::Box& box,
                                const Camera& camera);

/// Corners of the box in the order x + 2 y + 4 z, each 0 (lower) or 1 (upper).
std::array<Vec3, 8> corners(const core::Box& box);

}  // namespace grainfield::triaxial::report
