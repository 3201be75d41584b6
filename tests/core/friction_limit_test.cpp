// Friction of bodies that differ, and what becomes of a spring whose contact turns or opens.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

using FrictionLimit = KernelTest;
using TurnedSpring = KernelTest;
using GoneSpring = KernelTest;

constexpr double small_radius = 0.6 * test_radius;
constexpr double step = 1e-4;  // [s]
const Vec3 direction = Vec3(2, -1, 2) / 3.0;

/// Two unlike spheres that overlap by so much of their reach.
Scene overlapping_pair(double overlap, double friction, double stiffness_j) {
    const double reach = test_radius + small_radius;
    Scene scene = scene_of({Ball{}, Ball{.x = (1 - overlap) * reach * direction,
                                         .radius = small_radius,
                                         .stiffness = stiffness_j}},
                           friction);
    scene.stiffness_ratio = 0.5;
    return scene;
}

/// A sphere that overlaps with a floor by so much of its radius; another is far away.
Scene resting(double overlap, double friction_wall, double stiffness_far) {
    Scene scene = scene_of({Ball{}, Ball{.x = Vec3(1, 0, 0), .stiffness = stiffness_far}}, 0.7);
    scene.stiffness_ratio = 0.5;
    scene.walls = {plane(-(1 - overlap) * test_radius * direction, direction, friction_wall, 0.2)};
    return scene;
}

TEST_P(FrictionLimit, OfTwoSpheresIsThatOfTheSmoother) {
    // Slip of 1e-3 m in a step against an overlap of 8e-4 m: K_s/K_n of it, 0.6 F_n, is beyond 0.3
    // and not beyond 0.7. The overlap comes in with the round-off of the reach, 100 times it.
    for (const bool first_is_smoother : {false, true}) {
        Scene scene = overlapping_pair(0.01, 0.7, test_stiffness);
        scene.spheres.friction_angle[first_is_smoother ? 0 : 1] = std::atan(0.3);
        scene.spheres.velocity.set(1, 10.0 * direction.unitOrthogonal());
        Simulation sim(std::move(scene), table());
        run_steps(sim, step, 1);
        sim.compute_forces();
        const std::vector<TouchingContact> contacts = sim.contacts().touching();
        ASSERT_EQ(contacts.size(), 1u);
        const Vec3 normal = (sim.spheres().position[1] - sim.spheres().position[0]).normalized();
        const double pressed = -contacts[0].force.dot(normal);
        EXPECT_NEAR(contacts[0].shear.norm(), 0.3 * pressed, roundoff(2000) * pressed);
    }
}

TEST_P(FrictionLimit, OnAWallIsThatOfTheSmoother) {
    for (const double stiffness_far : {test_stiffness, 2 * test_stiffness})
        for (const double wall : {0.05, 20.0}) {
            Scene scene = resting(0.01, wall, stiffness_far);
            // As above, the wall's springs being a third as stiff; more slip for the rough wall.
            scene.spheres.velocity.set(0, (wall < 1 ? 10.0 : 100.0) * direction.unitOrthogonal());
            Simulation sim(std::move(scene), table());
            run_steps(sim, step, 1);
            sim.compute_forces();
            const std::vector<TouchingContact> contacts = sim.contacts().touching();
            ASSERT_EQ(contacts.size(), 1u);
            const double pressed = contacts[0].force.dot(direction);
            EXPECT_NEAR(contacts[0].shear.norm(), std::min(0.7, wall) * pressed,
                        roundoff(2000) * pressed);
        }
}

TEST_P(TurnedSpring, OnAWallTurnsByHalfTheSpinAboutTheNormal) {
    // The wall does not turn, the sphere does: their contact by the mean. The force moves the
    // sphere by 3e-8 m in the step, which changes a spring of 7 kN/m by 1e-4 of its force.
    constexpr double angle = 0.06;  // of the sphere [rad]
    Scene scene = resting(1e-3, 1e6, test_stiffness);
    std::fill(scene.spheres.friction_angle.begin(), scene.spheres.friction_angle.end(),
              std::atan(1e6));
    scene.spheres.spin.set(0, angle / step * direction);
    Simulation sim(std::move(scene), table());
    sim.compute_forces();
    const Vec3 shear = 4.0 * direction.unitOrthogonal();
    ASSERT_TRUE(sim.change().restore_shear(0, -1, shear));
    sim.compute_forces();
    sim.advance(step);
    sim.compute_forces();
    const Vec3 expected = Eigen::AngleAxisd(0.5 * angle, direction) * shear;
    ASSERT_EQ(sim.contacts().count(), 1);
    EXPECT_LT((sim.contacts().touching()[0].shear - expected).norm(), 1e-3 * shear.norm());
}

/// Work of friction since the start [J].
double slipped(Simulation& sim) {
    sim.compute_forces(true);
    return sim.energy().friction_work;
}

