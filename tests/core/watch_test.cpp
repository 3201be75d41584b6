// What the watch over a run must notice, and what may not even be started.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/base/errors.hpp"
#include "core/drive/driver.hpp"
#include "core/scene/scene.hpp"
#include "tests/core/test_scenes.hpp"
#include "tests/reliability/record.hpp"

namespace grainfield::core {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct TestMonitor : Monitor {
    bool stop = false;
    bool stop_requested() const override { return stop; }
};

/// Ten spheres apart from each other above a floor.
Scene quiet_scene() {
    std::vector<Ball> balls;
    for (int k = 0; k < 10; ++k) balls.push_back({.x = Vec3(3 * k * test_radius, test_radius, 0)});
    Scene scene = scene_of(balls, 0.5);
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.5)};
    return scene;
}

using Watch = KernelTest;

/// Adds a velocity to one sphere [m/s].
void push(Simulation& sim, std::size_t sphere, const Vec3& velocity) {
    sim.change().add_velocities(
        [&](std::size_t i, const Vec3&) { return i == sphere ? velocity : Vec3(Vec3::Zero()); });
}

/// Runs until it fails; the message must name the sphere. Returns it.
std::string failure(Scene scene, const kernels::KernelTable& table, const std::string& sphere,
                    double step, const std::function<void(Simulation&)>& spoil) {
    TestMonitor monitor;
    Simulation sim(std::move(scene), table);
    Driver driver(sim, {.step = step}, monitor);
    const auto no_steering = [](double) {};
    try {
        for (int k = 0; k < 10; ++k) driver.step(false, no_steering);
        spoil(sim);
        for (int k = 0; k < Driver::watch_interval; ++k) driver.step(false, no_steering);
    } catch (const SimulationError& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find("sphere " + sphere), std::string::npos) << what;
        reliability::record(
            "diagnoses",
            {{"kernels", kernels::name(table.isa)},
             {"steps", std::to_string(sim.steps() > 10 ? sim.steps() - 10 : sim.steps())},
             {"message", what}});
        return what;
    }
    ADD_FAILURE() << "not noticed within " << Driver::watch_interval << " steps";
    return "";
}

TEST_P(Watch, NamesTheSphereWithANaN) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::string what = failure(quiet_scene(), table(), "7", 1e-4, [&](Simulation& sim) {
            push(sim, 7, not_a_number * Vec3::Unit(axis));
        });
        EXPECT_NE(what.find("not a number"), std::string::npos) << what;
    }
    failure(quiet_scene(), table(), "4", 1e-4, [&](Simulation& sim) {
        push(sim, 4, Vec3(0, std::numeric_limits<double>::infinity(), 0));
    });
}

TEST_P(Watch, NamesTheSphereThatMovesTooFarInAStep) {
    const std::string what = failure(quiet_scene(), table(), "3", 1e-4, [](Simulation& sim) {
        push(sim, 3, Vec3(0, 0, 0.6 * test_radius / 1e-4));
    });
    EXPECT_NE(what.find("more than half its radius"), std::string::npos) << what;
}

TEST_P(Watch, NamesTheSphereLostBehindAWall) {
    const std::string what = failure(quiet_scene(), table(), "5", 1e-4, [](Simulation& sim) {
        push(sim, 5, Vec3(0, -0.4 * test_radius / 1e-4, 0));
    });
    EXPECT_NE(what.find("lost"), std::string::npos) << what;
}

TEST_P(Watch, NamesASphereFarBehindAWall) {
    Scene scene = quiet_scene();
    scene.spheres.position.y[9] = -50.0;  // never near the wall in the run
    failure(std::move(scene), table(), "9", 1e-4, [](Simulation&) {});
}

TEST_P(Watch, NamesTheSpheresThatOverlapTooMuch) {
    Scene scene = quiet_scene();
    scene.spheres.position.set(6, scene.spheres.position[5] + Vec3(1.3 * test_radius, 0, 0));
    scene.spheres.normal_stiffness[5] = scene.spheres.normal_stiffness[6] = 1.0;
    const std::string what = failure(std::move(scene), table(), "5", 1e-4, [](Simulation&) {});
    EXPECT_NE(what.find("sphere 6"), std::string::npos) << what;
    EXPECT_NE(what.find("overlap"), std::string::npos) << what;
}

TEST_P(Watch, StopsWhenAskedTo) {
    TestMonitor monitor;
    Simulation sim(quiet_scene(), table());
    Driver driver(sim, {.step = 1e-4}, monitor);
    driver.safe_point();
    driver.step(false, [](double) {});
    monitor.stop = true;
    EXPECT_THROW(driver.safe_point(), Interrupted);
    EXPECT_EQ(sim.steps(), 1);
}

TEST_P(Watch, UnstableStepIsNoticed) {
    Scene scene = quiet_scene();
    scene.spheres.position.set(6, scene.spheres.position[5] + Vec3(1.99 * test_radius, 0, 0));
    TestMonitor monitor;
    Simulation sim(std::move(scene), table());
    const double omega = std::sqrt(test_radius * test_stiffness / sphere_mass(test_radius));
    sim.change().set_walls(
        box_walls({Vec3(-1, 0, -0.05), Vec3(3, 0.1, 0.05)}, plane(Vec3::Zero(), Vec3::UnitX())));
    sim.change().set_gravity(Vec3(1, -9.81, 2));
    Driver driver(sim, {.step = 4.0 / omega}, monitor);
    EXPECT_THROW(
        {
            for (int k = 0; k < 5000; ++k) driver.step(false, [](double) {});
        },
        SimulationError);
}

