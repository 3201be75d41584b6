// Simple cubic lattices between rigid rough walls have the infinite lattice's highest mode: stable
// just below its bound, growing just above it. And what the step control makes of such limits.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/drive/driver.hpp"
#include "tests/core/test_scenes.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::core {
namespace {

constexpr double overlap = 1e-3 * test_radius;

/// n^3 spheres between walls half a spacing beyond them. The walls are rigid: springs of 2 K_n and
/// 2 K_s to a fixed plane are those to a mirror image moving oppositely.
Scene cubic_lattice(int n, double lambda) {
    std::vector<Ball> balls;
    const double spacing = 2 * test_radius - overlap;
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int c = 0; c < n; ++c)
                balls.push_back({.x = spacing * Vec3(a + 0.5, b + 0.5, c + 0.5)});
    Scene scene = scene_of(balls, 1e6);
    scene.stiffness_ratio = lambda;
    Wall wall = plane(Vec3::Zero(), Vec3::UnitX(), 1e6, lambda);
    wall.normal_stiffness = 1e12 * test_stiffness;
    scene.walls = box_walls({Vec3::Zero(), Vec3::Constant(n * spacing)}, wall);
    return scene;
}

double cubic_bound(double lambda) {
    return std::sqrt(test_mass / test_kn) *
           std::min(1 / std::sqrt(1 + 2 * lambda), std::sqrt(0.2) / std::sqrt(lambda));
}

const std::string lattice_step_page = "Time step of a simple cubic lattice";
const std::string bound_form = "sqrt(m/K_n) min(1/sqrt(1 + 2 lambda), sqrt(0.2/lambda))";
std::string quantity(const std::string& what, double lambda) {
    return fmt::format("{}, lambda = {}", what, lambda);
}

/// Growth of the motion over `steps`, from tiny random velocities [m/s] and spins.
double growth(const kernels::KernelTable& table, double lambda, double step, int steps,
              double tiny) {
    Scene scene = cubic_lattice(4, lambda);
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        scene.spheres.velocity.set(i, tiny * random_vec(i, 1));
        scene.spheres.spin.set(i, tiny / test_radius * random_vec(i, 2));
    }
    Simulation sim(std::move(scene), table);
    const auto motion = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < sim.spheres().size(); ++i)
            sum += sim.spheres().velocity[i].squaredNorm() +
                   std::pow(test_radius, 2) * sim.spheres().spin[i].squaredNorm();
        return sum;
    };
    run_steps(sim, step, 20);
    const double before = motion();
    run_steps(sim, step, steps);
    EXPECT_EQ(sim.contacts().count(), 3 * 4 * 4 * 5);  // no contact opened: still linear
    return std::sqrt(motion() / before);
}

TimeOptions options(double safety, double mass_scaling = 1.0) {
    return {.step = std::nullopt, .safety = safety, .mass_scaling = mass_scaling};
}

using LatticeStep = KernelTest;

TEST_P(LatticeStep, SimpleCubicEstimateIsTheInfiniteLattices) {
    for (double lambda : {0.05, 0.1, 0.3, 0.5, 1.0}) {
        Simulation sim(cubic_lattice(4, lambda), table());
        sim.compute_forces();
        // A lattice of 64 has the mode exactly; Lanczos finds it to half a per cent.
        verify::record({.scene = lattice_step_page,
                        .quantity = quantity("stability limit, estimated", lambda),
                        .closed_form = bound_form,
                        .source = "highest mode of the infinite lattice",
                        .unit = "s",
                        .tolerance = "Lanczos, half a per cent"},
                       GetParam().name, cubic_bound(lambda), 2 / FrequencyEstimator().estimate(sim),
                       0.01 * cubic_bound(lambda));
    }
}

