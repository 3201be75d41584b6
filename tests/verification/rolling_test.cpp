// Sliding to rolling, and the incline below and above the transition.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/larger.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/scene_test.hpp"

namespace grainfield::verify {
namespace {

using RollingScene = SceneTest;

/// The closed form of sphere i on a wall, with what of gravity is along it.
struct OnPlane {
    OnPlane(const SceneResult& r, std::size_t i, std::size_t wall) {
        normal = r.file.walls[wall].normal;
        const Vec3 g = r.file.gravity;
        const Vec3 tangential = g - g.dot(normal) * normal;
        down = tangential.norm() > 1e-9 * g.norm() ? tangential.normalized() : Vec3::UnitX();
        along = tangential.norm();
        across = -g.dot(normal);
        mu = std::tan(
            std::min(r.start.spheres.friction_angle[i], r.file.walls[wall].friction_angle));
        const double k = r.lambda() * r.wall_stiffness(i, wall), m = r.mass(i);
        start = r.first(i).v.dot(down);
        slip = {along, std::sqrt(3.5 * k / m), mu * m * across / k, start};
    }
    /// v = v_0 + (5/7) g sin(theta) t + (2/7)(s - v_0): dv/dt = g sin(theta) - F/m and
    /// ds/dt = g sin(theta) - 3.5 F/m.
    double speed(double t) const {
        return start + 5.0 / 7.0 * along * t + 2.0 / 7.0 * (slip.at(t) - start);
    }
    /// R w about the axis that rolls downhill.
    double surface(double t) const { return speed(t) - slip.at(t); }

