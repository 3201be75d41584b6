// What no contact law may create or lose: momentum, angular momentum, energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/test_scenes.hpp"
#include "tests/larger.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::core {
namespace {

Vec3 momentum(const Simulation& sim) {
    Vec3 sum = Vec3::Zero();
    const ParticleStore& s = sim.spheres();
    for (std::size_t i = 0; i < s.size(); ++i) sum += s.mass[i] * s.velocity[i];
    return sum;
}

/// Spins included. With the velocity of mid-step: leapfrog keeps x_n x v_(n-1/2) exactly.
Vec3 angular_momentum(const Simulation& sim) {
    Vec3 sum = Vec3::Zero();
    const ParticleStore& s = sim.spheres();
    for (std::size_t i = 0; i < s.size(); ++i)
        sum += s.mass[i] * s.position[i].cross(s.velocity[i]) +
               0.4 * s.mass[i] * s.radius[i] * s.radius[i] * s.spin[i];
    return sum;
}

const std::string conservation_page = "Conservation";

using Conservation = KernelTest;

TEST_P(Conservation, MomentumAndAngularMomentumOfAFrictionalCloud) {
    std::vector<Ball> balls = loose_balls({6, 6, 6}, 1.05, 0.5);
    double momentum_scale = 0, angular_scale = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        balls[i].x -= Vec3::Constant(0.38);
        balls[i].v -= 2.0 * balls[i].x;  // they fall together
        balls[i].w = 20.0 * random_vec(i, 9);
    }
    Scene scene = scene_of(balls, 0.5);
    scene.stiffness_ratio = 0.5;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        momentum_scale += scene.spheres.mass[i] * balls[i].v.norm();
        angular_scale += scene.spheres.mass[i] * balls[i].v.norm() * balls[i].x.norm();
    }
    Simulation sim(std::move(scene), table());
    const Vec3 p0 = momentum(sim), l0 = angular_momentum(sim);
    double momentum_change = 0, angular_change = 0;
    std::int64_t most = 0;
    for (int k = 0; k < 40; ++k) {
        run_steps(sim, 5e-4, 50);
        most = std::max(most, sim.contacts().count());
        // 2000 steps, each rounding every sphere's momentum once or twice.
        momentum_change = std::max(momentum_change, (momentum(sim) - p0).norm());
        angular_change = std::max(angular_change, (angular_momentum(sim) - l0).norm());
    }
    EXPECT_GT(most, 100);
    verify::Case row{.scene = conservation_page,
                     .quantity = "momentum of 216 frictional spheres, largest change",
                     .closed_form = "0",
                     .source = "conservation",
                     .unit = "kg m/s",
                     .tolerance = "round-off of 2000 steps",
                     .scale = momentum_scale};
    verify::record(row, GetParam().name, 0, momentum_change, roundoff(2000) * momentum_scale);
    row.quantity = "angular momentum, spins included, largest change";
    row.unit = "kg m2/s";
    row.scale = angular_scale;
    verify::record(row, GetParam().name, 0, angular_change, roundoff(2000) * angular_scale);
}

/// Largest relative change of the energy of 1000 frictionless spheres in a box; `speed` of the
/// start [m/s].
double energy_drift(const kernels::KernelTable& table, int steps, double wh, double speed = 1.0) {
    Scene scene = scene_of(loose_balls({10, 10, 10}, 1.1, speed));
    scene.walls = box_walls(loose_box({10, 10, 10}, 1.1), plane(Vec3::Zero(), Vec3::UnitX()));
    // A gas moves far: a wide skin saves most of the searching.
    Simulation sim(std::move(scene), table, {.skin = 0.5 * test_radius});
    const double omega = std::sqrt(0.5 * test_radius * test_stiffness / sphere_mass(test_radius));
    const double step = wh / omega;
    sim.compute_forces(true);
    const double before = sim.energy().closing();
    double worst = 0;
    const int parts = 50;
    for (int k = 0; k < parts; ++k) {
        run_steps(sim, step, steps / parts);
        sim.compute_forces(true);
        worst = larger(worst, std::abs(sim.energy().closing() / before - 1.0));
    }
    return worst;
}

