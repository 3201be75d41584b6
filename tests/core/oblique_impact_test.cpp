// Oblique impacts: sticking, gross slip, and no energy out of nothing at grazing angles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

const double plane_omega = std::sqrt(test_kn / test_mass);

/// A sphere that just touches the plane y = 0, in the frame turned by `turn`.
Scene sphere_on_plane(const Vec3& v, const Vec3& w, double friction, double lambda,
                      const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
    Scene scene = scene_of(
        {Ball{.x = turn * Vec3(0, test_radius, 0), .v = turn * v, .w = turn * w}}, friction);
    scene.walls = {plane(Vec3::Zero(), turn * Vec3::UnitY(), friction, lambda)};
    scene.stiffness_ratio = lambda;
    return scene;
}

void run_until_apart(Simulation& sim, double step) {
    const int limit = 100000;
    for (int k = 0; k < limit; ++k) {
        sim.compute_forces();
        if (k > 1 && sim.contacts().count() == 0) return;
        sim.advance(step);
    }
    FAIL() << "still touching";
}

using ObliqueImpact = KernelTest;
using Grazing = KernelTest;

TEST_P(ObliqueImpact, StickingOnAPlaneIsTheDiscreteCosine) {
    const double vs = 0.01, vn = 0.5;
    for (double lambda : {0.1, 2.0 / 7.0, 0.8})
        for (int n : {40, 160, 640}) {
            Simulation sim(sphere_on_plane({vs, -vn, 0}, Vec3::Zero(), 1e3, lambda), table());
            const double step = aligned_step(plane_omega, n);
            run_until_apart(sim, step);
            // Slip is an oscillator of its own, w_s = w sqrt(3.5 lambda): m and I = 0.4 m R^2
            // in series. Leapfrog: xi_k = A sin(k phi), cut off at k = n where the normal force
            // ends.
            const double phi = 2 * std::asin(0.5 * step * plane_omega * std::sqrt(3.5 * lambda));
            const double discrete =
                vs / std::sin(phi) * (std::sin(n * phi) - std::sin((n - 1) * phi));
            const Vec3 v = sim.spheres().velocity[0], w = sim.spheres().spin[0];
            const double slip = v.x() + test_radius * w.z();
            // At k = n the overlap is round-off, and friction of 1e3 times its force is what is
            // left.
            EXPECT_NEAR(slip, discrete, roundoff(1e5 * n) * vs) << lambda << " " << n;
            // The last half step's impulse goes with the contact: first order in the step.
            EXPECT_NEAR(slip, vs * std::cos(pi * std::sqrt(3.5 * lambda)), 1.2 * phi * vs);
            EXPECT_NEAR(v.x() - 0.4 * test_radius * w.z(), vs, roundoff(20.0 * n) * vs);
            EXPECT_NEAR(v.y(), vn, roundoff(200.0 * n) * vn);
        }
}

TEST_P(ObliqueImpact, GrossSlipOnAPlaneTakesExactlyTheCoulombImpulse) {
    const double vn = 0.5;
    for (double lambda : {0.1, 0.5})
        for (double mu : {0.1, 0.6}) {
            const double vs = 1.05 * std::max(mu / lambda, 7 * mu) * vn;  // e = 1
            Simulation sim(sphere_on_plane({vs, -vn, 0}, Vec3::Zero(), mu, lambda, some_rotation()),
                           table());
            run_until_apart(sim, aligned_step(plane_omega, 100));
            const Vec3 v = some_rotation().transpose() * sim.spheres().velocity[0];
            const Vec3 w = some_rotation().transpose() * sim.spheres().spin[0];
            const double impulse = mu * 2 * vn;
            EXPECT_NEAR(v.x(), vs - impulse, roundoff(2e4) * vs) << lambda << " " << mu;
            EXPECT_NEAR(v.z(), 0.0, roundoff(2e4) * vs);
            EXPECT_NEAR(w.z(), -2.5 * impulse / test_radius, roundoff(2e4) * vs / test_radius);
        }
}

TEST_P(ObliqueImpact, BelowTheThresholdTheContactSticksBeforeItLeaves) {
    const double vn = 0.5, lambda = 0.1, mu = 0.6;
    const double vs = 0.5 * std::max(mu / lambda, 7 * mu) * vn;
    Simulation sim(sphere_on_plane({vs, -vn, 0}, Vec3::Zero(), mu, lambda), table());
    run_until_apart(sim, aligned_step(plane_omega, 200));
    EXPECT_GT(sim.spheres().velocity.x[0], (vs - mu * 2 * vn) * (1 + 1e-6));
}

TEST_P(ObliqueImpact, SpheresRollOverEachOtherLikeOnAPlane) {
    // Two equal spheres with equal spins: slip 2 R w, masses and inertias in series as on a plane.
    const double vn = 0.01, w0 = 1e-3, lambda = 0.3;
    Scene scene = scene_of(
        {Ball{.v = Vec3(vn / 2, 0, 0), .w = Vec3(0, 0, w0)},
         Ball{.x = Vec3(2 * test_radius, 0, 0), .v = Vec3(-vn / 2, 0, 0), .w = Vec3(0, 0, w0)}},
        1e9);
    scene.stiffness_ratio = lambda;
    const int n = 2000;
    const double omega = std::sqrt(2) * plane_omega;
    Simulation sim(std::move(scene), table());
    run_until_apart(sim, aligned_step(omega, n));
    const ParticleStore& s = sim.spheres();
    const double slip =
        s.velocity.y[1] - s.velocity.y[0] - test_radius * (s.spin.z[0] + s.spin.z[1]);
    const double expected = -2 * test_radius * w0 * std::cos(pi * std::sqrt(3.5 * lambda));
    // Peak overlap over R is 1e-3 (lever arms), and the step's first-order error is 2e-3.
    EXPECT_NEAR(slip, expected, 4e-3 * 2 * test_radius * w0);
    EXPECT_NEAR(s.velocity.x[1], vn / 2, 1e-5 * vn);
}

