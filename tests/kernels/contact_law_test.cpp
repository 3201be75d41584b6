// The algebra of one contact: stiffness, finite rotation, swing, Coulomb limit.

#include "kernels/contact_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainfield::kernels {
namespace {

constexpr double eps = 0x1p-52;

TEST(ContactLaw, StiffnessIsTheSeriesOfTwoHalves) {
    // Eq. (4) of Tran et al.: equal bodies give r k/2, a rigid partner r k; either order is the
    // same.
    EXPECT_DOUBLE_EQ(contact_stiffness(0.05, 9e8, 9e8), 0.05 * 4.5e8);
    EXPECT_NEAR(contact_stiffness(0.05, 9e8, 1e24), 0.05 * 9e8, 0.05 * 9e8 * 1e-15);
    EXPECT_DOUBLE_EQ(contact_stiffness(0.07, 2e8, 6e8), contact_stiffness(0.07, 6e8, 2e8));
    EXPECT_DOUBLE_EQ(contact_stiffness(0.07, 2e8, 6e8), 0.07 * 1.5e8);
}

TEST(ContactLaw, RotationAgreesWithAngleAxisAtAnyAngle) {
    const Vec3 v(0.3, -1.1, 0.8);
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(1, 2, -3), Vec3(-0.1, 0.2, 5)}) {
        const Vec3 axis = direction.normalized();
        for (double angle : {0.0, 1e-12, 1e-6, 1e-3, 0.00999, 0.01, 0.01001, 0.1, 1.0, 2.0, -1.5}) {
            const Vec3 expected = Eigen::AngleAxisd(angle, axis) * v;
            const Vec3 got = Rotation(angle * axis) * v;
            // A dozen products, all of the size of v or smaller.
            EXPECT_LT((got - expected).norm(), 8 * eps * v.norm()) << "angle " << angle;
        }
    }
}

TEST(ContactLaw, RotationKeepsLength) {
    Vec3 v(0.3, -1.1, 0.8);
    const double length = v.norm();
    const Rotation rotation(Vec3(0.02, -0.05, 0.03));
    for (int k = 0; k < 100000; ++k) v = rotation * v;
    // One rounding of a few eps a step; a systematic one would reach 1e5 eps = 2e-11.
    EXPECT_LT(std::abs(v.norm() / length - 1.0), 1e5 * eps);
}

TEST(ContactLaw, SwingIsTheSmallestRotationBetweenNormals) {
    for (double angle : {1e-9, 1e-3, 0.5, 2.0}) {
        const Vec3 from = Vec3(1, 2, -1).normalized();
        const Vec3 across = from.cross(Vec3(0, 0, 1)).normalized();
        const Eigen::AngleAxisd turn(angle, across);
        const Vec3 to = turn * from;
        const Vec3 tangent = 3.0 * across + 2.0 * from.cross(across);
        EXPECT_LT((swing(tangent, from, to) - turn * tangent).norm(), 16 * eps * tangent.norm());
        EXPECT_LT(std::abs(swing(tangent, from, to).dot(to)), 2 * eps * tangent.norm());
    }
}

TEST(ContactLaw, CoulombLimitCutsLengthAndKeepsDirection) {
    const Vec3 shear(3, 0, -4);
    EXPECT_EQ(coulomb_limited(shear, 5.0), shear);
    EXPECT_EQ(coulomb_limited(shear, 100.0), shear);
    EXPECT_LT((coulomb_limited(shear, 2.5) - 0.5 * shear).norm(), 2 * eps * 5);
    EXPECT_EQ(coulomb_limited(shear, 0.0), Vec3(0, 0, 0));
    EXPECT_EQ(coulomb_limited(Vec3::Zero(), 0.0), Vec3(0, 0, 0));
}

TEST(ContactLaw, PlaneMotionIsTheSlipOfTheContactPoint) {
    const Vec3 outward = Vec3(1, 2, 2) / 3.0;
    const Vec3 spin(3, -1, 2), velocity(0.1, 0.5, -0.2);
    const double radius = 0.05, step = 1e-3;
    const TangentialMotion motion =
        plane_motion(outward, radius, velocity, spin, Vec3::Zero(), step);
    const Vec3 slip = velocity - spin.cross(radius * outward);
    const Vec3 expected = step * (slip - slip.dot(outward) * outward);
    EXPECT_LT((motion.displacement - expected).norm(), 8 * eps * expected.norm());
    // Rolling: the centre moves as the spin demands, and nothing slips.
    const Vec3 rolling = spin.cross(radius * outward);
    EXPECT_LT(plane_motion(outward, radius, rolling, spin, Vec3::Zero(), step).displacement.norm(),
              8 * eps * step * rolling.norm());
}

TEST(ContactLaw, ShearOnAPlaneTurnsByHalfTheSpinAboutTheNormal) {
    const Vec3 outward = Vec3(1, 2, 2) / 3.0, shear = 3.0 * outward.unitOrthogonal();
    const Vec3 turned =
        plane_motion(outward, 0.05, Vec3::Zero(), 4.0 * outward, shear, 0.05).turned_shear;
    const Vec3 expected = Eigen::AngleAxisd(0.5 * 4.0 * 0.05, outward) * shear;
    EXPECT_LT((turned - expected).norm(), 8 * eps * shear.norm());
}

TEST(ContactLaw, SphereMotionIsTheSlipOfTheContactPointToSecondOrder) {
    const Vec3 normal0 = Vec3(2, -1, 2) / 3.0;
    const Vec3 spin_i(3, -1, 2), spin_j(-0.5, 2, 1);
    const double ri = 0.05, rj = 0.02;
    const Vec3 relative(0.03, 0.4, -0.1);  // velocity of j relative to i, centres ri + rj apart
    double last = 0;
    for (double step : {1e-3, 5e-4}) {
        const Vec3 branch = (ri + rj) * normal0 + step * relative;
        const TangentialMotion motion =
            sphere_motion(normal0, branch.normalized(), ri, rj, spin_i, spin_j, Vec3::Zero(), step);
        Vec3 slip = relative - (ri * spin_i + rj * spin_j).cross(normal0);
        slip -= slip.dot(normal0) * normal0;
        const double error = (motion.displacement / step - slip).norm() / slip.norm();
        if (last > 0) {
            EXPECT_NEAR(last / error, 2.0, 0.1);  // u = h slip + O(h^2)
        }
        last = error;
    }
    EXPECT_LT(last, 0.01);
}

TEST(ContactLaw, ShearTurnsAboutTheNormalWithTheMeanSpin) {
    const Vec3 normal = Vec3::UnitX();
    const Vec3 shear(0, 2, 0);
    const TangentialMotion motion =
        sphere_motion(normal, normal, 0.1, 0.03, 3.0 * normal, 1.0 * normal, shear, 0.05);
    const Vec3 expected = Eigen::AngleAxisd(0.05 * 2.0, normal) * shear;
    EXPECT_LT((motion.turned_shear - expected).norm(), 8 * eps * 2);
    EXPECT_LT(motion.displacement.norm(), 8 * eps * 0.13);
}

}  // namespace
}  // namespace grainfield::kernels
