// Head-on impacts and free fall, against the scheme's discrete answer and the continuous one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/test_scenes.hpp"

namespace grainfield::core {
namespace {

constexpr double speed = 0.5;  // [m/s]

struct Rebound {
    double restitution = 0;   // [-]
    double contact_time = 0;  // from touching to leaving, by straight flight after it [s]
    double peak = 0;          // [m]
    std::vector<double> overlap;
};

/// A head-on impact along `direction` that starts just touching after `delay` steps of flight.
/// `wall`: a sphere on a plane, else two spheres of radii R and R * ratio.
struct Impact {
    bool wall = false;
    Vec3 direction = Vec3::UnitY();
    double ratio = 1.0, damping = 0.0, delay = 0.0, v = speed;
    double stiffness = test_stiffness;

    double mass_i() const { return sphere_mass(test_radius); }
    double mass_j() const { return sphere_mass(test_radius * ratio); }
    double effective_mass() const {
        return wall ? mass_i() : mass_i() * mass_j() / (mass_i() + mass_j());
    }
    double contact_stiffness() const {
        return 0.5 * (wall ? test_radius : 0.5 * test_radius * (1 + ratio)) * stiffness;
    }
    double omega() const { return frequency(contact_stiffness(), effective_mass()); }

    Scene scene(double step) const {
        const double gap = delay * step * v;
        const Vec3 d = direction.normalized();
        Ball a, b;
        a.stiffness = b.stiffness = stiffness;
        Scene scene;
        if (wall) {
            a.x = (test_radius + gap) * d;
            a.v = -v * d;
            scene = scene_of({a});
            scene.walls = {plane(Vec3::Zero(), d)};
            scene.walls[0].normal_stiffness = stiffness;
        } else {
            b.radius = test_radius * ratio;
            b.x = (test_radius + b.radius + gap) * d;
            a.v = mass_j() / (mass_i() + mass_j()) * v * d;
            b.v = -mass_i() / (mass_i() + mass_j()) * v * d;
            scene = scene_of({a, b});
        }
        scene.damping.force = damping;
        return scene;
    }

