// A contact turned as a rigid body keeps its force; a cycle of motion leaves none behind.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/kernels/prescribed_pair.hpp"
#include "tests/larger.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::kernels {
namespace {

constexpr double ri = 0.05, rj = 0.02;
constexpr double plenty = 1e6;  // friction that never slips [-]

using Objectivity = KernelTest;
using Ratcheting = KernelTest;
using PairForce = KernelTest;

TEST_P(Objectivity, RigidTurnsKeepTheShearForce) {
    const Vec3 xi(0.03, -0.01, 0.02);
    const Vec3 normal = Vec3(1, 2, 2) / 3.0;
    const Vec3 xj = xi + 0.99 * (ri + rj) * normal;
    const Vec3 shear0 = 40.0 * normal.cross(Vec3::UnitX()).normalized();
    // Across the normal, about it, and in between.
    for (const Vec3& direction : {Vec3(0, 1, -1), normal, Vec3(1, -0.3, 0.5)}) {
        const Vec3 axis = direction.normalized();
        PrescribedPair pair(table(), ri, rj, xi, xj, plenty);
        pair.set_shear(shear0);
        const double angle = 2 * std::numbers::pi / 100;
        double worst = 0;
        for (int k = 1; k <= 100 * 1000; ++k) {
            const Eigen::Matrix3d turn = Eigen::AngleAxisd((k % 100) * angle, axis).matrix();
            pair.move(turn * xi, turn * xj, angle * axis, angle * axis);
            worst = larger(worst, (pair.shear() - turn * shear0).norm() / shear0.norm());
        }
        // The turn's angle comes in with a round-off of 1e-16: after 6,300 rad that is 6e-13 of the
        // reach of 0.07 m, against a spring stretched by 40 N/K_s = 4.6e-3 m: 1e-11; rounding of
        // the normals adds as much a few times over.
        // Float keeps the turning pair's displacements too: twice that.
        verify::record({.scene = "Objectivity and ratcheting of a contact",
                        .quantity = "shear force in the turning frame, 1000 turns, largest change",
                        .closed_form = "0",
                        .source = "objectivity",
                        .unit = "N",
                        .tolerance = "round-off of the angle over the stretched spring",
                        .scale = shear0.norm()},
                       GetParam().name, 0, worst * shear0.norm(),
                       std::max(1e-10, roundoff(2e5)) * shear0.norm());
    }
}

/// One step in which a pair turns, slips, rolls, twists and closes by angles of the size given,
/// against the reference: below and above the turn up to which float goes a shorter way.
TEST_P(Objectivity, StepsOfAnySizeGiveWhatTheReferenceGives) {
    const Vec3 normal = Vec3(1, 2, 2) / 3.0;
    const Vec3 xj = 0.999 * (ri + rj) * normal;
    const Vec3 tangent = normal.cross(Vec3::UnitX()).normalized();
    // From no force, where all that there is is what the step adds; and of spheres that only spin.
    for (const double old_force : {0.0, 40.0})
        for (const double orbit : {1.0, 0.0})
            for (const double turn : {1e-6, 1e-5, 1e-4, 2.9e-4, 3.1e-4, 1e-3, 1e-2})
                for (const Vec3& axis : {Vec3(0, 1, -1), normal, Vec3(1, -0.3, 0.5)}) {
                    const Vec3 angle = turn * axis.normalized();
                    const auto force = [&](const KernelTable& kernels) {
                        PrescribedPair pair(kernels, ri, rj, Vec3::Zero(), xj, plenty);
                        pair.set_shear(old_force * tangent);
                        const Vec3 slip = 0.3 * turn * (ri + rj) * normal.cross(Vec3::UnitY());
                        const Vec3 closing = -0.1 * turn * (ri + rj) * normal;
                        pair.move(Vec3::Zero(), xj + orbit * (angle.cross(xj) + slip + closing),
                                  1.2 * angle + 0.1 * turn * Vec3::UnitX(), 0.7 * angle);
                        return pair.shear();
                    };
                    const Vec3 expected = force(reference_kernels());
                    const Vec3 off = force(table()) - expected;
                    // Turning the old force is exact to round-off of that force, what the step
                    // adds to that of itself and of the places, 1e-17 m times K_s.
                    const double added = (expected - old_force * tangent).norm();
                    const double rounded = roundoff(16) * (added + old_force) + 2e-13;
                    // The short way of float is off by a share of the turn: across the normal by a
                    // small one, along it by some, which is gone in the next step.
                    const bool is_short = is_mixed() && turn < 3e-4;
                    const Vec3 n =
                        (xj + orbit * (angle.cross(xj) +
                                       0.3 * turn * (ri + rj) * normal.cross(Vec3::UnitY())))
                            .normalized();
                    const std::string where =
                        "turn " + std::to_string(turn) + ", orbit " + std::to_string(orbit);
                    EXPECT_LT((off - off.dot(n) * n).norm(),
                              rounded + (is_short ? 0.1 * turn * added : 0))
                        << where;
                    EXPECT_LT(std::abs(off.dot(n)), rounded + (is_short ? 4 * turn * added : 0))
                        << where;
                }
}

TEST_P(Objectivity, FewLargeStepsAreAsExactAsManySmallOnes) {
    const Vec3 normal = Vec3(1, 2, 2) / 3.0;
    const Vec3 axis = Vec3(1, -0.3, 0.5).normalized();
    const Vec3 xj = 0.99 * (ri + rj) * normal;
    const Vec3 shear0 = 7.0 * normal.cross(Vec3::UnitX()).normalized();
    // The vector kernels take turns of up to 0.1 rad a step.
    // Of 1e-4 rad in float they go a shorter way.
    for (int steps :
         is_reference() ? std::vector{3, 7, 1000, 62832} : std::vector{100, 1000, 62832}) {
        PrescribedPair pair(table(), ri, rj, Vec3::Zero(), xj, plenty);
        pair.set_shear(shear0);
        for (int k = 1; k <= steps; ++k) {
            const double angle = 2 * std::numbers::pi / steps;
            const Eigen::Matrix3d turn = Eigen::AngleAxisd(k * angle, axis).matrix();
            pair.move(Vec3::Zero(), turn * xj, angle * axis, angle * axis);
        }
        EXPECT_LT((pair.shear() - shear0).norm() / shear0.norm(), roundoff(2e4)) << steps;
    }
}

/// A closed cycle: the pair rolls and slides along a path at one overlap, is pushed, goes the same
/// path backwards at another overlap, and is pulled.
double left_behind(const KernelTable& table, double overlap_out, double overlap_back, bool orbit) {
    const int steps = 40;
    std::vector<Vec3> normal{Vec3(1, 2, 2) / 3.0}, spin_i, spin_j;
    for (int k = 0; k < steps; ++k) {
        spin_i.emplace_back(0.003 + 1e-4 * k, -0.002, 0.004);
        spin_j.emplace_back(-0.001, 0.003, 0.005 - 1e-4 * k);
        const Vec3 turn(0.002, orbit ? -0.006 : 0.0, orbit ? 0.001 * k / steps : 0.0);
        normal.push_back(orbit ? Vec3((normal[k] + turn).normalized()) : normal[0]);
    }
    const double reach = ri + rj;
    const Vec3 at_rest = Vec3::Zero();
    PrescribedPair pair(table, ri, rj, at_rest, (reach - overlap_out) * normal[0], plenty);
    double peak = 0;
    for (int k = 0; k < steps; ++k) {
        pair.move(at_rest, (reach - overlap_out) * normal[k + 1], spin_i[k], spin_j[k]);
        peak = std::max(peak, pair.shear().norm());
    }
    pair.move(at_rest, (reach - overlap_back) * normal[steps], at_rest, at_rest);
    for (int k = steps - 1; k >= 0; --k)
        pair.move(at_rest, (reach - overlap_back) * normal[k], -spin_i[k], -spin_j[k]);
    pair.move(at_rest, (reach - overlap_out) * normal[0], at_rest, at_rest);
    EXPECT_GT(peak, 1.0);  // [N]
    return pair.shear().norm() / peak;
}

TEST_P(Ratcheting, PushRotatePullRotateBackLeavesNoForce) {
    // 80 steps, each rounding a displacement against a peak of some 1e-3 m.
    for (double back : {1e-5, 2e-3, 8e-3}) {
        for (bool orbit : {false, true})
            verify::record({.scene = "Objectivity and ratcheting of a contact",
                            .quantity = "shear force left by push, roll, pull, roll back, over its "
                                        "peak",
                            .closed_form = "0",
                            .source = "McNamara et al. 2008",
                            .tolerance = "round-off of 80 steps"},
                           GetParam().name, 0, left_behind(table(), 1e-3, back, orbit),
                           roundoff(4500));
    }
}

TEST_P(PairForce, ForcesAndMomentsBalance) {
    const Vec3 xj = 0.93 * (ri + rj) * Vec3(1, 2, 2) / 3.0;
    PrescribedPair pair(table(), ri, rj, Vec3::Zero(), xj, 0.4);
    pair.move(Vec3(1e-3, 2e-3, 0), xj, Vec3(0.1, 0.2, -0.3), Vec3(0.5, -0.1, 0.2));
    const Vec3 branch = xj - Vec3(1e-3, 2e-3, 0);
    // Both moments and the couple of the forces on the centres add up to nothing.
    const Vec3 couple = (ri + rj) * pair.moment_per_radius() - branch.cross(pair.force());
    EXPECT_GT(pair.shear().norm(), 1.0);
    EXPECT_LT(couple.norm(), roundoff(16) * branch.norm() * pair.force().norm());
}

TEST_P(PairForce, OpeningForgetsTheShearForce) {
    const Vec3 near(0.99 * (ri + rj), 0, 0), far(1.01 * (ri + rj), 0, 0);
    PrescribedPair pair(table(), ri, rj, Vec3::Zero(), near, plenty);
    pair.move(Vec3::Zero(), near, Vec3(0, 0, 1e-3), Vec3::Zero());
    EXPECT_GT(pair.shear().norm(), 0.0);
    pair.move(Vec3::Zero(), far, Vec3::Zero(), Vec3::Zero());
    EXPECT_FALSE(pair.touching());
    EXPECT_EQ(pair.shear().norm(), 0.0);
}

/// Spheres that meet within a step and slip meanwhile: of the slip the spring takes the share of
/// the step in which they touched.
TEST_P(PairForce, MeetingWithinAStepLoadsTheShareOfIt) {
    const Vec3 normal = Vec3(1, 2, 2) / 3.0;
    const double reach = ri + rj;
    for (const double way : {1e-4, 1e-3}) {  // over the reach: short way and long way of float
        const auto shear = [&](const KernelTable& kernels) {
            PrescribedPair pair(kernels, ri, rj, Vec3::Zero(), reach * (1 + 0.4 * way) * normal,
                                plenty);
            pair.move(Vec3::Zero(),
                      reach * ((1 - 0.6 * way) * normal + way * normal.cross(Vec3::UnitY())),
                      Vec3::Zero(), Vec3::Zero());
            return pair.shear();
        };
        const Vec3 expected = shear(reference_kernels());
        ASSERT_GT(expected.norm(), 0.0);
        // Round-off of the float; that of the reference's distances, 1e-17 m, over an overlap of
        // 4e-6 m; and what the short way leaves out: the gap to the first order of the turn.
        const double left_out = is_mixed() && way < 3e-4 ? way : 0;
        EXPECT_LT((shear(table()) - expected).norm(),
                  (roundoff(64) + 2e-11 + left_out) * expected.norm())
            << way;
    }
}

TEST_P(PairForce, GearsTurnWithoutForce) {
    // r_i w_i + r_j w_j = 0: the surfaces run along together.
    const Vec3 xj(0.97 * (0.0625 + 0.03125), 0, 0);
    PrescribedPair pair(table(), 0.0625, 0.03125, Vec3::Zero(), xj, 0.5);
    for (int k = 0; k < 100; ++k)
        pair.move(Vec3::Zero(), xj, Vec3(0, 0.01, 0.02), Vec3(0, -0.02, -0.04));
    EXPECT_EQ(pair.shear().norm(), 0.0);
}

GRAINFIELD_FOR_ALL_KERNELS(Objectivity);
GRAINFIELD_FOR_ALL_KERNELS(Ratcheting);
GRAINFIELD_FOR_ALL_KERNELS(PairForce);

}  // namespace
}  // namespace grainfield::kernels