TEST_P(LatticeStep, StableBelowTheBoundAndGrowingAbove) {
    // 0.05 and 0.1: the alternating translation; 0.5, 1: the rolling of all spheres together.
    // Float resolves the overlaps, 5e-5 m, to 3e-12 m: start above that, and stop before they open.
    const double tiny = is_mixed() ? 1e-8 : 1e-14;
    const int steps = is_mixed() ? 30 : 60;
    for (double lambda : {0.05, 0.1, 0.5, 1.0}) {
        // Just beyond the bound the motion grows by exp(2 acosh(h/bound)) a step: which bound does
        // the growth found over many steps belong to?
        const double many = growth(table(), lambda, 1.01 * cubic_bound(lambda), steps, tiny);
        verify::record({.scene = lattice_step_page,
                        .quantity = quantity("stability limit, from the growth at 1.01", lambda),
                        .closed_form = bound_form,
                        .source = "leapfrog on the highest mode",
                        .unit = "s",
                        .tolerance = "the mode's share of the start, a few steps"},
                       GetParam().name, cubic_bound(lambda),
                       1.01 * cubic_bound(lambda) / std::cosh(0.5 * std::log(many) / steps),
                       0.002 * cubic_bound(lambda));
        // Above: the amplitude grows by exp(2 acosh(1.01)) = 1.327 a step, 2e12 in 100; the first
        // 20 steps have taken some of it.
        EXPECT_GT(many, std::exp(0.8 * steps * 2 * std::acosh(1.01))) << lambda;
        // Below: bounded; leapfrog's velocity amplitude is 1/sqrt(1 - 0.99^2) = 7 at most.
        EXPECT_LT(growth(table(), lambda, 0.99 * cubic_bound(lambda), 2000, tiny), 50) << lambda;
    }
}

TEST_P(LatticeStep, StepControlTakesItsShareOfTheLimit) {
    Simulation sim(cubic_lattice(4, 0.3), table());
    sim.compute_forces();
    StepControl control(options(0.7));
    EXPECT_EQ(control.limit(), 0.0);
    const double step = control.next(sim);
    EXPECT_NEAR(step, 0.7 * cubic_bound(0.3), 0.01 * step);
    EXPECT_NEAR(control.limit(), cubic_bound(0.3), 0.01 * cubic_bound(0.3));
    EXPECT_EQ(control.inertia_ratio(), 1.0);
    EXPECT_EQ(StepControl({.step = 1e-6}).next(sim), 1e-6);
}

TEST_P(LatticeStep, MassScalingRaisesTheLimitByItsFactor) {
    for (double factor : {2.0, 5.0}) {
        Scene scene = cubic_lattice(4, 0.3);
        scene.spheres.normal_stiffness[21] *= 50;  // one hard grain governs the step
        Simulation sim(std::move(scene), table());
        sim.compute_forces();
        StepControl plain(options(0.8));
        const double step = plain.next(sim);
        StepControl scaled(options(0.8, factor));
        EXPECT_NEAR(scaled.next(sim), factor * step, 1e-6 * factor * step);
        // The network with the scaled masses allows it.
        FrequencyEstimator estimator;
        EXPECT_LE(estimator.estimate(sim), 2.0 / (factor * plain.limit()) * 1.02);
        EXPECT_GT(scaled.inertia_ratio(), 1.0);
    }
}

struct Silent : Monitor {};

TEST_P(LatticeStep, FallingClusterWithoutContactsDoesNotBlowUp) {
    // The first estimate has no contact to go by; the ground comes at 3 m/s. Without damping the
    // energy may only change by the step's error.
    std::vector<Ball> balls = loose_balls({4, 4, 4}, 1.05, 0.0);
    for (Ball& ball : balls) {
        ball.x.y() += 0.2;
        ball.v = Vec3(0, -3, 0);
        ball.stiffness = 3e7;
    }
    Scene scene = scene_of(balls, 0.3);
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.3)};
    scene.walls[0].normal_stiffness = 1e9;
    scene.gravity = Vec3(0, -9.81, 0);
    Simulation sim(std::move(scene), table());
    sim.compute_forces(true);
    const double before = sim.energy().closing();
    Silent monitor;
    Driver driver(sim, options(0.8), monitor);
    double peak = before;
    while (sim.time() < 0.4) {
        driver.step(true, [&](double) {
            const Energy e = sim.energy();
            peak = std::max(peak, e.closing());
        });
    }
    EXPECT_LT(peak, 1.05 * before);
}

GRAINFIELD_FOR_ALL_KERNELS(LatticeStep);

}  // namespace
}  // namespace grainfield::core
