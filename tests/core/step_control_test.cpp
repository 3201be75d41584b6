// When the step control looks again, what it does for new neighbours, and the masses it chooses.

#include "core/drive/step_control.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

using StepChoice = KernelTest;
using MassScaling = KernelTest;
using LocalFrequency = KernelTest;
using InertiaScale = KernelTest;

TimeOptions scaling(double factor) {
    return {.step = std::nullopt, .safety = 0.8, .mass_scaling = factor};
}

/// 64 spheres that overlap or, with a spacing beyond 1, do not touch; one is `hardness` times as
/// hard as the others.
Scene cluster(double spacing, double hardness) {
    Scene scene = scene_of(loose_balls({4, 4, 4}, spacing, 0.0), 0.5);
    scene.spheres.normal_stiffness[21] *= hardness;
    return scene;
}

TEST_P(StepChoice, LooksAgainAfterTwentyStepsOrWhenTold) {
    Simulation sim(cluster(0.8, 1.0), table());
    sim.compute_forces();
    StepControl control({});
    EXPECT_TRUE(control.due(sim));
    const double step = control.next(sim);
    EXPECT_FALSE(control.due(sim));
    run_steps(sim, 1e-9, 19);
    EXPECT_FALSE(control.due(sim));
    EXPECT_EQ(control.next(sim), step);
    run_steps(sim, 1e-9, 1);
    EXPECT_TRUE(control.due(sim));
    sim.compute_forces();
    control.next(sim);
    EXPECT_FALSE(control.due(sim));
    control.reset();
    EXPECT_TRUE(control.due(sim));
}

// docs/method.md, section 3: 1.2 - alpha/2 of the safety, between 0.8 and all of it.
TEST_P(StepChoice, LeavesRoomForDampingOfForcesAndOfMoments) {
    for (const auto& [alpha, share] : {std::pair{0.0, 1.0}, {0.2, 1.0}, {0.6, 0.9}, {0.9, 0.8}})
        for (const bool of_moments : {false, true}) {
            Scene scene = cluster(0.8, 1.0);
            scene.damping = of_moments ? Damping{.force = 0, .moment = alpha}
                                       : Damping{.force = alpha, .moment = 0};
            Simulation sim(std::move(scene), table());
            sim.compute_forces();
            StepControl control({.step = std::nullopt, .safety = 0.7});
            const double step = control.next(sim);
            EXPECT_NEAR(step, 0.7 * share * control.limit(), 1e-12 * step) << alpha;
        }
}

// One sphere on a wall: omega^2 = K_n/m (k_s below k_n/3.5), the limit 2/omega.
TEST_P(StepChoice, SaysThatAFixedStepIsAboveTheLimit) {
    Scene scene = scene_of({Ball{.radius = 0.1, .stiffness = 1e7}}, 0.1);
    scene.walls = {plane(Vec3(0, -0.0999999, 0), Vec3::UnitY())};
    Simulation sim(scene, table());
    sim.compute_forces();
    const double limit = 2 / FrequencyEstimator().estimate(sim);
    for (const double share : {0.9, 1.1}) {
        StepControl control({.step = share * limit});
        EXPECT_TRUE(control.due(sim));
        EXPECT_EQ(control.next(sim), share * limit);
        EXPECT_FALSE(control.due(sim));
        EXPECT_EQ(control.limit(), 0.0) << "nothing is steered by it";
        EXPECT_NEAR(control.exceeded_limit(), share > 1 ? limit : 0, 1e-3 * limit);
        EXPECT_EQ(control.exceeded_text().empty(), share < 1);
    }
    StepControl control({.step = 1.1 * limit});
    control.next(sim);
    EXPECT_THAT(control.exceeded_text(),
                testing::AllOf(testing::HasSubstr(fmt::format("{:.4g} s is above", 1.1 * limit)),
                               testing::HasSubstr(fmt::format("2/omega_max of {:.3g}", limit))));
}

TEST_P(StepChoice, FollowsNeighboursThatAreNewBetweenTwoEstimates) {
    // A small hard sphere between two soft heavy ones; then a hard wall comes near, a second
    // contact that is faster than both.
    constexpr double small = 0.005, large = 0.012, soft = 1e6, hard = 1e9;
    const double reach = small + large + 1e-6;
    Scene scene = scene_of({Ball{.x = Vec3(-reach, 0, 0), .radius = large, .stiffness = soft},
                            Ball{.radius = small, .stiffness = hard},
                            Ball{.x = Vec3(reach, 0, 0), .radius = large, .stiffness = soft}});
    scene.walls = {plane(Vec3(0, -1, 0), Vec3::UnitY())};
    scene.walls[0].normal_stiffness = hard;
    Simulation sim(std::move(scene), table());
    sim.compute_forces();
    StepControl control({});
    const double m = sphere_mass(small);
    const double by_sphere =
        0.5 * (small + large) * soft * hard / (soft + hard) * (1 / m + 1 / sphere_mass(large));
    const double by_wall = small * 0.5 * hard / m;
    // Closed forms of a few operations.
    const double before = 0.8 * 2 / std::sqrt(2 * by_sphere);
    EXPECT_NEAR(control.next(sim), before, 1e-12 * before);
    sim.change().set_wall_point(0, Vec3(0, -2.9 * small, 0));
    sim.compute_forces();
    ASSERT_FALSE(control.due(sim));
    const double after = 0.8 * 2 / std::sqrt(by_wall + by_sphere);
    EXPECT_NEAR(control.next(sim), after, 1e-12 * after);
}