TEST_P(ObliqueImpact, SlippingSpheresTakeTheCoulombImpulse) {
    const double vn = 1e-3, w0 = 1.0, mu = 0.2;
    Scene scene = scene_of(
        {Ball{.v = Vec3(vn / 2, 0, 0), .w = Vec3(0, 0, w0)},
         Ball{.x = Vec3(2 * test_radius, 0, 0), .v = Vec3(-vn / 2, 0, 0), .w = Vec3(0, 0, w0)}},
        mu);
    Simulation sim(std::move(scene), table());
    run_until_apart(sim, aligned_step(std::sqrt(2) * plane_omega, 200));
    const double impulse = mu * vn;  // over m: normal impulse is m_eff 2 vn = m vn
    // The normal turns by about 2 mu vn t/(2R), 1e-4 or less.
    EXPECT_NEAR(sim.spheres().spin.z[0], w0 - 2.5 * impulse / test_radius,
                1e-3 * impulse / test_radius);
    EXPECT_NEAR(sim.spheres().spin.z[1], sim.spheres().spin.z[0], roundoff(1e3) * w0);
    EXPECT_NEAR(sim.spheres().velocity.y[1] - sim.spheres().velocity.y[0], 2 * impulse,
                1e-3 * impulse);
}

double motion_energy(const Simulation& sim) {
    double sum = 0;
    for (std::size_t i = 0; i < sim.spheres().size(); ++i)
        sum += 0.5 * sim.spheres().mass[i] * sim.spheres().velocity[i].squaredNorm() +
               0.5 * sim.spheres().spin[i].squaredNorm() / sim.sphere(i).inverse_inertia();
    return sum;
}

constexpr double grazing_angles[] = {45, 60, 75, 80, 85, 88, 89, 89.5, 89.9, 89.99};

TEST_P(Grazing, PlaneNeverGivesEnergy) {
    // Steps that start and end with the contact: the normal rebound is exact, so that any gain
    // would be friction's.
    for (int n : {5, 6, 8, 13, 50})
        for (double degrees : grazing_angles)
            for (double mu : {0.1, 0.3, 0.6, 1.0, 1.5})
                for (double lambda : {0.1, 1.0}) {
                    const double angle = degrees * pi / 180;
                    const Vec3 v(std::sin(angle), -std::cos(angle), 0);
                    Simulation sim(sphere_on_plane(v, Vec3::Zero(), mu, lambda), table());
                    const double before = motion_energy(sim);
                    run_until_apart(sim, aligned_step(plane_omega, n));
                    ASSERT_LE(motion_energy(sim), before * (1 + roundoff(4500)))
                        << n << " steps, " << degrees << " degrees, friction " << mu << ", k_s/k_n "
                        << lambda;
                }
}

TEST_P(Grazing, PlaneGivesNoMoreThanTheNormalStepErrorAtAnyPhase) {
    // The normal spring alone may gain (w h)^2/4 of the normal energy where the contact starts and
    // ends within a step (head-on test); friction must not add to it.
    for (double wh : {0.6, 0.3, 0.1})
        for (double phase : {0.1, 0.35, 0.5, 0.8, 0.95})
            for (double degrees : grazing_angles)
                for (double mu : {0.1, 0.6, 1.5}) {
                    const double angle = degrees * pi / 180, step = wh / plane_omega;
                    const Vec3 v(std::sin(angle), -std::cos(angle), 0);
                    Scene scene = sphere_on_plane(v, Vec3::Zero(), mu, 0.5);
                    scene.spheres.position.y[0] -= phase * step * v.y();
                    Simulation sim(std::move(scene), table());
                    const double before = motion_energy(sim);
                    const double normal = 0.5 * test_mass * v.y() * v.y();
                    run_until_apart(sim, step);
                    ASSERT_LE(motion_energy(sim),
                              before * (1 + roundoff(4500)) + 0.25 * wh * wh * normal)
                        << wh << " " << phase << " " << degrees << " " << mu;
                }
}

TEST_P(Grazing, SpheresNeverGiveEnergy) {
    for (double wh : {0.6, 0.3, 0.1})
        for (double degrees : grazing_angles)
            for (double mu : {0.1, 0.6, 1.5}) {
                const double angle = degrees * pi / 180;
                const double omega = std::sqrt(2) * plane_omega, step = wh / omega;
                const Vec3 v = 0.3 * Vec3(-std::cos(angle), std::sin(angle), 0);
                Scene scene =
                    scene_of({Ball{}, Ball{.x = Vec3(2 * test_radius, 0, 0), .v = v}}, mu);
                scene.stiffness_ratio = 0.5;
                Simulation sim(std::move(scene), table());
                const double before = motion_energy(sim);
                run_until_apart(sim, step);
                const double normal = 0.25 * test_mass * v.x() * v.x();
                ASSERT_LE(motion_energy(sim),
                          before * (1 + roundoff(4500)) + 0.25 * wh * wh * normal)
                    << wh << " " << degrees << " " << mu;
            }
}

GRAINFIELD_FOR_ALL_KERNELS(ObliqueImpact);
GRAINFIELD_FOR_ALL_KERNELS(Grazing);

}  // namespace
}  // namespace grainfield::core
