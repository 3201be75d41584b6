#pragma once
// From a scene file to something that can be stepped: spheres read, completed and checked.

#include <span>
#include <string>
#include <vector>

#include "core/base/monitor.hpp"
#include "core/drive/servo.hpp"
#include "core/scene/scene.hpp"
#include "triaxial/config/scene_file.hpp"

namespace grainfield::triaxial {

/// Reads the scene's spheres; columns that the file does not bring are those of [particle], masses
/// come from the density unless the file brings them. Throws InputError (file, line, value, what is
/// allowed), also for spheres that overlap by more than 10 % of the smaller radius or reach as far
/// into a wall; FileError.
core::Scene set_up_scene(const SceneFile& file, core::Monitor* monitor = nullptr);

/// A wall that holds a stress, with the walls that span its area.
struct ServoWall {
    core::WallServo servo;
    int axis;  ///< of its normal [-]

    /// Product of the distances between the opposite walls of the other two axes, now [m2].
    double area(std::span<const core::Wall> walls) const;
};

/// The servos of the walls with a stress. Throws InputError where a wall is not along an axis or
/// the walls around it do not make a box. The speed of each is capped at a strain rate of 0.5/s
/// of half the box.
/// `source`: name of the scene in messages.
std::vector<ServoWall> set_up_servos(const SceneFile& file, const core::Scene& scene,
                                     const std::string& source);

}  // namespace grainfield::triaxial
