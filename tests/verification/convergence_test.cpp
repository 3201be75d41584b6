// Order of the integrator: the error over the step, halved again and again.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/verification/closed_forms.hpp"
#include "tests/verification/scene_test.hpp"

namespace grainfield::verify {
namespace {

using ConvergenceScene = SceneTest;

TEST_P(ConvergenceScene, SwingOnANormalSpring) {
    std::vector<double> errors;
    const double coarsest = *load("oscillation").step;
    for (int halvings = 0; halvings < 4; ++halvings) {
        triaxial::SceneFile file = load("oscillation");
        file.step = coarsest / (1 << halvings);
        const SceneResult r = run(file, "oscillation");
        const double g = file.gravity.norm(), k = r.wall_stiffness(0, 0),
                     omega = std::sqrt(k / r.mass(0));
        const double middle = r.mass(0) * g / k;
        const double start = r.radius(0) - r.first(0).x.y() - middle;
        ASSERT_GT(middle, std::abs(start)) << "the sphere would leave the plane";
        const double overlap = middle + start * std::cos(omega * r.time.back());
        const double error = r.radius(0) - r.last(0).x.y() - overlap;
        errors.push_back(error);
        const double wh = omega * *file.step;
        // Phase off by (omega h)^2/24 of itself, and half a step's start to second order.
        const double phase = omega * r.time.back();
        record({.scene = "oscillation",
                .quantity = fmt::format("overlap at the end, step {}h",
                                        halvings == 0 ? "" : fmt::format("1/{} ", 1 << halvings)),
                .closed_form = "m g/K + (d_0 - m g/K) cos(omega t)",
                .source = "linear oscillator",
                .unit = "m",
                .tolerance = "(omega h)^2/24 of the phase, the order of the step",
                .scale = std::abs(start)},
               kernel(), overlap, overlap + error,
               (1.1 * wh * wh / 24 * phase + roundoff(1000)) * std::abs(start));
    }
    for (std::size_t n = 1; n < errors.size(); ++n) {
        // In single precision round-off, 1e-7 of the overlap, is soon in sight of the error.
        const double floor = roundoff(50) * errors[0] / errors[n];
        record(
            {.scene = "oscillation",
             .quantity = fmt::format("order, from 1/{} to 1/{} of the step", 1 << (n - 1), 1 << n),
             .closed_form = "2",
             .source = "leapfrog",
             .tolerance = "next order, round-off"},
            kernel(), 2, std::log2(errors[n - 1] / errors[n]), 0.02 + floor);
    }
}

TEST_P(ConvergenceScene, SwingOfTheShearSpring) {
    // The sphere on the flattest incline never slips: its shear spring swings from the start on.
    std::vector<double> errors;
    double travel = 0;
    const double coarsest = 8 * *load("incline").step;
    for (int halvings = 0; halvings < 3; ++halvings) {
        triaxial::SceneFile file = load("incline");
        file.step = coarsest / (1 << halvings);
        file.end = 0.1024;
        const SceneResult r = run(file, "incline");
        const std::size_t i = r.size() - 1;
        const Vec3 normal = file.walls[i].normal;
        const Vec3 along = file.gravity - file.gravity.dot(normal) * normal;
        const double omega = std::sqrt(3.5 * r.lambda() * r.wall_stiffness(i, i) / r.mass(i));
        const double t = r.time.back(), a = along.norm();
        // x = (5/7) a t^2/2 + (2/7)(a/omega_s^2)(1 - cos(omega_s t)): the integral of the speed.
        const double x =
            5.0 / 14.0 * a * t * t + 2.0 / 7.0 * a / (omega * omega) * (1 - std::cos(omega * t));
        travel = x;
        errors.push_back((r.last(i).x - r.first(i).x).dot(along.normalized()) - x);
    }
    for (std::size_t n = 1; n < errors.size(); ++n)
        record(
            {.scene = "incline",
             .quantity = fmt::format("order of the shear swing, {}h to {}h", 8 >> (n - 1), 8 >> n),
             .closed_form = "2",
             .source = "leapfrog",
             .tolerance = "next order, round-off"},
            kernel(), 2, std::log2(errors[n - 1] / errors[n]),
            0.02 + roundoff(10) * travel / std::abs(errors[n]));
}

GRAINFIELD_FOR_ALL_SOLVERS(ConvergenceScene);

}  // namespace
}  // namespace grainfield::verify