TEST_P(Conservation, EnergyOfAThousandSpheresInABox) {
    // Each impact starts and ends anywhere in a step and so changes its energy by up to
    // (w h)^2/4 either way, without bias: thousands of impacts over 1000 spheres average out.
    const double drift = energy_drift(table(), 20000, 0.05);
    RecordProperty("drift", std::to_string(drift));
    verify::record({.scene = conservation_page,
                    .quantity = "energy of 1000 frictionless spheres, 20,000 steps, "
                                "largest relative change",
                    .closed_form = "0",
                    .source = "conservation",
                    .tolerance = "(omega h)^2/4 an impact either way, averaged"},
                   GetParam().name, 0, drift, 1e-3);
}

TEST_P(Conservation, EnergyDriftVanishesWithTheStep) {
    // The same stretch of time in steps four times shorter. The drift is that of a random walk, a
    // single one scatters by a factor of five: what long steps give is taken over five starts.
    double square = 0;
    for (const double speed : {1.0, 0.98, 0.99, 1.01, 1.02})
        square += std::pow(energy_drift(table(), 2000, 0.2, speed), 2) / 5;
    const double coarse = std::sqrt(square), fine = energy_drift(table(), 8000, 0.05);
    RecordProperty("coarse", std::to_string(coarse));
    RecordProperty("fine", std::to_string(fine));
    EXPECT_LT(fine, 0.25 * coarse);
}

TEST_P(Conservation, LongRunEnergyOfAThousandSpheresOverAMillionSteps) {
    // A walk of some 1e6 impacts, each off by up to (w h)^2/4 = 6e-4 of a thousandth of the energy:
    // 6e-4 is one standard deviation.
    EXPECT_LT(energy_drift(table(), 1000000, 0.05), 3e-3);
}

TEST_P(Conservation, SpinsNeverChangeWithoutFriction) {
    std::vector<Ball> balls = loose_balls({4, 4, 4}, 1.05, 1.0);
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].w = random_vec(i, 9);
    for (bool no_ratio : {false, true}) {
        Scene scene = scene_of(balls, no_ratio ? 0.5 : 0.0);
        if (no_ratio) scene.stiffness_ratio = 0.0;
        scene.walls =
            box_walls(loose_box({4, 4, 4}, 1.05), plane(Vec3::Zero(), Vec3::UnitX(), 0.5));
        scene.damping = {0.2, 0.2};
        Simulation sim(std::move(scene), table());
        std::int64_t most = 0;
        for (int k = 0; k < 20; ++k) {
            run_steps(sim, 5e-4, 50);
            most = std::max(most, sim.contacts().count());
        }
        EXPECT_GT(most, 0);
        for (std::size_t i = 0; i < balls.size(); ++i)
            ASSERT_EQ(sim.spheres().spin[i], as_kept(balls[i].w));
    }
}

TEST_P(Conservation, FrictionOnlyTakesEnergy) {
    std::vector<Ball> balls = loose_balls({6, 6, 6}, 1.05, 1.0);
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].w = 30.0 * random_vec(i, 9);
    Scene scene = scene_of(balls, 0.5);
    scene.walls = box_walls(loose_box({6, 6, 6}, 1.05), plane(Vec3::Zero(), Vec3::UnitX(), 0.5));
    Simulation sim(std::move(scene), table(), {.ledger = true});
    sim.compute_forces();
    const auto mechanical = [&] {
        const Energy e = sim.energy();
        return e.kinetic + e.rotational + e.elastic_normal + e.elastic_shear;
    };
    const double before = mechanical();
    double last_work = 0, last = before;
    for (int k = 0; k < 100; ++k) {
        run_steps(sim, 1e-4, 50);
        sim.compute_forces(true);
        EXPECT_GE(sim.energy().friction_work, last_work);
        last_work = sim.energy().friction_work;
        EXPECT_LE(mechanical(), last + 1e-4 * before);
        last = mechanical();
    }
    EXPECT_LT(last, 0.9 * before);
}

GRAINFIELD_FOR_ALL_KERNELS(Conservation);

}  // namespace
}  // namespace grainfield::core
