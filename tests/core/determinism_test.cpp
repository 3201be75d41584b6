// The state is the same, bit for bit, for any number of threads, any skin and age of the lists,
// with or without sums and ledger.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/drive/servo.hpp"
#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

struct Run {
    int threads = 1;
    double skin = 0;
    bool ledger = false, sums = false;
    int steps = 300;
};

/// A frictional, damped collapse in a box with a moving lid; two properties alternate.
Scene collapse(std::array<int, 3> n) {
    std::vector<Ball> balls = loose_balls(n, 1.03, 0.5);
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].w = 5.0 * random_vec(i, 9);
    for (std::size_t i = 0; i < balls.size(); i += 2) balls[i].stiffness *= 3;
    Scene scene = scene_of(balls, 0.5);
    scene.walls = box_walls(loose_box(n, 1.03), plane(Vec3::Zero(), Vec3::UnitX(), 0.3));
    scene.gravity = Vec3(0, -9.81, 0);
    scene.damping = {0.2, 0.2};
    return scene;
}

std::string hash_after(const Scene& scene, const kernels::KernelTable& table, const Run& run) {
    omp_set_num_threads(run.threads);
    Simulation sim(scene, table, {.skin = run.skin, .ledger = run.ledger});
    const double height = scene.walls[3].point.y();
    WallServo servo(
        3, {.stress = 2000, .max_speed = 0.5, .gain = 0.8, .integral = 0.02, .present = 1});
    for (int k = 0; k < run.steps; ++k) {
        sim.compute_forces(run.sums);
        servo.steer(sim, height * height, 2e-4);
        sim.advance(2e-4);
    }
    sim.compute_forces();
    EXPECT_GT(sim.contacts().count(), static_cast<std::int64_t>(sim.spheres().size()) / 10);
    omp_set_num_threads(1);
    return sim.state_hash();
}

/// Largest distance between the centres of two states [m].
double distance(const ParticleStore& a, const ParticleStore& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, (a.position[i] - b.position[i]).norm());
    return largest;
}

using Determinism = KernelTest;

TEST_P(Determinism, ThreadsDoNotMatter) {
    // Large enough that loops over spheres (5,100) and over candidates run in parallel.
    const Scene scene = collapse({18, 15, 19});
    const std::string one = hash_after(scene, table(), {});
    for (int threads : {2, 3, 4})
        EXPECT_EQ(hash_after(scene, table(), {.threads = threads}), one) << threads;
}

TEST_P(Determinism, SkinDoesNotMatter) {
    // 14 x 14 spheres at each of six walls: more wall candidates than a chunk holds.
    const Scene scene = collapse({14, 8, 14});
    if (!is_reference()) {
        // Displacements since the last build are rounded: the lists show in the last digits. They
        // grow from impact to impact, in 100 steps by less than this.
        const auto after = [&](double skin) {
            Simulation sim(scene, table(), {.skin = skin});
            run_steps(sim, 2e-4, 100);
            return sim.spheres();
        };
        const ParticleStore usual = after(0);
        for (double skin : {0.01, 0.2, 1.0})
            EXPECT_LT(distance(after(skin * test_radius), usual), roundoff(2e3) * test_radius);
        return;
    }
    const std::string usual = hash_after(scene, table(), {});
    for (double skin : {0.01, 0.2, 1.0})
        EXPECT_EQ(hash_after(scene, table(), {.skin = skin * test_radius}), usual) << skin;
}

TEST_P(Determinism, LookingDoesNotMatter) {
    const Scene scene = collapse({9, 8, 9});
    const std::string usual = hash_after(scene, table(), {.steps = 1000});
    EXPECT_EQ(hash_after(scene, table(), {.steps = 1000}), usual);
    EXPECT_EQ(hash_after(scene, table(), {.sums = true, .steps = 1000}), usual);
    EXPECT_EQ(hash_after(scene, table(), {.ledger = true, .steps = 1000}), usual);
}

/// What a change that shall change nothing must leave as it is. Where results change on purpose,
/// the new hashes are taken over, and the change's message says why.
TEST_P(Determinism, HashesAreThosePinned) {
    // AVX2 and AVX-512 have fused multiply-add and the same order of every sum: the same bits.
    const std::string fused_double = "c1fb901225aa2a4e", fused_mixed = "e0c594dfd7efd3b0";
    const std::map<std::string, std::string> pinned = {
        {"reference", "53784388c36f2bf2"},    {"scalar_double", "e36959224c682a81"},
        {"scalar_mixed", "b32681004eb9a41c"}, {"avx2_double", fused_double},
        {"avx2_mixed", fused_mixed},          {"avx512_double", fused_double},
        {"avx512_mixed", fused_mixed},
    };
    EXPECT_EQ(hash_after(collapse({9, 8, 9}), table(), {.steps = 1000}),
              pinned.at(GetParam().name));
}

TEST_P(Determinism, TheHashSeesEveryPartOfTheState) {
    const Scene scene = collapse({4, 4, 4});
    const auto hash = [&](const Scene& changed) {
        Simulation sim(changed, table());
        sim.compute_forces();
        return sim.state_hash();
    };
    const std::string usual = hash(scene);
    Scene changed = scene;
    changed.spheres.position.y[7] = std::nextafter(changed.spheres.position.y[7], 1.0);
    EXPECT_NE(hash(changed), usual);
    changed = scene;
    changed.spheres.spin.z[63] *= 2;
    EXPECT_NE(hash(changed), usual);
    changed = scene;
    changed.walls[2].velocity.x() = 1e-9;
    EXPECT_NE(hash(changed), usual);
}

TEST_P(Determinism, EqualPropertiesPerSphereGiveTheUniformResult) {
    // One sphere far away with properties of its own makes the kernels read properties sphere by
    // sphere; the others must not notice.
    std::vector<Ball> balls = loose_balls({6, 6, 6}, 1.03, 0.5);
    balls.push_back({.x = Vec3(100, 100, 100)});
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].w = 5.0 * random_vec(i, 9);
    const auto end_state = [&](double stiffness, double friction) {
        Scene scene = scene_of(balls, 0.5);
        scene.spheres.normal_stiffness.back() = stiffness;
        scene.spheres.friction_angle.back() = std::atan(friction);
        scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.3)};
        scene.gravity = Vec3(0, -9.81, 0);
        scene.damping = {0.2, 0.2};
        Simulation sim(std::move(scene), table());
        run_steps(sim, 2e-4, is_reference() ? 1000 : 100);
        sim.compute_forces();
        EXPECT_GT(sim.contacts().count(), is_reference() ? 100 : 0);
        return std::pair(sim.state_hash(), sim.spheres());
    };
    const auto uniform = end_state(test_stiffness, 0.5);
    for (const auto& per_sphere :
         {end_state(2 * test_stiffness, 0.5), end_state(test_stiffness, 0.2)}) {
        if (is_reference())
            EXPECT_EQ(per_sphere.first, uniform.first);
        else  // k k/(k + k) is rounded once more than k/2
            EXPECT_LT(distance(per_sphere.second, uniform.second), roundoff(2e3) * test_radius);
    }
}

GRAINFIELD_FOR_ALL_KERNELS(Determinism);

}  // namespace
}  // namespace grainfield::core
