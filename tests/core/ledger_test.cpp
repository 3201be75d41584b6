// The energy ledger of damped frictional motion closes, and the better the smaller the step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/test_scenes.hpp"
#include "tests/larger.hpp"

namespace grainfield::core {
namespace {

using Ledger = KernelTest;

struct Closing {
    double error = 0;    // largest change of closing() [J]
    double through = 0;  // energy that passed: dissipated and put in [J]
    Energy last;
};

/// 343 spheres fall together in a box whose lid comes down and whose one side moves.
Closing closing_collapse(const kernels::KernelTable& table, double wh, bool wall_friction) {
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
        result.error = larger(result.error, std::abs(result.last.closing() - before));
    }
    result.through =
        result.last.friction_work + result.last.damping_work + std::abs(result.last.external_work);
    return result;
}

TEST_P(Ledger, ClosesToATenthOfAPercentAndWithTheStep) {
    for (bool wall_friction : {false, true}) {
        const Closing coarse = closing_collapse(table(), 0.2, wall_friction);
        const Closing fine = closing_collapse(table(), 0.05, wall_friction);
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

/// Spheres that fall together between walls that move.
Scene busy_scene() {
    Scene scene = scene_of(loose_balls({6, 6, 6}, 1.05, 0.5), 0.4);
    scene.walls = box_walls(loose_box({6, 6, 6}, 1.05), plane(Vec3::Zero(), Vec3::UnitX(), 0.3));
    scene.gravity = Vec3(0, -9.81, 0);
    scene.damping = {0.2, 0.2};
    scene.walls[3].velocity = Vec3(0.05, -0.3, 0);
    return scene;
}

constexpr double busy_step = 1e-4;  // [s]

TEST_P(Ledger, IsTheSameInOneCallAStepAndChangesNothing) {
    Simulation two(busy_scene(), table(), {.ledger = true});
    Simulation one(busy_scene(), table(), {.ledger = true});
    Simulation without(busy_scene(), table());
    for (int k = 0; k < 1500; ++k) {
        two.compute_forces();
        two.advance(busy_step);
        one.step(busy_step, [] {});
        without.step(busy_step, [] {});
    }
    for (Simulation* s : {&two, &one, &without}) s->compute_forces(true);
    EXPECT_GT(two.energy().friction_work, 0);
    EXPECT_GT(two.energy().damping_work, 0);
    EXPECT_EQ(one.energy().friction_work, two.energy().friction_work);
    EXPECT_EQ(one.energy().damping_work, two.energy().damping_work);
    EXPECT_EQ(one.energy().external_work, two.energy().external_work);
    EXPECT_EQ(one.energy().closing(), two.energy().closing());
    EXPECT_EQ(one.state_hash(), without.state_hash());
    EXPECT_EQ(two.state_hash(), without.state_hash());
}

TEST_P(Ledger, FollowsVelocitiesAndMassesThatAreChanged) {
    Simulation sim(busy_scene(), table(), {.ledger = true});
    for (int k = 0; k < 800; ++k) sim.step(busy_step, [] {});
    sim.compute_forces(true);
    const Energy before = sim.energy();
    // Energies are sums of a few hundred terms in the precision of the engine.
    const double tolerance = roundoff(1e3) * (before.kinetic + before.elastic_normal);
    const auto expect_closed = [&](const char* what) {
        EXPECT_NEAR(sim.energy().closing(), before.closing(), tolerance) << what;
    };
    sim.change().scale_velocities(0.5);
    expect_closed("slowed");
    EXPECT_GT(sim.energy().damping_work, before.damping_work + 0.5 * before.kinetic);
    sim.change().add_velocities([](std::size_t, const Vec3& x) { return Vec3(-x.y(), 0.3, 0); });
    expect_closed("given velocities");
    EXPECT_GT(sim.energy().external_work, before.external_work);
    sim.change().set_inertia_scale(std::vector<double>(sim.size(), 3.0));
    expect_closed("made heavier");
    // Forces that are not current, as between two steps in one call each.
    sim.step(busy_step, [] {});
    sim.change().scale_velocities(0.9);
    sim.compute_forces(true);
    EXPECT_NEAR(sim.energy().closing(), before.closing(), 1e-3 * before.kinetic);
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

TEST_P(Ledger, DampedSpinIsExact) {
    // A sphere that spins on the floor and slips: a constant moment, damped, about each axis.
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 up = Vec3::Unit((axis + 1) % 3);
        const double overlap =
            sphere_mass(test_radius) * 9.81 / (0.5 * test_radius * test_stiffness);
        Scene scene =
            scene_of({Ball{.x = (test_radius - overlap) * up, .w = 20 * Vec3::Unit(axis)}}, 0.5);
        scene.walls = {plane(Vec3::Zero(), up, 0.5)};
        scene.gravity = -9.81 * up;
        scene.damping.moment = 0.3;
        Simulation sim(std::move(scene), table(), {.ledger = true});
        sim.compute_forces();
        const double before = sim.energy().closing();
        run_steps(sim, 1e-4, 500);
        sim.compute_forces();
        const Energy after = sim.energy();
        EXPECT_GT(after.damping_work, 0.05);
        // Measured: 4e-6 in double, for the normal force swings a little, 8e-6 in float.
        EXPECT_NEAR(after.closing(), before, 3e-5 * after.damping_work);
    }
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
    EXPECT_NEAR(sim.sphere(0).on_step().velocity.y(), -0.8 * 9.81 * t, roundoff(300) * 10);
    EXPECT_NEAR(sim.spheres().position.y[0], -0.4 * 9.81 * t * t, roundoff(300) * 10);
}

GRAINFIELD_FOR_ALL_KERNELS(Ledger);

}  // namespace
}  // namespace grainfield::core
