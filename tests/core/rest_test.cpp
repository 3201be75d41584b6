// Spheres at rest: under gravity, in a column, squeezed between walls; gears in contact.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/drive/measures.hpp"
#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

using AtRest = KernelTest;

/// Steps with damping until all motion is gone: local damping takes a fixed share a cycle.
void settle(Simulation& sim, double step, int steps) {
    run_steps(sim, step, steps);
    sim.compute_forces(true);
}

TEST_P(AtRest, OverlapCarriesTheWeight) {
    Scene scene = scene_of({Ball{.x = Vec3(0, test_radius, 0)}}, 0.6);
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.6)};
    scene.gravity = Vec3(0, -g, 0);
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table());
    settle(sim, 0.1 * std::sqrt(test_mass / test_kn), 20000);
    const double overlap = test_radius - sim.spheres().position.y[0];
    // Local damping stops at round-off of the position, which is 100 times the overlap.
    EXPECT_NEAR(overlap, test_mass * g / test_kn, roundoff(1e5) * test_mass * g / test_kn);
    EXPECT_NEAR(sim.wall_loads()[0].force.y(), -test_mass * g, roundoff(1e5) * test_mass * g);
    EXPECT_EQ(sim.wall_loads()[0].stiffness, test_kn);
    EXPECT_EQ(sim.wall_loads()[0].contacts, 1);
    EXPECT_LT(sim.unbalanced_force_ratio(), roundoff(1e5));
}

TEST_P(AtRest, ColumnCarriesAllAbove) {
    const int n = 7;
    std::vector<Ball> balls;
    for (int k = 0; k < n; ++k) balls.push_back({.x = Vec3(0, (2 * k + 1) * test_radius, 0)});
    Scene scene = scene_of(balls, 0.6);
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.6)};
    scene.gravity = Vec3(0, -g, 0);
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table());
    settle(sim, 0.1 * std::sqrt(test_mass / test_kn), 60000);
    double below = -test_radius;
    for (int k = 0; k < n; ++k) {
        const double y = sim.spheres().position.y[static_cast<std::size_t>(k)];
        const double overlap = 2 * test_radius - (y - below);
        const double expected = (n - k) * test_mass * g / test_kn;
        EXPECT_NEAR(overlap, expected, roundoff(1e7) * expected) << k;
        below = y;
    }
    EXPECT_NEAR(-sim.wall_loads()[0].force.y(), n * test_mass * g,
                roundoff(1e7) * n * test_mass * g);
}

TEST_P(AtRest, TwoSpheresSqueezedBetweenWallsAreSpringsInSeries) {
    // Unequal radii and stiffnesses: Eq. (4) of Tran et al. for each of the three contacts.
    const Ball a{.x = Vec3(0, 0.05, 0), .radius = 0.05, .stiffness = 1e6};
    const Ball b{.x = Vec3(0, 0.13, 0), .radius = 0.03, .stiffness = 3e6};
    const double squeeze = 1e-3;
    for (const Eigen::Matrix3d& turn :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), some_rotation()}) {
        Scene scene = scene_of({a, b}, 0.3);
        for (std::size_t i = 0; i < 2; ++i)
            scene.spheres.position.set(i, turn * scene.spheres.position[i]);
        scene.walls = {plane(Vec3::Zero(), turn * Vec3(0, 1, 0), 0.3),
                       plane(turn * Vec3(0, 0.16 - squeeze, 0), turn * Vec3(0, -1, 0), 0.3)};
        scene.walls[1].normal_stiffness = 5e6;
        scene.damping = {0.2, 0.2};
        Simulation sim(std::move(scene), table());
        settle(sim, 0.1 * std::sqrt(sphere_mass(0.03) / (0.03 * 3e6)), 40000);
        const double ka = 0.05 * 1e6 * 1e6 / 2e6, kb = 0.03 * 3e6 * 5e6 / 8e6;
        const double kab = 0.04 * 1e6 * 3e6 / 4e6;
        const double force = squeeze / (1 / ka + 1 / kb + 1 / kab);
        EXPECT_NEAR(sim.wall_loads()[0].force.norm(), force, roundoff(1e6) * force);
        EXPECT_NEAR(sim.wall_loads()[1].force.norm(), force, roundoff(1e6) * force);
        const Vec3 x = turn.transpose() * sim.spheres().position[0];
        EXPECT_NEAR(0.05 - x.y(), force / ka, roundoff(1e6) * force / ka);
        const Energy energy = sim.energy();
        EXPECT_NEAR(energy.elastic_normal, 0.5 * force * squeeze, roundoff(1e6) * force * squeeze);
    }
}

TEST_P(AtRest, GearsTurnOnForEver) {
    // Two spheres between smooth walls at equilibrium, w and -w: no slip at the contact.
    const double overlap = 1e-3;
    const double r = 0.0625;
    Scene scene =
        scene_of({Ball{.x = Vec3(r - overlap, 0, 0), .w = Vec3(0, 2, 5), .radius = r},
                  Ball{.x = Vec3(3 * r - 2 * overlap, 0, 0), .w = Vec3(0, -2, -5), .radius = r}},
                 0.5);
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitX(), 0.0),
                   plane(Vec3(4 * r - 3 * overlap, 0, 0), -Vec3::UnitX(), 0.0)};
    Simulation sim(std::move(scene), table());
    run_steps(sim, 1e-4, 2000);
    EXPECT_EQ(sim.touching_contacts(), 3);
    for (std::size_t i = 0; i < 2; ++i) {
        const double sign = i == 0 ? 1.0 : -1.0;
        EXPECT_LT((sim.spheres().spin[i] - sign * Vec3(0, 2, 5)).norm(), roundoff(1e4) * 5);
        EXPECT_LT(sim.spheres().velocity[i].norm(), roundoff(1e6) * overlap / 1e-4);
    }
}

TEST_P(AtRest, SpinningInPlaceIsBrakedByTheTwistOnlyThroughSlip) {
    // No rolling or twisting resistance: a spin about the normal of its only contact goes on.
    const double overlap = test_mass * g / test_kn;
    Scene scene =
        scene_of({Ball{.x = Vec3(0, test_radius - overlap, 0), .w = Vec3(0, 30, 0)}}, 0.6);
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.6)};
    scene.gravity = Vec3(0, -g, 0);
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table());
    run_steps(sim, 1e-4, 5000);
    EXPECT_EQ(sim.spheres().spin[0], Vec3(0, 30, 0));
}

GRAINFIELD_FOR_ALL_KERNELS(AtRest);

}  // namespace
}  // namespace grainfield::core
