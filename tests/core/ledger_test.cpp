// The energy ledger of damped frictional motion closes, and the better the smaller the step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

using Ledger = KernelTest;

struct Closing {
    double error = 0;    // largest change of closing() [J]
    double through = 0;  // energy that passed: dissipated and put in [J]
    Energy last;
};

/// 343 spheres fall together in a box whose lid comes down and whose one side moves.
Closing collapse(const kernels::KernelTable& table, double wh, bool wall_friction) {
    Scene scene = scene_of(loose_balls({7, 7, 7}, 1.05, 0.5), 0.4);
    scene.stiffness_ratio = 0.3;
    scene.walls = box_walls(loose_box({7, 7, 7}, 1.05),
                            plane(Vec3::Zero(), Vec3::UnitX(), wall_friction ? 0.3 : 0.0));
    scene.gravity = Vec3(0, -9.81, 0);
    scene.damping = {0.2, 0.2};
    scene.walls[3].velocity = Vec3(0.05, -0.3, 0);
    scene.walls[0].velocity = Vec3(0.1, 0, 0);
    Simulation sim(std::move(scene), table, {.ledger = true});
    const double light = 0.8 * test_radius;
    const double step = wh * std::sqrt(sphere_mass(light) / (0.5 * light * test_stiffness));
    sim.compute_forces();
    const double before = sim.energy().closing();
    Closing result;
    while (sim.time() < 0.9) {
        sim.advance(step);
        sim.compute_forces();
        result.last = sim.energy();
        result.error = std::max(result.error, std::abs(result.last.closing() - before));
    }
    result.through =
        result.last.friction_work + result.last.damping_work + std::abs(result.last.external_work);
    return result;
}

TEST_P(Ledger, ClosesToATenthOfAPercentAndWithTheStep) {
    for (bool wall_friction : {false, true}) {
        const Closing coarse = collapse(table(), 0.2, wall_friction);
        const Closing fine = collapse(table(), 0.05, wall_friction);
        // Everything took part.
        EXPECT_GT(fine.last.friction_work, 0.01 * fine.through);
        EXPECT_GT(fine.last.damping_work, 0.01 * fine.through);
        EXPECT_GT(std::abs(fine.last.external_work), 0.01 * fine.through);
        EXPECT_LT(fine.error, 1e-3 * fine.through);
        EXPECT_LT(coarse.error, 1e-2 * coarse.through);
        EXPECT_LT(fine.error / fine.through, 0.5 * coarse.error / coarse.through);
        RecordProperty(wall_friction ? "rough_coarse" : "smooth_coarse",
                       std::to_string(coarse.error / coarse.through));
        RecordProperty(wall_friction ? "rough_fine" : "smooth_fine",
                       std::to_string(fine.error / fine.through));
    }
}

TEST_P(Ledger, DampedFallIsExact) {
    Scene scene = scene_of({Ball{.v = Vec3(0.3, -1.0, 0)}});
    scene.gravity = Vec3(0, -9.81, 0);
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table(), {.ledger = true});
    const double step = 1e-3;
    sim.compute_forces();
    const double before = sim.energy().closing();
    for (int k = 0; k < 500; ++k) {
        sim.advance(step);
        sim.compute_forces();
        // m g times a path of a metre; every step rounds once or twice.
        ASSERT_NEAR(sim.energy().closing(), before, roundoff(1000) * sphere_mass(test_radius) * 20)
            << k;
    }
    EXPECT_GT(sim.energy().damping_work, 0.0);
}

TEST_P(Ledger, TurningPointCostsASquareOfTheStep) {
    // Where damping changes sides the acceleration jumps from 1.2 g to 0.8 g, and the kinetic
    // energy of leapfrog by m h^2/8 of the difference of their squares.
    const double g = 9.81, m = sphere_mass(test_radius), step = 1e-3;
    Scene scene = scene_of({Ball{.v = Vec3(0, 1.0, 0)}});
    scene.gravity = Vec3(0, -g, 0);
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table(), {.ledger = true});
    sim.compute_forces();
    const double before = sim.energy().closing();
    for (int k = 0; k < 200; ++k) {
        sim.advance(step);
        sim.compute_forces();
        ASSERT_NEAR(sim.energy().closing(), before, 0.101 * m * step * step * g * g) << k;
    }
}

TEST_P(Ledger, StepsOfChangingLengthKeepTheFallExact) {
    Scene scene = scene_of({Ball{}});
    scene.gravity = Vec3(0, -9.81, 0);
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table(), {.ledger = true});
    sim.compute_forces();
    for (int k = 0; k < 300; ++k) {
        sim.advance(1e-3 * (1.0 + 0.5 * (k % 3)));
        sim.compute_forces();
    }
    const double t = sim.time();
    EXPECT_NEAR(sim.on_step(0).velocity.y(), -0.8 * 9.81 * t, roundoff(300) * 10);
    EXPECT_NEAR(sim.spheres().position.y[0], -0.4 * 9.81 * t * t, roundoff(300) * 10);
}

GRAINFIELD_FOR_ALL_KERNELS(Ledger);

}  // namespace
}  // namespace grainfield::core
