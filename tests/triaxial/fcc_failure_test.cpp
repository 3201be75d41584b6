// A face-centred cubic lattice sheared to failure between frictionless walls.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/triaxial/small_test.hpp"

namespace grainfield::triaxial {
namespace {

/// FCC with its axes along a cube of `layers` layers a side, spheres just touching.
Sample fcc_sample(int layers, double radius) {
    std::vector<Vec3> places;
    const double spacing = std::sqrt(2.0) * radius;
    for (int i = 0; i < layers; ++i)
        for (int j = 0; j < layers; ++j)
            for (int k = 0; k < layers; ++k)
                if ((i + j + k) % 2 == 0)
                    places.push_back(Vec3::Constant(radius) + spacing * Vec3(i, j, k));
    Sample sample;
    sample.spheres = packing::testing::spheres_of(std::vector<double>(places.size(), radius), {});
    for (std::size_t i = 0; i < places.size(); ++i) sample.spheres.position.set(i, places[i]);
    sample.box.upper = Vec3::Constant(2 * radius + (layers - 1) * spacing);
    return sample;
}

/// sigma_1/sigma_3 at the peak.
double strength(int layers, double friction) {
    Config config;
    config.particle.friction_angle = std::atan(friction);
    config.particle.stiffness_ratio = 0.3;
    config.triaxial.confining_stress = 20e3;  // K_n/(sigma R) = k_n/(2 sigma) = 22500
    config.triaxial.strain_rate = 0.01;
    config.triaxial.max_axial_strain = 0.002;
    Sample sample = fcc_sample(layers, 0.025);
    for (double& angle : sample.spheres.friction_angle) angle = config.particle.friction_angle;
    const testing::FinishedTest run = testing::run(std::move(sample), config);
    EXPECT_LT(run.result.lateral_rms_error, 0.005);
    return 1 + run.result.results.peak_deviator_stress / config.triaxial.confining_stress;
}

// A bond at an edge of the cube has no partner to balance the moment of its friction: spheres roll
// there, and a finite lattice is too weak, the more so the larger the friction. The rest is the
// elastic strain up to the peak.
TEST(FccAtFailure, FollowsRoweAndThornton) {
    double small[2], large[2];
    const double friction[2] = {0.2, 0.3};
    for (int k = 0; k < 2; ++k) {
        SCOPED_TRACE(friction[k]);
        const double expected = 2 * (1 + friction[k]) / (1 - friction[k]);
        small[k] = strength(7, friction[k]) / expected;
        large[k] = strength(11, friction[k]) / expected;
        RecordProperty("friction" + std::to_string(k),
                       std::to_string(small[k]) + " " + std::to_string(large[k]));
        EXPECT_LT(small[k], large[k]);
        EXPECT_LT(large[k], 1.01);
    }
    EXPECT_GT(large[0], 0.97);
    EXPECT_GT(large[1], 0.97);
}

}  // namespace
}  // namespace grainfield::triaxial