// Engines look for trouble in every step; these check that they see it as soon as it is there. The
// spheres get there by themselves: one that is pushed is looked at anyhow.

/// Whether the watch finds the pair sound when sphere 1 has moved to `overlap` [m] by itself.
bool sound_at_overlap(const kernels::KernelTable& table, double radius, double overlap) {
    const double reach = test_radius + radius, step = 1e-4, way = 0.02 * radius;
    Scene scene =
        scene_of({Ball{.stiffness = 1e-9}, Ball{.x = Vec3(reach - overlap + 9.5 * way, 0, 0),
                                                .v = Vec3(-way / step, 0, 0),
                                                .radius = radius,
                                                .stiffness = 1e-9}});
    Simulation sim(std::move(scene), table);
    sim.compute_forces();
    sim.health().check();
    for (int k = 0; k < 9; ++k) {
        sim.advance(step);
        sim.compute_forces();
        sim.health().check();
    }
    sim.advance(step);  // half a step's way past `overlap`
    sim.compute_forces();
    try {
        sim.health().check();
    } catch (const SimulationError&) {
        return false;
    }
    return true;
}

TEST_P(Watch, SeesAnOverlapOfHalfTheSmallerRadius) {
    for (const double radius : {test_radius, 0.3 * test_radius}) {
        EXPECT_TRUE(sound_at_overlap(table(), radius, 0.48 * radius)) << radius;
        EXPECT_FALSE(sound_at_overlap(table(), radius, 0.505 * radius)) << radius;
    }
}

TEST_P(Watch, SeesASphereHalfARadiusInAWall) {
    const double step = 1e-4, way = 0.02 * test_radius;
    Scene scene = scene_of({Ball{
        .x = Vec3(0, 0.61 * test_radius, 0), .v = Vec3(0, -way / step, 0), .stiffness = 1e-9}});
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY())};
    Simulation sim(std::move(scene), table());
    for (int k = 0; k < 6; ++k) {
        sim.compute_forces();
        EXPECT_NO_THROW(sim.health().check()) << k;  // 0.49 of the radius in the wall at last
        sim.advance(step);
    }
    sim.compute_forces();
    EXPECT_THROW(sim.health().check(), SimulationError);
}

TEST_P(Watch, SeesAStepOfHalfARadius) {
    // A fall that gets faster by a tenth of a radius a step.
    const double step = 1e-4;
    Scene scene = scene_of({Ball{}});
    scene.gravity = Vec3(0, -0.1 * test_radius / (step * step), 0);
    Simulation sim(std::move(scene), table());
    for (int k = 0; k < 6; ++k) {
        // After k steps it moves (k - 1/2)/10 of a radius a step.
        sim.compute_forces();
        if (k > 0) {  // what is new is suspicious until it has been looked at
            EXPECT_FALSE(sim.health().alarmed()) << k;
        }
        EXPECT_NO_THROW(sim.health().check()) << k;
        sim.advance(step);
    }
    EXPECT_TRUE(sim.health().alarmed());
    EXPECT_THROW(sim.health().check(), SimulationError);
}

/// The message of check_start.
std::string start_error(const Scene& scene) {
    try {
        check_start(scene, "a.csv");
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("a.csv"), std::string::npos) << error.what();
        return error.what();
    }
    return "";
}

TEST(CheckStart, TakesGoodScenesAndNamesWhatIsWrong) {
    EXPECT_EQ(start_error(quiet_scene()), "");
    EXPECT_NE(start_error(Scene{}), "");
    const auto spoilt = [](const std::function<void(ParticleStore&)>& spoil) {
        Scene scene = quiet_scene();
        spoil(scene.spheres);
        return start_error(scene);
    };
    for (double radius : {0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity()})
        EXPECT_NE(spoilt([&](auto& s) { s.radius[8] = radius; }).find("sphere 8"),
                  std::string::npos);
    EXPECT_NE(spoilt([](auto& s) { s.position.x[2] = not_a_number; }).find("sphere 2"),
              std::string::npos);
    EXPECT_NE(spoilt([](auto& s) { s.spin.z[2] = not_a_number; }).find("sphere 2"),
              std::string::npos);
    // Ten per cent of overlap may be, more may not.
    EXPECT_EQ(spoilt([](auto& s) { s.position.y[2] = 0.91 * test_radius; }), "");
    EXPECT_NE(spoilt([](auto& s) { s.position.y[2] = 0.89 * test_radius; }).find("wall 0"),
              std::string::npos);
    EXPECT_EQ(spoilt([](auto& s) { s.position.x[2] = 1.91 * test_radius + s.position.x[1]; }), "");
    const std::string overlap =
        spoilt([](auto& s) { s.position.x[2] = 1.89 * test_radius + s.position.x[1]; });
    EXPECT_NE(overlap.find("spheres 1 and 2"), std::string::npos) << overlap;
    for (double mass : {0.0, -1.0, not_a_number})
        EXPECT_NE(spoilt([&](auto& s) { s.mass[4] = mass; }).find("sphere 4"), std::string::npos)
            << "mass " << mass;
}

GRAINFIELD_FOR_ALL_KERNELS(Watch);

}  // namespace
}  // namespace grainfield::core
