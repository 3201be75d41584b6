#pragma once
// Small packings and their material, shared by the tests of packing and of the triaxial test.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/drive/driver.hpp"
#include "core/kernel_choice.hpp"
#include "packing/block.hpp"
#include "packing/deposit.hpp"
#include "packing/isotropic.hpp"
#include "packing/packing_options.hpp"
#include "tests/message_of.hpp"

namespace grainfield::packing::testing {

/// Diameters between 40 and 60 mm, by mass: about 60 spheres in the block of small_options().
inline Grading narrow_grading() {
    Grading grading;
    grading.sieve_diameter = {0.04, 0.06};
    grading.passing = {0, 100};
    return grading;
}

/// A block four spheres wide, whose walls hold its porosity up: frictionless, it ends near 0.48.
inline PackingOptions small_options() {
    PackingOptions options;
    options.block = Vec3(0.2, 0.2, 0.2);
    options.blocks = {2, 2, 2};
    options.porosity = 0.51;
    return options;
}

/// The widest kernels that run here, as a packing takes them by itself.
inline const kernels::KernelTable& kernels_here() {
    return core::choose_kernels({});
}

inline double sphere_volume(double diameter) {
    return std::numbers::pi / 6 * diameter * diameter * diameter;
}

/// Spheres as pack_block() makes them, of the radii given [m], at the origin.
inline core::ParticleStore spheres_of(const std::vector<double>& radii, const Material& material) {
    core::ParticleStore spheres;
    spheres.resize(radii.size());
    std::copy(radii.begin(), radii.end(), spheres.radius.begin());
    std::fill(spheres.normal_stiffness.begin(), spheres.normal_stiffness.end(),
              material.normal_stiffness);
    std::fill(spheres.friction_angle.begin(), spheres.friction_angle.end(),
              material.friction_angle);
    spheres.set_density(material.density);
    return spheres;
}

/// The spheres between six walls of the material, without gravity.
inline core::Scene box_scene(core::ParticleStore spheres, const core::Box& box,
                             const Material& material) {
    core::Scene scene;
    scene.spheres = std::move(spheres);
    scene.stiffness_ratio = material.stiffness_ratio;
    scene.damping = material.damping;
    core::Wall wall;
    wall.friction_angle = material.wall_friction_angle;
    wall.normal_stiffness = material.normal_stiffness;
    wall.stiffness_ratio = material.wall_stiffness_ratio;
    scene.walls = core::box_walls(box, wall);
    return scene;
}

}  // namespace grainfield::packing::testing
