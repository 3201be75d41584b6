// A simulation that is saved between two steps and loaded elsewhere goes on to the same bits.

#include <gtest/gtest.h>
#include <omp.h>

#include <cereal/archives/binary.hpp>
#include <random>
#include <sstream>

#include "core/base/errors.hpp"
#include "core/drive/driver.hpp"
#include "core/drive/servo.hpp"
#include "tests/core/test_scenes.hpp"
#include "tests/reliability/record.hpp"

namespace grainfield::core {
namespace {

/// 3,375 spheres of mixed sizes that fly about in a box, hit each other and two walls that close
/// in: three domains for the vector engine, lists that are built often, sphere by sphere too.
Scene crowded_scene() {
    std::vector<Ball> balls;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(-1, 1);
    for (int k = 0; k < 3375; ++k)
        balls.push_back(
            {.x = 2.1 * test_radius * Vec3(k % 15 + 0.5, k / 15 % 15 + 0.5, k / 225 + 0.5),
             .v = Vec3(share(random), share(random), share(random)),
             .w = Vec3(share(random), share(random), share(random)),
             .radius = test_radius * (0.85 + 0.15 * share(random)),
             .stiffness = 100 * test_stiffness * (1.5 + share(random))});
    Scene scene = scene_of(balls, 0.4);
    scene.damping = {0.2, 0.1};
    scene.gravity = Vec3(0, -9.81, 0);
    const double edge = 2.1 * test_radius * 15;
    scene.walls =
        box_walls({Vec3::Zero(), Vec3::Constant(edge)}, plane(Vec3::Zero(), Vec3::UnitX(), 0.2));
    return scene;
}

constexpr int total = 400;

/// Steps `n` times, as a servo, a fast wall and somebody who looks now and then would have it.
void go_on(Driver& driver, WallServo& servo, std::int64_t until) {
    Simulation& sim = driver.simulation();
    while (sim.steps() < until) {
        const bool look = sim.steps() % 30 == 0;
        driver.step(look, [&](double step) {
            sim.set_wall_velocity(0, Vec3(sim.steps() % 200 < 100 ? 0.8 : -0.8, 0, 0));
            servo.steer(sim, 1.0, step);
            if (look && sim.steps() % 60 == 0) sim.change().scale_velocities(0.97);
        });
    }
}

struct Driven {
    Simulation sim;
    Monitor monitor;
    Driver driver;
    WallServo servo{3, {.stress = 2e3, .max_speed = 1.0}};

    Driven(Scene scene, const kernels::KernelTable& table, bool ledger)
        : sim(std::move(scene), table, {.ledger = ledger}),
          driver(sim, {.step = {}, .safety = 0.8, .mass_scaling = 1.5}, monitor) {}
    void save(std::ostream& out) {
        StateWriter archive(out);
        sim.save(archive);
        archive(driver.control(), servo);
    }
    void load(std::istream& in) {
        StateReader archive(in);
        sim.load(archive);
        archive(driver.control(), servo);
    }
};

class SimulationState : public KernelTest {
  protected:
    void TearDown() override { omp_set_num_threads(threads_); }
    int threads_ = omp_get_max_threads();
};

TEST_P(SimulationState, GoesOnToTheSameBitsFromAnyStep) {
    for (const bool ledger : {false, true}) {
        Driven undisturbed(crowded_scene(), table(), ledger);
        go_on(undisturbed.driver, undisturbed.servo, total);
        const std::string hash = undisturbed.sim.state_hash();
        EXPECT_GT(undisturbed.sim.stats().list_builds(), 20);
        undisturbed.sim.compute_forces(true);
        const double closing = undisturbed.sim.energy().closing();

        std::mt19937 random(ledger ? 2 : 1);
        for (int trial = 0; trial < 3; ++trial) {
            const auto at = static_cast<std::int64_t>(random() % total);
            std::stringstream file;
            {
                omp_set_num_threads(1 + trial % 2);
                Driven first(crowded_scene(), table(), ledger);
                go_on(first.driver, first.servo, at);
                first.save(file);
                // Whoever is saved goes on undisturbed, too.
                if (trial == 0) {
                    go_on(first.driver, first.servo, total);
                    EXPECT_EQ(first.sim.state_hash(), hash) << at;
                }
            }
            omp_set_num_threads(2 - trial % 2);
            Driven second(Scene{}, table(), !ledger);
            second.load(file);
            EXPECT_EQ(second.sim.steps(), at);
            EXPECT_EQ(second.sim.keeps_ledger(), ledger);
            go_on(second.driver, second.servo, total);
            EXPECT_EQ(second.sim.state_hash(), hash) << at;
            const std::string same = reliability::same(second.sim.state_hash(), hash);
            second.sim.compute_forces(true);
            EXPECT_EQ(second.sim.time(), undisturbed.sim.time());
            EXPECT_EQ(second.sim.stats().list_builds(), undisturbed.sim.stats().list_builds());
            EXPECT_EQ(second.sim.stats().searches(), undisturbed.sim.stats().searches());
            EXPECT_EQ(second.sim.stats().partial_rebuilds(),
                      undisturbed.sim.stats().partial_rebuilds());
            EXPECT_EQ(second.sim.energy().closing(), closing);
            reliability::record("restarts", {{"of", "3,375 spheres between walls that close in"},
                                             {"kernels", GetParam().name},
                                             {"step", std::to_string(at)},
                                             {"steps", std::to_string(total)},
                                             {"threads", std::to_string(1 + trial % 2)},
                                             {"threads_after", std::to_string(2 - trial % 2)},
                                             {"same", same}});
        }
    }
}

TEST_P(SimulationState, KeepsContactsWithTheirShearForces) {
    Driven run(crowded_scene(), table(), false);
    go_on(run.driver, run.servo, 150);
    std::stringstream file;
    run.save(file);
    Driven other(Scene{}, table(), false);
    other.load(file);
    run.sim.compute_forces(true);
    other.sim.compute_forces(true);
    const auto ours = run.sim.contacts().touching(), theirs = other.sim.contacts().touching();
    ASSERT_EQ(ours.size(), theirs.size());
    ASSERT_GT(ours.size(), 200U);
    double shear = 0;
    for (std::size_t k = 0; k < ours.size(); ++k) {
        EXPECT_EQ(ours[k].i, theirs[k].i);
        EXPECT_EQ(ours[k].j, theirs[k].j);
        EXPECT_EQ(ours[k].shear, theirs[k].shear);
        EXPECT_EQ(ours[k].force, theirs[k].force);
        shear += ours[k].shear.norm();
    }
    EXPECT_GT(shear, 0);
}

TEST_P(SimulationState, OfOtherKernelsIsRefused) {
    Driven run(crowded_scene(), table(), false);
    std::stringstream file;
    run.save(file);
    const kernels::KernelTable& other_table =
        is_reference() ? *kernels::mixed_table(kernels::InstructionSet::scalar)
                       : kernels::reference_kernels();
    Driven other(Scene{}, other_table, false);
    EXPECT_THROW(other.load(file), InputError);
}

GRAINFIELD_FOR_ALL_KERNELS(SimulationState);

}  // namespace
}  // namespace grainfield::core