TEST_P(GoneSpring, OfTwoSpheresIsDissipated) {
    // All of the energy in the shear spring, S^2/(2 K_s), is gone once the spheres are apart. A few
    // dozen operations.
    constexpr double reach = test_radius + small_radius;
    for (const auto& [stiffness, rebuilt] :
         {std::pair{test_stiffness, false}, {3 * test_stiffness, false}, {test_stiffness, true}}) {
        const Scene scene = overlapping_pair(1e-3, 1e6, stiffness);
        const double kn = 0.5 * reach * test_stiffness * stiffness / (test_stiffness + stiffness);
        Simulation sim(scene, table(), {.ledger = true});
        sim.compute_forces();
        const Vec3 shear = 4.0 * direction.unitOrthogonal();
        ASSERT_TRUE(sim.change().restore_shear(0, 1, shear));
        const double stored = 0.5 * shear.squaredNorm() / (scene.stiffness_ratio * kn);
        EXPECT_NEAR(slipped(sim), 0, roundoff(100) * stored);
        EXPECT_NEAR(sim.contacts().sums().elastic_shear, stored, roundoff(100) * stored);
        // Pulled apart by twice the overlap in one step.
        sim.change().add_velocities([&](std::size_t i, const Vec3&) -> Vec3 {
            return (i == 0 ? -1e-3 : 1e-3) * reach / step * direction;
        });
        const double before = slipped(sim);
        sim.advance(step);
        if (rebuilt) sim.change().rebuild_lists();  // which find them apart
        const double after = slipped(sim);
        ASSERT_EQ(sim.contacts().count(), 0);
        EXPECT_NEAR(after - before, stored, roundoff(100) * stored);
    }
}

TEST_P(GoneSpring, OfTwoSpheresThatWereApartIsDissipatedAndForgotten) {
    // Apart when the lists are built, together, apart, together again, each in one step; all the
    // while they slide along each other. The force moves them by 1e-7 m in a step.
    constexpr double reach = test_radius + small_radius, gap = 0.05 * reach;
    Scene scene = overlapping_pair(-0.05, 1e6, test_stiffness);
    scene.spheres.velocity.set(1, 1e-4 / step * direction.unitOrthogonal());
    const double ks = scene.stiffness_ratio * 0.25 * reach * test_stiffness;
    Simulation sim(std::move(scene), table(), {.skin = 0.4 * test_radius, .ledger = true});
    sim.compute_forces();
    const auto turn_back = [&](double way) {
        sim.change().add_velocities([&](std::size_t i, const Vec3&) -> Vec3 {
            return (i == 0 ? -0.5 : 0.5) * way / step * direction;
        });
    };
    turn_back(-1.2 * gap);
    std::array<double, 2> stored{};
    for (double& energy : stored) {
        sim.advance(step);
        sim.compute_forces();
        ASSERT_EQ(sim.contacts().count(), 1);
        energy = 0.5 * sim.contacts().touching()[0].shear.squaredNorm() / ks;
        EXPECT_GT(energy, 0.0);
        const double before = slipped(sim);
        turn_back(2.4 * gap);
        sim.advance(step);
        const double after = slipped(sim);
        ASSERT_EQ(sim.contacts().count(), 0);
        EXPECT_NEAR(after - before, energy, roundoff(100) * energy);
        turn_back(-2.4 * gap);
    }
    // The second time some more, as the normal has turned; four times as much with the old spring.
    EXPECT_NEAR(stored[1], stored[0], 0.5 * stored[0]);
    EXPECT_EQ(sim.stats().list_builds(), 1);
}

TEST_P(GoneSpring, OnAWallIsDissipated) {
    for (const auto& [stiffness_far, rebuilt] :
         {std::pair{test_stiffness, false}, {2 * test_stiffness, false}, {test_stiffness, true}}) {
        Scene scene = resting(1e-3, 1e6, stiffness_far);
        std::fill(scene.spheres.friction_angle.begin(), scene.spheres.friction_angle.end(),
                  std::atan(1e6));
        const double a = scene.stiffness_ratio * test_stiffness, b = 0.2 * test_stiffness;
        const double ks = test_radius * a * b / (a + b);
        Simulation sim(std::move(scene), table(), {.ledger = true});
        sim.compute_forces();
        const Vec3 shear = 4.0 * direction.unitOrthogonal();
        ASSERT_TRUE(sim.change().restore_shear(0, -1, shear));
        const double stored = 0.5 * shear.squaredNorm() / ks;
        const double before = slipped(sim);
        EXPECT_NEAR(sim.contacts().sums().elastic_shear, stored, roundoff(100) * stored);
        // The wall leaves by twice the overlap in one step, and is back in the next.
        sim.set_wall_velocity(0, -2e-3 * test_radius / step * direction);
        sim.advance(step);
        if (rebuilt) sim.change().rebuild_lists();
        const double after = slipped(sim);
        ASSERT_EQ(sim.contacts().count(), 0);
        EXPECT_NEAR(after - before, stored, roundoff(100) * stored);
        sim.set_wall_velocity(0, 2e-3 * test_radius / step * direction);
        sim.advance(step);
        sim.compute_forces();
        ASSERT_EQ(sim.contacts().count(), 1);
        // In two steps the sphere has gone 1e-7 m, which stretches a spring by 1e-3 N.
        EXPECT_LT(sim.contacts().touching()[0].shear.norm(), 1e-2 * shear.norm());
    }
}

GRAINFIELD_FOR_ALL_KERNELS(FrictionLimit);
GRAINFIELD_FOR_ALL_KERNELS(TurnedSpring);
GRAINFIELD_FOR_ALL_KERNELS(GoneSpring);

}  // namespace
}  // namespace grainfield::core
