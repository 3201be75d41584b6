// A sphere on a plane under gravity: sliding to rolling, and the incline.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/test_scenes.hpp"
#include "tests/larger.hpp"

namespace grainfield::core {
namespace {

const double omega = std::sqrt(test_kn / test_mass);

/// A sphere in the plane y = 0 under gravity inclined by theta, at its equilibrium overlap, all
/// turned by `turn`.
Scene resting_sphere(double friction, double theta, const Vec3& v, const Eigen::Matrix3d& turn) {
    const double overlap = test_mass * g * std::cos(theta) / test_kn;
    Scene scene =
        scene_of({Ball{.x = turn * Vec3(0, test_radius - overlap, 0), .v = turn * v}}, friction);
    scene.walls = {plane(Vec3::Zero(), turn * Vec3::UnitY(), friction)};
    scene.gravity = turn * (g * Vec3(std::sin(theta), -std::cos(theta), 0));
    return scene;
}

using Sliding = KernelTest;
using Incline = KernelTest;

TEST_P(Sliding, TurnsToRollingAtFiveSeventhsOfTheSpeed) {
    const double v0 = 1.0, mu = 0.3;
    const double rolling_time = 2 * v0 / (7 * mu * g);
    for (const Eigen::Matrix3d& turn :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), some_rotation()}) {
        Simulation sim(resting_sphere(mu, 0, {v0, 0, 0}, turn), table());
        const double step = 0.05 / omega;
        const auto motion = [&] {
            sim.compute_forces();
            const kernels::OnStep now = sim.sphere(0).on_step();
            return std::pair<Vec3, Vec3>(turn.transpose() * now.velocity,
                                         turn.transpose() * now.spin);
        };
        // The spring needs mu m g/K_s of slip before it slides: 5e-4 m of some 0.15 m.
        const double build_up = mu * test_mass * g / (0.1 * test_kn) / v0;
        while (sim.time() < 0.5 * rolling_time) run_steps(sim, step, 1);
        auto [v, w] = motion();
        const double t0 = sim.time(), vx0 = v.x(), wz0 = w.z();
        EXPECT_NEAR(vx0, v0 - mu * g * t0, mu * g * build_up);
        while (sim.time() < 0.9 * rolling_time) run_steps(sim, step, 1);
        std::tie(v, w) = motion();
        const double t = sim.time() - t0;
        // While it slides the force is constant, and leapfrog exact; round-off of a thousand steps
        // in an overlap of 5e-4 m.
        EXPECT_NEAR(vx0 - v.x(), mu * g * t, roundoff(1e6) * v0);
        EXPECT_NEAR(wz0 - w.z(), 2.5 * mu * g * t / test_radius, roundoff(1e6) * v0 / test_radius);
        while (v.x() + test_radius * w.z() > 0) {
            run_steps(sim, step, 1);
            std::tie(v, w) = motion();
        }
        EXPECT_NEAR(sim.time(), rolling_time, build_up + 2 * step);
        // The tangential spring is left loaded and swings freely about rolling, its slip being
        // 3.5 mu g/w_s at most; its mean speed is the rolling speed.
        double mean = 0, worst = 0;
        const int n = 20000;
        for (int k = 0; k < n; ++k) {
            run_steps(sim, step, 1);
            std::tie(v, w) = motion();
            mean += v.x() / n;
            worst = larger(worst, std::abs(v.x() + test_radius * w.z()));
        }
        const double swing = 3.5 * mu * g / (omega * std::sqrt(0.35));
        EXPECT_LT(worst, 1.01 * swing);
        EXPECT_NEAR(mean, 5.0 / 7.0 * v0, 1e-3 * swing + mu * g * step);
        // The moment about the contact line is kept whatever the friction does.
        EXPECT_NEAR(v.x() - 0.4 * test_radius * w.z(), v0, roundoff(1e6) * v0);
    }
}

/// Speed down the incline after `time` when released with the shear force of the steady state.
double speed_after(const kernels::KernelTable& table, double mu, double theta, double shear,
                   double time, const Eigen::Matrix3d& turn) {
    Simulation sim(resting_sphere(mu, theta, Vec3::Zero(), turn), table);
    sim.compute_forces();
    EXPECT_TRUE(sim.change().restore_shear(0, -1, turn * Vec3(-shear, 0, 0)));
    const double step = 0.1 / omega;
    const int n = static_cast<int>(time / step);
    run_steps(sim, step, n);
    sim.compute_forces();
    return sim.sphere(0).on_step().velocity.dot(turn * Vec3::UnitX()) / sim.time();
}

TEST_P(Incline, RollsAtFiveSeventhsWhileFrictionHolds) {
    for (double theta : {0.1, 0.6, 1.1})
        for (double margin : {1.0001, 3.0}) {
            const double mu = margin * 2.0 / 7.0 * std::tan(theta);
            const double shear = 2.0 / 7.0 * test_mass * g * std::sin(theta);
            const double a = speed_after(table(), mu, theta, shear, 0.5, some_rotation());
            // Constant force: exact but for round-off in an overlap of 5e-4 m.
            EXPECT_NEAR(a, 5.0 / 7.0 * g * std::sin(theta), roundoff(1e6) * g) << theta;
        }
}

TEST_P(Incline, SlipsAboveTheLimit) {
    for (double theta : {0.1, 0.6, 1.1})
        for (double margin : {0.9999, 0.3}) {
            const double mu = margin * 2.0 / 7.0 * std::tan(theta);
            const double shear = mu * test_mass * g * std::cos(theta);
            const double a = speed_after(table(), mu, theta, shear, 0.5, some_rotation());
            EXPECT_NEAR(a, g * (std::sin(theta) - mu * std::cos(theta)), roundoff(1e6) * g)
                << theta;
        }
}

TEST_P(Incline, ReleasedWithoutShearForceRollsOnAverage) {
    // The spring starts unloaded and swings between 0 and 4/7 m g sin(theta): friction of twice
    // the static need keeps it from slipping.
    const double theta = 0.3, mu = 2.05 * 2.0 / 7.0 * std::tan(theta);
    for (double time : {2.0, 8.0}) {
        const double a = speed_after(table(), mu, theta, 0.0, time, some_rotation());
        const double swing = 2.0 / 7.0 * g * std::sin(theta) / (omega * std::sqrt(0.35));
        EXPECT_NEAR(a, 5.0 / 7.0 * g * std::sin(theta), 1.01 * swing / time);
    }
}

GRAINFIELD_FOR_ALL_KERNELS(Sliding);
GRAINFIELD_FOR_ALL_KERNELS(Incline);

}  // namespace
}  // namespace grainfield::core