    Vec3 normal, down;
    double along, across, mu, start;
    SlipUnderConstantLoad slip;
};

/// Between the states on both sides of a time.
Vec3 velocity_at(const SceneResult& r, std::size_t i, double time) {
    const double place = time / r.file.output_interval;
    const auto k = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(k);
    return (1 - share) * r.states[k][i].v + share * r.states[k + 1][i].v;
}

const std::string rolling_source = "rigid body, shear spring in series";

TEST_P(RollingScene, SlidingToRolling) {
    const SceneResult r = run("sliding-to-rolling");
    const OnPlane e(r, 0, 0);
    const double g = e.across, v0 = e.start, radius = r.radius(0);
    // The scheme's own (omega_s h)^2 of the swing; a change of regime within a step misses omega_s
    // h of that step's change of speed.
    const double wh = e.slip.frequency * r.step();
    const double swing = e.slip.limit * e.slip.frequency;
    const double tolerance = wh * (e.mu * g * r.step() + wh * swing) + roundoff(200) * v0;
    double worst_v = 0, worst_w = 0, worst_sum = 0;
    for (std::size_t k = 0; k < r.time.size(); ++k) {
        const Motion& m = r.states[k][0];
        const double t = r.time[k];
        worst_v = larger(worst_v, std::abs(m.v.x() - e.speed(t)));
        worst_w = larger(worst_w, std::abs(-radius * m.w.z() - e.surface(t)));
        worst_sum = larger(worst_sum, std::abs(m.v.x() - 0.4 * radius * m.w.z() - v0));
    }
    Case row{.scene = "sliding-to-rolling",
             .quantity = "v (largest error at any time)",
             .closed_form = "5/7 v_0 + 2/7 s(t)",
             .source = rolling_source,
             .unit = "m/s",
             .tolerance = "omega_s h mu g h, (omega_s h)^2 of the swing",
             .scale = v0};
    record(row, kernel(), 0, worst_v, tolerance);
    row.quantity = "R w (largest error at any time)";
    row.closed_form = "5/7 (v_0 - s(t))";
    record(row, kernel(), 0, worst_w, 2.5 * tolerance);
    row.quantity = "v + 0.4 R w - v_0 (largest at any time)";
    row.closed_form = "0";
    row.source = "moment about the line of contact";
    row.tolerance = "round-off of each step";
    record(row, kernel(), 0, worst_sum, roundoff(500) * v0);

    // Rolling, it swings about 5/7 v_0: the mean over the last swing.
    const auto swings = static_cast<std::size_t>(std::round(2 * pi / wh));
    double mean = 0;
    for (std::size_t k = 1; k <= swings; ++k)
        mean += r.states[r.states.size() - k][0].v.x() / static_cast<double>(swings);
    row = {.scene = "sliding-to-rolling",
           .quantity = "rolling speed, mean of the last swing",
           .closed_form = "5/7 v_0",
           .source = "moment about the line of contact",
           .unit = "m/s",
           .tolerance = "2/7 of the swing in slip, of a step too few or many"};
    record(row, kernel(), 5.0 / 7.0 * v0, mean, 2.0 / 7.0 * wh * swing + roundoff(200) * v0);

    // As a user would read it: sliding at -mu g, rolling from 2 v_0/(7 mu g) at 5/7 v_0.
    const auto at = [&](double t) {
        return static_cast<std::size_t>(std::round(t / r.file.output_interval));
    };
    const double rolls = 2 * v0 / (7 * e.mu * g);
    const std::size_t a = at(0.2 * rolls), b = at(0.8 * rolls);
    row = {.scene = "sliding-to-rolling",
           .quantity = "deceleration while it slides",
           .closed_form = "mu g",
           .source = "Coulomb",
           .unit = "m/s2",
           .tolerance = "round-off of each step"};
    const double slowed = r.states[a][0].v.x() - r.states[b][0].v.x();
    record(row, kernel(), e.mu * g, slowed / (r.time[b] - r.time[a]), roundoff(2e3) * e.mu * g);
    // The sliding line meets the rolling speed there.
    const double meets =
        r.time[a] + (r.states[a][0].v.x() - 5.0 / 7.0 * v0) / (slowed / (r.time[b] - r.time[a]));
    row = {.scene = "sliding-to-rolling",
           .quantity = "time at which sliding reaches 5/7 v_0",
           .closed_form = "2 v_0/(7 mu g)",
           .source = "rigid body",
           .unit = "s",
           .tolerance = "mu m g/(K_s v_0), the loading of the spring"};
    record(row, kernel(), rolls, meets, e.slip.limit / v0);
}

TEST_P(RollingScene, Incline) {
    const SceneResult r = run("incline");
    for (std::size_t i = 0; i < r.size(); ++i) {
        const OnPlane e(r, i, i);
        const double radius = r.radius(i), g = r.file.gravity.norm();
        const double theta = std::atan2(e.along, e.across);
        const Vec3 axis = e.normal.cross(e.down);  // a positive spin about it rolls downhill
        const double wh = e.slip.frequency * r.step(), swing = e.along / e.slip.frequency;
        const double tolerance =
            wh * (e.along * r.step() + wh * swing) + roundoff(200) * g * r.file.end;
        double worst_v = 0, worst_w = 0;
        for (std::size_t k = 0; k < r.time.size(); ++k) {
            const Motion& m = r.states[k][i];
            worst_v = larger(worst_v, std::abs(m.v.dot(e.down) - e.speed(r.time[k])));
            worst_w = larger(worst_w, std::abs(radius * m.w.dot(axis) - e.surface(r.time[k])));
        }
        const bool rolls = std::tan(theta) < 3.5 * e.mu;
        const std::string name = fmt::format("{:.4g} deg ({})", 180 / pi * theta,
                                             !rolls                     ? "slides"
                                             : e.slip.rolls_from() == 0 ? "rolls"
                                                                        : "slides, then rolls");
        Case row{.scene = "incline",
                 .quantity = "v at any time, largest error, " + name,
                 .closed_form = "5/7 g sin(theta) t + 2/7 s(t)",
                 .source = rolling_source,
                 .unit = "m/s",
                 .tolerance = "omega_s h g sin(theta) h, (omega_s h)^2 of the swing",
                 .scale = g * r.file.end};
        record(row, kernel(), 0, worst_v, tolerance);
        row.quantity = "R w at any time, largest error, " + name;
        row.closed_form = "5/7 (g sin(theta) t - s(t))";
        record(row, kernel(), 0, worst_w, 2.5 * tolerance);

        // As a user would read it: over the last swing of the shear spring, which goes on while the
        // sphere rolls.
        const double period = 2 * pi / e.slip.frequency, end = r.time.back();
        const Vec3 gained = r.last(i).v - velocity_at(r, i, end - period);
        row = {.scene = "incline",
               .quantity = "acceleration over the last swing, " + name,
               .closed_form = rolls ? "5/7 g sin(theta)" : "g (sin(theta) - mu cos(theta))",
               .source = "rigid body",
               .unit = "m/s2",
               .tolerance = rolls ? "(omega_s h)^2" : "round-off of each step",
               .scale = g};
        ASSERT_TRUE(!rolls || e.slip.rolls_from() < end - period);
        record(row, kernel(), rolls ? 5.0 / 7.0 * e.along : e.along - e.mu * e.across,
               gained.dot(e.down) / period, ((rolls ? wh * wh : 0) + roundoff(1e3)) * g);
    }
}

GRAINFIELD_FOR_ALL_SOLVERS(RollingScene);

}  // namespace
}  // namespace grainfield::verify
