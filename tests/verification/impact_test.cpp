// Head-on impacts and free fall as scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/verification/closed_forms.hpp"
#include "tests/verification/scene_test.hpp"

namespace grainfield::verify {
namespace {

using ImpactScene = SceneTest;

/// Overlap and separation speed in a state [m], [m/s].
struct Approach {
    double overlap, leaving;
};
using ApproachOf = std::function<Approach(const std::vector<Motion>&)>;

Approach to_wall(const SceneResult& r, const Motion& m, std::size_t i) {
    const auto& wall = r.file.walls[0];
    return {r.radius(i) - wall.normal.dot(m.x - wall.point), wall.normal.dot(m.v)};
}

Approach of_pair(const SceneResult& r, const Motion& a, const Motion& b, std::size_t i) {
    const Vec3 branch = b.x - a.x;
    return {r.radius(i) + r.radius(i + 1) - branch.norm(), (b.v - a.v).dot(branch.normalized())};
}

/// From touching to parting, by straight flight before the first and after the last state [s].
double contact_time(const SceneResult& r, const Approach& before, const Approach& after) {
    return r.time.back() + after.overlap / after.leaving -
           (r.time.front() + before.overlap / before.leaving);
}

/// An aligned impact: contact time, peak and restitution by the scheme's own discrete answer and,
/// to the order of the step, by the closed form.
void check_aligned(const std::string& scene, const SceneResult& r, const std::string& kernel,
                   double mass, double stiffness, const ApproachOf& approach, double epsilon) {
    const double omega = std::sqrt(stiffness / mass), h = r.step();
    const Approach before = approach(r.states.front()), after = approach(r.states.back());
    const double speed = -before.leaving;
    const double phase = 2 * std::asin(0.5 * omega * h);  // a step's, of leapfrog's oscillation
    const double n = std::round(pi / phase);
    ASSERT_NEAR(pi / phase, n, 1e-9 * n) << "the scene's step is not aligned with its contact";
    // Every step rounds the displacement and the velocity once or twice.
    const double tight = 5 * n * epsilon;
    const double amplitude = h * speed / std::sin(phase);
    double worst = 0, peak = 0;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(n); ++k) {
        const double overlap = approach(r.states[k]).overlap;
        peak = std::max(peak, overlap);
        const double error = overlap - amplitude * std::sin(static_cast<double>(k) * phase);
        if (std::abs(error) > std::abs(worst)) worst = error;
    }
    const std::string law = "linear spring, Eqs. (3)-(4)";
    const std::string scheme = "leapfrog, exact in discrete time";
    const std::string few = "round-off of n steps";
    // The scheme's frequency is omega (1 + (omega h)^2/24), its amplitude as far off times 3.
    const double order = 0.126 * std::pow(omega * h, 2) + tight;
    const std::string step = "(omega h)^2/8, the order of the step";
    record({.scene = scene,
            .quantity = "contact time, discrete",
            .closed_form = "n h",
            .source = scheme,
            .unit = "s",
            .tolerance = few},
           kernel, n * h, contact_time(r, before, after), tight * n * h);
    record({.scene = scene,
            .quantity = "overlaps, discrete (worst of the contact)",
            .closed_form = "h v sin(k pi/n)/sin(pi/n)",
            .source = scheme,
            .unit = "m",
            .tolerance = few,
            .scale = amplitude},
           kernel, 0, worst, tight * amplitude);
    record({.scene = scene,
            .quantity = "restitution",
            .closed_form = "1",
            .source = law,
            .tolerance = few},
           kernel, 1, after.leaving / speed, tight);
    record({.scene = scene,
            .quantity = "contact time",
            .closed_form = "pi sqrt(m_eff/K_n)",
            .source = law,
            .unit = "s",
            .tolerance = step},
           kernel, pi / omega, contact_time(r, before, after), order * pi / omega);
    record({.scene = scene,
            .quantity = "peak overlap",
            .closed_form = "v sqrt(m_eff/K_n)",
            .source = law,
            .unit = "m",
            .tolerance = step},
           kernel, speed / omega, peak, order * speed / omega);
    const double kinetic = r.energy.front()[1];
    double drift = 0;
    for (std::size_t k = 0; k < r.energy.size(); ++k)
        drift = std::max(drift, std::abs(r.energy_sum(k) - r.energy_sum(0)));
    // Velocities on the step are the mean of those half a step before and after.
    record({.scene = scene,
            .quantity = "change of the energy's sum",
            .closed_form = "0",
            .source = "conservation",
            .unit = "J",
            .tolerance = "(omega h)^2/4 of the energy",
            .scale = kinetic},
           kernel, 0, drift, (0.251 * std::pow(omega * h, 2) + tight) * kinetic);
}

TEST_P(ImpactScene, OnPlane) {
    const SceneResult r = run("impact-on-plane");
    check_aligned(
        "impact-on-plane", r, kernel(), r.mass(0), r.wall_stiffness(0, 0),
        [&](const auto& state) { return to_wall(r, state[0], 0); }, GetParam().epsilon);
}

TEST_P(ImpactScene, OfSpheres) {
    const SceneResult r = run("impact-of-spheres");
    check_aligned(
        "impact-of-spheres", r, kernel(), r.effective_mass(0, 1), r.pair_stiffness(0, 1),
        [&](const auto& s) { return of_pair(r, s[0], s[1], 0); }, GetParam().epsilon);
    const Vec3 momentum = r.mass(0) * r.last(0).v + r.mass(1) * r.last(1).v;
    const double scale = r.mass(0) * r.first(0).v.norm();
    record({.scene = "impact-of-spheres",
            .quantity = "momentum",
            .closed_form = "0",
            .source = "conservation",
            .unit = "kg m/s",
            .tolerance = "round-off of 200 steps",
            .scale = scale},
           kernel(), 0, momentum.norm(), roundoff(400) * scale);
}

TEST_P(ImpactScene, Damped) {
    const SceneResult r = run("impact-damped");
    const double a = r.file.damping.force;
    const auto check = [&](const std::string& name, double mass, double stiffness,
                           const Approach& before, const Approach& after) {
        const double omega = std::sqrt(stiffness / mass), wh = omega * r.step();
        // Entry, turn and exit each fall anywhere in a step, each an error of (w h)^2/4.
        record({.scene = "impact-damped",
                .quantity = "restitution, " + name,
                .closed_form = "sqrt((1 - a)/(1 + a))",
                .source = "force (1 +- a) K_n overlap",
                .tolerance = "3/4 (omega h)^2, entry, turn and exit within steps"},
               kernel(), std::sqrt((1 - a) / (1 + a)), -after.leaving / before.leaving,
               0.75 * wh * wh + roundoff(500));
        // The sign of damping passes through zero over a w h of phase.
        const double time = pi / (2 * omega) * (1 / std::sqrt(1 + a) + 1 / std::sqrt(1 - a));
        record({.scene = "impact-damped",
                .quantity = "contact time, " + name,
                .closed_form = "(pi/2 omega)(1/sqrt(1 + a) + 1/sqrt(1 - a))",
                .source = "force (1 +- a) K_n overlap",
                .unit = "s",
                .tolerance = "2 a h, the turn within a step"},
               kernel(), time, contact_time(r, before, after), 2 * a * r.step());
    };
    const char* names[] = {"plane, 0.5 m/s", "plane, 0.02 m/s", "plane, small and stiff"};
    for (std::size_t i = 0; i < 3; ++i)
        check(names[i], r.mass(i), r.wall_stiffness(i, 0), to_wall(r, r.first(i), i),
              to_wall(r, r.last(i), i));
    for (std::size_t i : {3u, 5u})
        check(i == 3 ? "pair along x" : "pair along z", r.effective_mass(i, i + 1),
              r.pair_stiffness(i, i + 1), of_pair(r, r.first(i), r.first(i + 1), i),
              of_pair(r, r.last(i), r.last(i + 1), i));
}

TEST_P(ImpactScene, FreeFall) {
    const SceneResult r = run("free-fall");
    const double share = 1 - r.file.damping.force, g = r.file.gravity.norm();
    for (std::size_t k = 0; k < r.time.size(); ++k)
        for (std::size_t i = 0; i < r.size(); ++i) {
            const double t = r.time[k];
            const Motion m0 = r.first(i), m = r.states[k][i];
            // Every step rounds velocity (up to 5 m/s) and displacement once or twice.
            const double tolerance = roundoff(2 * static_cast<double>(r.summary.at("steps")));
            const Vec3 v = m0.v + share * r.file.gravity * t;
            const Vec3 x = m0.x + m0.v * t + 0.5 * share * r.file.gravity * t * t;
            record({.scene = "free-fall",
                    .quantity = "velocity (largest error of all)",
                    .closed_form = "v_0 + 0.8 g t",
                    .source = "local damping takes a = 0.2",
                    .unit = "m/s",
                    .tolerance = "round-off of each step",
                    .scale = g * r.file.end},
                   kernel(), 0, (m.v - v).norm(), tolerance * g * r.file.end);
            record({.scene = "free-fall",
                    .quantity = "position (largest error of all)",
                    .closed_form = "x_0 + v_0 t + 0.4 g t^2",
                    .source = "local damping takes a = 0.2",
                    .unit = "m",
                    .tolerance = "round-off of each step",
                    .scale = 2.0},
                   kernel(), 0, (m.x - x).norm(), tolerance * 2.0);
            EXPECT_LT((m.w - m0.w).norm(), roundoff(2) * m0.w.norm() + 1e-300);
        }
    const double fallen = r.first(0).x.y() - r.last(0).x.y();
    record({.scene = "free-fall",
            .quantity = "acceleration from rest",
            .closed_form = "0.8 g",
            .source = "local damping takes a = 0.2",
            .unit = "m/s2",
            .tolerance = "round-off of each step"},
           kernel(), share * g, 2 * fallen / std::pow(r.time.back(), 2), roundoff(2000) * g);
}

GRAINFIELD_FOR_ALL_SOLVERS(ImpactScene);

}  // namespace
}  // namespace grainfield::verify
