#pragma once
// Three-component vectors of the reference kernels and of all public interfaces.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace grainfield {

using Vec3 = Eigen::Vector3d;

}  // namespace grainfield
