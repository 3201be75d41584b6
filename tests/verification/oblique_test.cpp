// Oblique and spinning impacts against the closed form for linear springs with Coulomb friction.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/closed_forms.hpp"
#include "tests/verification/scene_test.hpp"

namespace grainfield::verify {
namespace {

using ObliqueScene = SceneTest;

const std::string oblique_source = "Di Maio & Di Renzo 2004";

/// Friction of sphere on wall or of two spheres [-].
double friction(const SceneResult& r, std::size_t i, double other_angle) {
    return std::tan(std::min(r.start.spheres.friction_angle[i], other_angle));
}

constexpr double no_limit = 100;  // friction from here on is as good as without a limit [-]

struct Expected {
    double slip;  ///< after the impact, over the normal speed [-]
    std::string regime, closed_form;
};

/// By the regime that slip over normal speed falls into.
Expected expected(double slip, double mu, double lambda) {
    if (mu > no_limit)
        return {slip * std::cos(pi * std::sqrt(3.5 * lambda)), "no limit to friction",
                "s cos(pi sqrt(3.5 lambda))"};
    if (slip >= std::max(mu / lambda, 7 * mu - mu / lambda))
        return {slip - 7 * mu, "sliding", "s - 7 mu v_n"};
    return {slip_after_impact(slip, mu, lambda),
            slip > mu / lambda ? "slides, sticks" : "sticks first",
            "pieces of sticking and sliding"};
}

/// The friction that cuts the spring at parting acts at steps: an error of first order there, in
/// the part of the slip that a step can change.
double step_tolerance(double omega, double lambda, double h, double mu, double slip) {
    const double wh = omega * h;
    if (mu > no_limit) return 1.2 * std::sqrt(3.5 * lambda) * wh * slip;
    return 3.5 * mu * wh * wh + 1e-300;
}

TEST_P(ObliqueScene, OnPlane) {
    const SceneResult r = run("oblique-plane");
    const double lambda = r.lambda();
    for (std::size_t i = 0; i < r.size(); ++i) {
        const Motion before = r.first(i), after = r.last(i);
        const double vn = -before.v.y(), radius = r.radius(i);
        const double mu = friction(r, i, r.file.walls[0].friction_angle);
        const double omega = std::sqrt(r.wall_stiffness(i, 0) / r.mass(i));
        const double s0 = before.v.x() + radius * before.w.z();
        const Expected e = expected(s0 / vn, mu, lambda);
        const double change = e.slip * vn - s0;
        const std::string name =
            fmt::format("{:.4g} deg ({})", 180 / pi * std::atan2(before.v.x(), vn), e.regime);
        const double tolerance = step_tolerance(omega, lambda, r.step(), mu, s0 / vn) * vn +
                                 roundoff(200) * before.v.norm();
        const std::string why = mu > no_limit ? "parting within a step: 1.2 omega_s h of the slip"
                                              : "3.5 mu (omega h)^2 v_n, and round-off";
        record({.scene = "oblique-plane",
                .quantity = "v_x after, " + name,
                .closed_form = "v_x + (s' - s)/3.5, s' = " + e.closed_form,
                .source = oblique_source,
                .unit = "m/s",
                .tolerance = why,
                .scale = before.v.norm()},
               kernel(), before.v.x() + change / 3.5, after.v.x(), tolerance);
        record({.scene = "oblique-plane",
                .quantity = "R w after, " + name,
                .closed_form = "R w + (s' - s)/1.4",
                .source = oblique_source,
                .unit = "m/s",
                .tolerance = why,
                .scale = before.v.norm()},
               kernel(), radius * before.w.z() + change / 1.4, radius * after.w.z(), tolerance);
        EXPECT_NEAR(after.v.y(), vn, roundoff(1000) * before.v.norm());
    }
    // The springs that are loaded when their contact opens (no limit to friction) go to friction;
    // within the last step that is good to omega_s h of their energy, a hundredth of all.
    EXPECT_NEAR(r.energy_sum(1), r.energy_sum(0), 1e-4 * r.energy_sum(0));
}

TEST_P(ObliqueScene, OfSpheres) {
    const SceneResult r = run("oblique-spheres");
    const double lambda = r.lambda();
    for (std::size_t i = 0; i < r.size(); i += 2) {
        const Motion a0 = r.first(i), b0 = r.first(i + 1), a = r.last(i), b = r.last(i + 1);
        const double ra = r.radius(i), rb = r.radius(i + 1), m = r.effective_mass(i, i + 1);
        const double mu = friction(r, i, r.start.spheres.friction_angle[i + 1]);
        const double omega = std::sqrt(r.pair_stiffness(i, i + 1) / m);
        const double vn = a0.v.x() - b0.v.x(), vt = b0.v.y() - a0.v.y();
        const Expected e = expected(vt / vn, mu, lambda);
        const double change = e.slip * vn - vt;
        const std::string name = fmt::format("{:.4g} deg ({}{})", 180 / pi * std::atan2(vt, vn),
                                             ra == rb ? "" : "unlike spheres, ", e.regime);
        const double speed = std::hypot(vn, vt);
        // The normal turns by v_t t/(r_a + r_b), and the slip's part of it with the normal speed.
        const double turn = vt * pi / omega / (ra + rb);
        const double tolerance = step_tolerance(omega, lambda, r.step(), mu, vt / vn) * vn +
                                 (turn + roundoff(200)) * speed;
        const std::string why =
            mu > no_limit ? "parting within a step; the normal turns by v_t t_c/(r_a + r_b)"
                          : "the normal turns by v_t t_c/(r_a + r_b)";
        record({.scene = "oblique-spheres",
                .quantity = "relative v_y after, " + name,
                .closed_form = "v_y + (s' - s)/3.5, s' = " + e.closed_form,
                .source = oblique_source,
                .unit = "m/s",
                .tolerance = why,
                .scale = speed},
               kernel(), vt + change / 3.5, b.v.y() - a.v.y(), tolerance);
        record({.scene = "oblique-spheres",
                .quantity = "r_a w_a + r_b w_b after, " + name,
                .closed_form = "-(s' - s)/1.4",
                .source = oblique_source,
                .unit = "m/s",
                .tolerance = why,
                .scale = speed},
               kernel(), -change / 1.4, ra * a.w.z() + rb * b.w.z(), tolerance);
    }
}

TEST_P(ObliqueScene, SpinningDrop) {
    const SceneResult r = run("spinning-drop");
    const double g = r.file.gravity.norm(), mu_s = r.lambda();
    for (std::size_t i = 0; i < r.size(); ++i) {
        const Motion before = r.first(i), after = r.last(i);
        const double radius = r.radius(i);
        const double omega = std::sqrt(r.wall_stiffness(i, 0) / r.mass(i));
        const double mu = friction(r, i, r.file.walls[0].friction_angle);
        const double vn = std::sqrt(2 * g * (before.x.y() - radius));
        const double time = 2 / omega * (pi - std::atan(omega * vn / g));
        const Vec3 arm(0, -radius, 0);
        const Vec3 slip = before.v + before.w.cross(arm);
        const Vec3 along = slip.normalized();
        const bool slides = mu < no_limit;
        // Gross sliding: the whole Coulomb impulse; sticking: a swing of the shear spring.
        const double change =
            slides ? -3.5 * mu * (2 * vn + g * time)
                   : slip.norm() * (std::cos(omega * std::sqrt(3.5 * mu_s) * time) - 1);
        const Vec3 dv = change / 3.5 * along;
        // R dw x (-y) = change along/1.4.
        const Vec3 dw = change / 1.4 / radius * Vec3(-along.z(), 0, along.x());
        const double wh = omega * r.step();
        const double tolerance = slides ? (2 * wh * wh + roundoff(2000)) * slip.norm()
                                        : 1.2 * std::sqrt(3.5 * mu_s) * wh * slip.norm();
        const std::string why = slides ? "2 (omega h)^2 of the slip"
                                       : "parting within a step: 1.2 omega_s h of the slip";
        const std::string name = fmt::format("sphere {} ({})", i, slides ? "sliding" : "sticking");
        record({.scene = "spinning-drop",
                .quantity = "change of speed, " + name,
                .closed_form = slides ? "mu (2 v_n + g t_c)" : "(2/7) s (1 - cos(omega_s t_c))",
                .source = "Coulomb impulse; shear oscillator",
                .unit = "m/s",
                .tolerance = why,
                .scale = slip.norm()},
               kernel(), -change / 3.5, -(after.v - before.v).dot(along), tolerance);
        record({.scene = "spinning-drop",
                .quantity = "change of spin, " + name,
                .closed_form =
                    slides ? "2.5 mu (2 v_n + g t_c)/R" : "(5/7) s (1 - cos(omega_s t_c))/R",
                .source = "Coulomb impulse; shear oscillator",
                .unit = "rad/s",
                .tolerance = why,
                .scale = slip.norm() / radius},
               kernel(), dw.norm(), (after.w - before.w).dot(dw.normalized()), tolerance / radius);
        // Across the slip nothing changes.
        const Vec3 across = (after.v - before.v) - dv;
        EXPECT_LT(Vec3(across.x(), 0, across.z()).norm(), tolerance);
        EXPECT_LT((after.w - before.w - dw).norm(), tolerance / radius);
    }
}

GRAINFIELD_FOR_ALL_SOLVERS(ObliqueScene);

}  // namespace
}  // namespace grainfield::verify
