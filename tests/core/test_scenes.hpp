#pragma once
// Small scenes that the tests of physics share.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/base/random.hpp"
#include "core/simulation.hpp"
#include "tests/kernels/kernel_tables.hpp"

namespace grainfield::core {

using kernels::KernelCase;
using kernels::KernelTest;

/// Soft, so that overlaps are far above the round-off of positions.
inline constexpr double test_radius = 0.05;     // [m]
inline constexpr double test_stiffness = 1e6;   // k_n of spheres and walls [Pa]
inline constexpr double test_density = 2650.0;  // [kg/m3]
inline constexpr double pi = std::numbers::pi;
inline constexpr double g = 9.81;                                      // [m/s2]
inline constexpr double test_kn = 0.5 * test_radius * test_stiffness;  // K_n of two of them [N/m]
inline constexpr double test_mass =
    test_density * 4.0 / 3.0 * pi * test_radius * test_radius * test_radius;  // [kg]

struct Ball {
    Vec3 x = Vec3::Zero();              // [m]
    Vec3 v = Vec3::Zero();              // [m/s]
    Vec3 w = Vec3::Zero();              // [rad/s]
    double radius = test_radius;        // [m]
    double stiffness = test_stiffness;  // [Pa]
};

/// `friction` is tan(phi); zero makes a scene without shear forces and spins.
inline Scene scene_of(const std::vector<Ball>& balls, double friction = 0.0) {
    Scene scene;
    scene.spheres.resize(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        scene.spheres.position.set(i, balls[i].x);
        scene.spheres.velocity.set(i, balls[i].v);
        scene.spheres.spin.set(i, balls[i].w);
        scene.spheres.radius[i] = balls[i].radius;
        scene.spheres.normal_stiffness[i] = balls[i].stiffness;
        scene.spheres.friction_angle[i] = std::atan(friction);
    }
    scene.spheres.set_density(test_density);
    return scene;
}

inline Wall plane(const Vec3& point, const Vec3& normal, double friction = 0.0,
                  double stiffness_ratio = 0.1) {
    Wall wall;
    wall.point = point;
    wall.normal = normal.normalized();
    wall.friction_angle = std::atan(friction);
    wall.normal_stiffness = test_stiffness;
    wall.stiffness_ratio = stiffness_ratio;
    return wall;
}

/// Frequency of a contact [rad/s].
inline double frequency(double stiffness, double mass) {
    return std::sqrt(stiffness / mass);
}

/// The step in which a contact of frequency omega, started at touching, lasts exactly n steps:
/// leapfrog turns a spring at w_h = (2/h) asin(omega h/2), and n h w_h = pi.
inline double aligned_step(double omega, int n) {
    return 2.0 / omega * std::sin(pi / (2.0 * n));
}

/// Uniform in (-1, 1), three at an index.
inline Vec3 random_vec(std::uint64_t index, std::uint64_t realization = 0) {
    static const RandomStream stream(11, Stream::perturbation);
    return Vec3(2 * stream.uniform(realization, 3 * index) - 1,
                2 * stream.uniform(realization, 3 * index + 1) - 1,
                2 * stream.uniform(realization, 3 * index + 2) - 1);
}

/// An arbitrary rotation without symmetry.
inline Eigen::Matrix3d some_rotation() {
    return Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
}

/// n[0] x n[1] x n[2] spheres of +-20 % in radius on a cubic grid of `spacing` times the largest
/// diameter, moved off it a little, with random velocities up to `speed` [m/s].
inline std::vector<Ball> loose_balls(std::array<int, 3> n, double spacing, double speed) {
    std::vector<Ball> balls;
    const double grid = 2.4 * test_radius * spacing;
    for (int a = 0; a < n[0]; ++a)
        for (int b = 0; b < n[1]; ++b)
            for (int c = 0; c < n[2]; ++c) {
                const auto i = static_cast<std::uint64_t>(balls.size());
                Ball ball;
                ball.radius = test_radius * (1.0 + 0.2 * random_vec(i, 1).x());
                ball.x = grid * Vec3(a + 0.5, b + 0.5, c + 0.5) +
                         0.5 * grid * (1.0 - 1.0 / spacing) * random_vec(i, 2);
                ball.v = speed * random_vec(i, 3);
                balls.push_back(ball);
            }
    return balls;
}

/// The box around loose_balls(n, spacing, ...).
inline Box loose_box(std::array<int, 3> n, double spacing) {
    return {Vec3::Zero(), 2.4 * test_radius * spacing * Vec3(n[0], n[1], n[2])};
}

inline void run_steps(Simulation& simulation, double step, int steps) {
    for (int k = 0; k < steps; ++k) {
        simulation.compute_forces();
        simulation.advance(step);
    }
}

inline double sphere_mass(double radius) {
    return test_density * 4.0 / 3.0 * pi * radius * radius * radius;
}

}  // namespace grainfield::core