TEST_P(MassScaling, TakesNoMoreMassThanTheStepNeeds) {
    for (const double spacing : {0.8, 1.1}) {  // with and without contacts
        Simulation sim(cluster(spacing, 50.0), table());
        sim.compute_forces();
        const double step = StepControl(scaling(1.0)).next(sim);
        StepControl control(scaling(3.0));
        EXPECT_NEAR(control.next(sim), 3 * step, 1e-6 * step) << spacing;
        // Nothing gets lighter than it is.
        double real = 0, inertial = 0;
        std::size_t heavier = 0;
        for (std::size_t i = 0; i < sim.size(); ++i) {
            const double mass = sim.spheres().mass[i],
                         scaled = 1 / sim.sphere(i).inverse_inertial_mass();
            EXPECT_GE(scaled, mass * (1 - 1e-12)) << i;
            heavier += scaled > 1.01 * mass;
            real += mass;
            inertial += scaled;
        }
        EXPECT_GE(heavier, 1u);
        EXPECT_NEAR(control.inertia_ratio(), inertial / real, 1e-12 * inertial / real);
        if (spacing > 1) continue;
        // The margin grows by a tenth at a time, the frequency falls by its root.
        const double target = 2 * 0.8 / (3 * step);
        const double omega = std::max(FrequencyEstimator().estimate(sim), caged_frequency(sim, 0));
        EXPECT_LE(omega, 1.01 * target);
        EXPECT_GE(omega, 0.94 * target);
    }
}

TEST_P(MassScaling, FollowsANetworkThatGetsFaster) {
    const auto harden = [](Simulation& sim) {
        std::vector<double> stiffness(sim.size(), test_stiffness);
        stiffness[21] *= 50;
        sim.change().set_properties(stiffness, std::vector<double>(sim.size(), std::atan(0.5)));
        sim.compute_forces();
    };
    Simulation sim(cluster(0.8, 1.0), table());
    sim.compute_forces();
    StepControl control(scaling(3.0));
    control.next(sim);
    run_steps(sim, 1e-9, 20);
    harden(sim);
    Simulation unscaled(cluster(0.8, 1.0), table());
    harden(unscaled);
    const double step = StepControl(scaling(1.0)).next(unscaled);
    // Lanczos finds either frequency to half a per cent.
    EXPECT_NEAR(control.next(sim), 3 * step, 0.02 * step);
    EXPECT_LE(FrequencyEstimator().estimate(sim), 1.01 * 2 * 0.8 / (3 * step));
}

TEST_P(LocalFrequency, OfASphereBetweenTwoWalls) {
    // Along the normals 2 K_n/m; across 2 K_s/m; about an axis across, both walls as gears,
    // 2 K_s R^2/I = 5 K_s/m.
    for (const double ratio : {0.1, 1.0}) {
        Scene scene = scene_of({Ball{}}, 0.5);
        scene.stiffness_ratio = ratio;
        for (const double side : {-1.0, 1.0})
            scene.walls.push_back(
                plane(Vec3(0.999 * side * test_radius, 0, 0), Vec3(-side, 0, 0), 0.5, ratio));
        Simulation sim(std::move(scene), table());
        sim.compute_forces();
        const double kn = 0.5 * test_radius * test_stiffness, m = sphere_mass(test_radius);
        const double expected = std::max(2.0, 5 * ratio) * kn / m;
        EXPECT_NEAR(local_square_frequencies(sim)[0], expected, 1e-12 * expected);
    }
}

TEST_P(InertiaScale, LeavesTheWeightAsItIs) {
    Scene scene = scene_of({Ball{}, Ball{.x = Vec3(1, 0, 0)}}, 0.5);
    scene.gravity = Vec3(0.5, -9.81, 2);
    Simulation sim(std::move(scene), table());
    sim.change().set_inertia_scale(std::vector<double>{3.0, 1.0});
    const double m = sphere_mass(test_radius), step = 1e-3;
    EXPECT_NEAR(sim.sphere(0).inverse_inertia() * 0.4 * 3 * m * test_radius * test_radius, 1,
                1e-15 * 10);
    sim.compute_forces();
    EXPECT_LT((sim.sphere(0).resultant() - m * sim.scene().gravity).norm(), roundoff(10) * 10 * m);
    sim.advance(step);
    // Leapfrog from rest: the first half step.
    const Vec3 expected = 0.5 * step * sim.scene().gravity / 3;
    EXPECT_LT((sim.spheres().velocity[0] - expected).norm(), roundoff(10) * expected.norm());
    EXPECT_LT((sim.spheres().velocity[1] - 3 * expected).norm(), roundoff(30) * expected.norm());
}

GRAINFIELD_FOR_ALL_KERNELS(StepChoice);
GRAINFIELD_FOR_ALL_KERNELS(MassScaling);
GRAINFIELD_FOR_ALL_KERNELS(LocalFrequency);
GRAINFIELD_FOR_ALL_KERNELS(InertiaScale);

}  // namespace
}  // namespace grainfield::core
