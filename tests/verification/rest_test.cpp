// Spheres at rest and in balance: weight, column, squeezed pair, gears; a pair that turns.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/larger.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/scene_test.hpp"

namespace grainfield::verify {
namespace {

using RestScene = SceneTest;
using TurningScene = SceneTest;

const std::string balance = "balance of forces, Eq. (4)";
const std::string rest = "round-off of a position over the overlap";

TEST_P(RestScene, SphereAtRest) {
    const SceneResult r = run("sphere-at-rest");
    const double weight = r.mass(0) * r.file.gravity.norm();
    ASSERT_EQ(r.contacts.size(), 1U);
    // Local damping stops the sphere within round-off of its position, 100 times the overlap.
    const double overlap = weight / r.wall_stiffness(0, 0), tolerance = roundoff(200);
    record({.scene = "sphere-at-rest",
            .quantity = "overlap",
            .closed_form = "m g/K_n",
            .source = balance,
            .unit = "m",
            .tolerance = rest},
           kernel(), overlap, r.contacts[0].overlap, tolerance * overlap);
    record({.scene = "sphere-at-rest",
            .quantity = "normal force",
            .closed_form = "m g",
            .source = balance,
            .unit = "N",
            .tolerance = rest},
           kernel(), weight, r.contacts[0].normal, tolerance * weight);
    record({.scene = "sphere-at-rest",
            .quantity = "shear force",
            .closed_form = "0",
            .source = balance,
            .unit = "N",
            .tolerance = "nothing along the plane",
            .scale = weight},
           kernel(), 0, r.contacts[0].shear.norm(), 0);
}

TEST_P(RestScene, Column) {
    const SceneResult r = run("column");
    const double weight = r.mass(0) * r.file.gravity.norm();
    const auto n = static_cast<int>(r.size());
    ASSERT_EQ(r.contacts.size(), r.size());
    for (const Contact& c : r.contacts) {
        const int carried = c.j < 0 ? n : n - 1 - c.i;  // spheres above the contact
        const double expected = carried * weight;
        const double stiffness = c.j < 0 ? r.wall_stiffness(0, 0) : r.pair_stiffness(0, 1);
        // Positions are up to 13 radii, 1300 overlaps of the top contact; single precision keeps
        // displacements instead.
        const double tolerance = is_mixed() ? roundoff(200) : roundoff(2e4);
        record({.scene = "column",
                .quantity = fmt::format("force below {} spheres", carried),
                .closed_form = "k m g",
                .source = balance,
                .unit = "N",
                .tolerance = rest},
               kernel(), expected, c.normal, tolerance * weight);
        record({.scene = "column",
                .quantity = fmt::format("overlap below {} spheres", carried),
                .closed_form = "k m g/K_n",
                .source = balance,
                .unit = "m",
                .tolerance = rest},
               kernel(), expected / stiffness, c.overlap, tolerance * weight / stiffness);
    }
}

TEST_P(RestScene, SqueezedPair) {
    const SceneResult r = run("squeezed-pair");
    const auto& walls = r.file.walls;
    const double height = (walls[1].point - walls[0].point).dot(walls[0].normal);
    const double squeeze = 2 * r.radius(0) + 2 * r.radius(1) - height;
    const double k0 = r.wall_stiffness(0, 0), k1 = r.wall_stiffness(1, 1);
    const double k01 = r.pair_stiffness(0, 1);
    const double force = squeeze / (1 / k0 + 1 / k01 + 1 / k1);
    ASSERT_EQ(r.contacts.size(), 3U);
    for (const Contact& c : r.contacts) {
        const std::string name =
            c.j >= 0 ? "between the spheres" : fmt::format("on wall {}", -1 - c.j);
        const double k = c.j >= 0 ? k01 : c.j == -1 ? k0 : k1;
        record({.scene = "squeezed-pair",
                .quantity = "force " + name,
                .closed_form = "squeeze/(1/K_0 + 1/K_01 + 1/K_1)",
                .source = balance,
                .unit = "N",
                .tolerance = rest},
               kernel(), force, c.normal, roundoff(is_mixed() ? 100 : 2000) * force);
        record({.scene = "squeezed-pair",
                .quantity = "overlap " + name,
                .closed_form = "F/K",
                .source = balance,
                .unit = "m",
                .tolerance = rest},
               kernel(), force / k, c.overlap, roundoff(is_mixed() ? 100 : 2000) * squeeze);
    }
    record({.scene = "squeezed-pair",
            .quantity = "elastic energy",
            .closed_form = "F squeeze/2",
            .source = balance,
            .unit = "J",
            .tolerance = rest},
           kernel(), 0.5 * force * squeeze, r.energy.back()[3],
           roundoff(is_mixed() ? 100 : 4000) * force * squeeze);
}

TEST_P(RestScene, Gears) {
    const SceneResult r = run("gears");
    double spin = 0, moved = 0, speed = 0, shear = 0;
    for (const auto& state : r.states)
        for (std::size_t i = 0; i < r.size(); ++i) {
            spin = std::max(spin, (state[i].w - r.first(i).w).norm());
            moved = std::max(moved, (state[i].x - r.first(i).x).norm());
            speed = std::max(speed, state[i].v.norm());
        }
    ASSERT_EQ(r.contacts.size(), 3U);
    for (const Contact& c : r.contacts) shear = std::max(shear, c.shear.norm());
    const double w = r.first(0).w.norm(), overlap = r.contacts[0].overlap;
    const double force = r.contacts[0].normal;
    Case row{.scene = "gears",
             .quantity = "shear force (largest)",
             .closed_form = "0",
             .source = "r_i w_i + r_j w_j = 0",
             .unit = "N",
             .tolerance = "round-off of each step",
             .scale = force};
    record(row, kernel(), 0, shear, roundoff(100) * force);
    row.quantity = "change of spin (largest)";
    row.unit = "rad/s";
    row.scale = w;
    record(row, kernel(), 0, spin, roundoff(100) * w);
    row.quantity = "displacement (largest)";
    row.unit = "m";
    row.scale = overlap;
    // The start is in balance but for the round-off of positions, 200 overlaps.
    record(row, kernel(), 0, moved, roundoff(1000) * overlap);
    EXPECT_LT(speed, roundoff(1000) * overlap / r.step());
}

TEST_P(TurningScene, LoadedShearSpringTurnsWithThePair) {
    using Complex = std::complex<double>;
    const SceneResult r = run("turning-pair");
    const double m = r.effective_mass(0, 1), k = r.lambda() * r.pair_stiffness(0, 1);
    const double turning = r.first(0).w.x(), square = 3.5 * k / m;
    const auto tangential = [](const Vec3& v) { return Complex(v.y(), v.z()); };
    // The spins' part of the slip, -(r_i w_i + r_j w_j) x n with n along x.
    const auto by_spin = [&](const Motion& i, const Motion& j) {
        return -tangential((r.radius(0) * i.w + r.radius(1) * j.w).cross(Vec3::UnitX()));
    };
    // d/dt (y, v, p, xi), see the scene.
    const Complex one(0, 1);
    Eigen::Matrix4cd rate = Eigen::Matrix4cd::Zero();
    rate(0, 1) = 1;
    rate(1, 3) = -k / m;
    rate(2, 3) = -2.5 * k / m;
    rate.row(3) << -one * turning, 1, 1, one * turning;
    const Eigen::ComplexEigenSolver<Eigen::Matrix4cd> modes(rate);
    const Motion i0 = r.first(0), j0 = r.first(1);
    const Complex v0 = tangential(j0.v - i0.v), p0 = by_spin(i0, j0), s0 = v0 + p0;
    const Eigen::Vector4cd shares =
        modes.eigenvectors().partialPivLu().solve(Eigen::Vector4cd(0, v0, p0, 0));
    const auto solution = [&](double t) -> Eigen::Vector4cd {
        return modes.eigenvectors() *
               (modes.eigenvalues() * t).array().exp().matrix().cwiseProduct(shares);
    };
    const double wh = r.step() * std::sqrt(square);
    // The scheme's frequencies are off by (omega h)^2/24, over the swing's phase of some 40 rad,
    // and the normal force on the turned normal adds overlap/(2 r lambda) to them.
    const double phase = std::sqrt(square) * r.time.back();
    const double overlap = r.radius(0) + r.radius(1) - (r.first(1).x - r.first(0).x).norm();
    const double soft = overlap / ((r.radius(0) + r.radius(1)) * r.lambda());
    const double tolerance = phase * (wh * wh / 24 + soft) + wh * wh + roundoff(200);
    double worst_v = 0, worst_p = 0;
    for (std::size_t n = 0; n < r.time.size(); ++n) {
        const Motion &i = r.states[n][0], &j = r.states[n][1];
        const Eigen::Vector4cd e = solution(r.time[n]);
        worst_v = larger(worst_v, std::abs(tangential(j.v - i.v) - e[1]));
        worst_p = larger(worst_p, std::abs(by_spin(i, j) - e[2]));
    }
    Case row{.scene = "turning-pair",
             .quantity = "relative velocity (largest error at any time)",
             .closed_form = "linear system, v(t)",
             .source = "objectivity: the spring turns along",
             .unit = "m/s",
             .tolerance = "(omega_s h)^2/24 and overlap/(2 r lambda) of the phase",
             .scale = std::abs(s0)};
    record(row, kernel(), 0, worst_v, tolerance * std::abs(s0));
    row.quantity = "r_i w_i + r_j w_j (largest error at any time)";
    row.closed_form = "linear system, p(t)";
    record(row, kernel(), 0, worst_p, tolerance * std::abs(s0));
    const Complex xi = solution(r.time.back())[3];
    const double scale = k * std::abs(s0) / std::sqrt(square);
    for (const Contact& c : r.contacts)
        if (c.i == 0 && c.j == 1) {
            row.quantity = "shear force at the end, y";
            row.closed_form = "K_s xi(t)";
            row.unit = "N";
            row.scale = scale;
            record(row, kernel(), k * xi.real(), c.shear.y(), tolerance * scale);
            row.quantity = "shear force at the end, z";
            record(row, kernel(), k * xi.imag(), c.shear.z(), tolerance * scale);
        }
    EXPECT_EQ(r.contacts.size(), 3U);
    EXPECT_GT(turning * r.time.back(), 2 * pi);
}

GRAINFIELD_FOR_ALL_SOLVERS(RestScene);
GRAINFIELD_FOR_ALL_SOLVERS(TurningScene);

}  // namespace
}  // namespace grainfield::verify