    Rebound run(const kernels::KernelTable& table, double step) const {
        Simulation sim(scene(step), table);
        const Vec3 d = direction.normalized();
        Rebound rebound;
        for (;;) {
            const ParticleStore& s = sim.spheres();
            const Vec3 branch = wall ? s.position[0] : Vec3(s.position[1] - s.position[0]);
            const double overlap = test_radius * (wall ? 1.0 : 1.0 + ratio) - branch.norm();
            rebound.overlap.push_back(overlap);
            rebound.peak = std::max(rebound.peak, overlap);
            sim.compute_forces();
            const Vec3 velocity = wall ? s.velocity[0] : Vec3(s.velocity[1] - s.velocity[0]);
            const double leaving = velocity.dot(d);
            if (overlap < 0 && leaving > 0) {
                rebound.restitution = leaving / v;
                rebound.contact_time = sim.time() + overlap / leaving - delay * step;
                return rebound;
            }
            sim.advance(step);
        }
    }
};

std::vector<Impact> impacts() {
    return {{.wall = true},
            {.direction = {1, 2, -2}},
            {.ratio = 0.4},
            {.wall = true, .direction = {1, -3, 2}}};
}

class HeadOn : public KernelTest {};

TEST_P(HeadOn, UndampedImpactIsTheDiscreteSine) {
    for (const Impact& impact : impacts())
        for (int n : {5, 20, 400}) {
            const double step = aligned_step(impact.omega(), n);
            const Rebound r = impact.run(table(), step);
            // Leapfrog from touching at speed v: overlap_k = A sin(k pi/n) exactly, with
            // A = h v / sin(pi/n), and the full speed back after n steps.
            const double amplitude = step * speed / std::sin(pi / n);
            // Overlaps are differences of lengths a dozen times larger, summed over n steps.
            const double tolerance = roundoff(200.0 * n);
            for (int k = 0; k <= n; ++k)
                ASSERT_NEAR(r.overlap[static_cast<std::size_t>(k)],
                            amplitude * std::sin(k * pi / n), tolerance * amplitude);
            EXPECT_NEAR(r.restitution, 1.0, tolerance);
            EXPECT_NEAR(r.contact_time, n * step, tolerance * n * step);
        }
}

TEST_P(HeadOn, UndampedImpactConvergesToTheClosedForm) {
    for (const Impact& impact : impacts()) {
        const double w = impact.omega();
        double last_peak = 0, last_time = 0;
        for (int n : {50, 100, 200}) {
            const Rebound r = impact.run(table(), aligned_step(w, n));
            const double peak_error = std::abs(r.peak / (speed / w) - 1.0);
            const double time_error = std::abs(r.contact_time / (pi / w) - 1.0);
            if (last_peak > 0) {  // second order
                EXPECT_NEAR(last_peak / peak_error, 4.0, 0.1);
                EXPECT_NEAR(last_time / time_error, 4.0, 0.1);
            }
            last_peak = peak_error;
            last_time = time_error;
        }
        EXPECT_LT(last_peak, 1e-4);
        EXPECT_LT(last_time, 1e-4);
    }
}

TEST_P(HeadOn, RestitutionOfAnyPhaseIsOneToSecondOrder) {
    // Entering a share a of a step after touching and leaving a share b after it, the scheme's
    // invariant gives e^2 = 1 + (w h)^2 (b(1 - b) - a(1 - a)), within (w h)^2/4 of 1.
    for (double wh : {0.4, 0.1, 0.025})
        for (int phase = 0; phase < 40; ++phase) {
            Impact impact{.wall = true, .delay = phase / 40.0};
            const double e = impact.run(table(), wh / impact.omega()).restitution;
            ASSERT_LE(std::abs(e * e - 1.0), 0.25 * wh * wh + roundoff(1e5)) << wh << " " << phase;
        }
}

TEST_P(HeadOn, DampedRestitutionIsThatOfTheDampingAlone) {
    const double a = 0.2;
    const double exact = std::sqrt((1 - a) / (1 + a));
    const Impact variants[] = {{.wall = true},
                               {.direction = {1, 0, 0}},
                               {.direction = {0, 0, 1}},
                               {.v = 0.01},
                               {.wall = true, .stiffness = 3e7}};
    for (Impact impact : variants)
        for (double wh : {0.2, 0.05, 0.0125})
            for (double phase : {0.0, 0.3, 0.7}) {
                impact.damping = a;
                impact.delay = phase;
                const double w = impact.omega();
                const Rebound r = impact.run(table(), wh / w);
                // Entry, turn and exit each fall anywhere in a step, each an error of (w h)^2/4.
                ASSERT_NEAR(r.restitution, exact, 0.75 * wh * wh);
                const double time = pi / (2 * w) * (1 / std::sqrt(1 + a) + 1 / std::sqrt(1 - a));
                // The sign passes through zero over alpha w h of phase: the turn is that well
                // timed.
                ASSERT_NEAR(r.contact_time * w, time * w, 2 * a * wh);
            }
}

TEST_P(HeadOn, DampedFlightLosesNothingBeforeTouching) {
    // Without a resultant there is nothing to damp: the flight before the impact is free.
    Impact impact{.wall = true, .damping = 0.2, .delay = 7.5};
    Simulation sim(impact.scene(1e-3), table());
    run_steps(sim, 1e-3, 7);
    EXPECT_EQ(sim.spheres().velocity.y[0], -speed);
}

using FreeFall = KernelTest;

TEST_P(FreeFall, DampedFallHasFourFifthsOfGravity) {
    const Vec3 g(0, -9.81, 0);
    const double step = 1e-3;
    Scene scene = scene_of({Ball{.x = Vec3(1, 2, 3)}});
    scene.gravity = g;
    scene.damping = {0.2, 0.2};
    Simulation sim(std::move(scene), table());
    const int n = 1000;
    run_steps(sim, step, n);
    sim.compute_forces();
    const double t = n * step;
    // Leapfrog is exact for a constant acceleration: n roundings of velocity and position.
    EXPECT_NEAR(sim.sphere(0).on_step().velocity.y(), 0.8 * g.y() * t, roundoff(n) * 8);
    EXPECT_NEAR(sim.spheres().position.y[0], 2 + 0.4 * g.y() * t * t, roundoff(n) * 8);
    EXPECT_EQ(sim.spheres().position.x[0], 1.0);
    EXPECT_EQ(sim.spheres().velocity.z[0], 0.0);
}

TEST_P(FreeFall, DampedThrowSlowsByMoreOnTheWayUp) {
    // Upwards 1.2 g, downwards 0.8 g: the height is v^2/(2.4 g), the way back takes sqrt(1.5).
    const double g = 9.81, v = 3.0;
    for (double step : {1e-3, 0.73e-3}) {
        Scene scene = scene_of({Ball{.v = Vec3(0, v, 0)}});
        scene.gravity = Vec3(0, -g, 0);
        scene.damping.force = 0.2;
        Simulation sim(std::move(scene), table());
        double top = 0;
        while (sim.spheres().position.y[0] >= 0) {
            run_steps(sim, step, 1);
            top = std::max(top, sim.spheres().position.y[0]);
        }
        EXPECT_NEAR(top, v * v / (2.4 * g), g * step * step);
        const double rise = v / (1.2 * g), fall = rise * std::sqrt(1.5);
        EXPECT_NEAR(sim.time(), rise + fall, 1.5 * step);
    }
}

GRAINFIELD_FOR_ALL_KERNELS(HeadOn);
GRAINFIELD_FOR_ALL_KERNELS(FreeFall);

}  // namespace
}  // namespace grainfield::core
