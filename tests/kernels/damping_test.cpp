// Local damping: its sign at rest, in motion and where the velocity turns.

#include "kernels/damping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainfield::kernels {
namespace {

TEST(Damping, TakesAShareOfTheLoadAgainstTheMotion) {
    for (double load : {3.0, -3.0})
        for (double velocity : {10.0, -10.0})
            EXPECT_DOUBLE_EQ(damping_force(load, 0.2, velocity, 1e-3),
                             0.2 * 3.0 * (velocity > 0 ? 1.0 : -1.0));
}

TEST(Damping, BodyAtRestInItsFirstStepStartsAlongTheLoad) {
    EXPECT_DOUBLE_EQ(damping_force(5.0, 0.2, 0.0, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(damping_force(-5.0, 0.2, 0.0, 0.0), -1.0);
    EXPECT_EQ(damping_force(0.0, 0.2, 0.0, 0.0), 0.0);
}

TEST(Damping, NoLoadNoDamping) {
    for (double velocity : {-1.0, 0.0, 1.0})
        EXPECT_EQ(damping_force(0.0, 0.2, velocity, 1e-3), 0.0);
}

TEST(Damping, SignSolvesItsOwnEquation) {
    // v = v- + c (F - alpha |F| s) must have the sign s, or be zero with |s| < 1.
    const double alpha = 0.2, c = 0.01;
    for (double load : {-4.0, -1.0, 2.0, 7.0})
        for (double velocity = -0.1; velocity <= 0.1; velocity += 0.0005) {
            const double taken = damping_force(load, alpha, velocity, c);
            const double s = taken / (alpha * std::abs(load));
            const double now = velocity + c * (load - taken);
            ASSERT_LE(std::abs(s), 1.0 + 1e-15);
            if (std::abs(s) < 1.0 - 1e-12)
                ASSERT_LT(std::abs(now), 1e-15);
            else
                ASSERT_GE(now * s, -1e-15);
        }
}

TEST(Damping, SignIsContinuousAndMonotonous) {
    double last = -1.0;
    for (double v = -2.0; v <= 2.0; v += 1e-3) {
        const double s = damping_sign(v, 0.5, 1.0);
        ASSERT_GE(s, last);
        ASSERT_LE(s - last, 1e-3 / 0.5 + 1e-12);
        last = s;
    }
    EXPECT_EQ(last, 1.0);
}

TEST(Damping, NeverAddsEnergy) {
    // The force taken and the velocity at its time never have opposite signs.
    for (double load : {-4.0, 2.0})
        for (double velocity = -0.1; velocity <= 0.1; velocity += 0.0005) {
            const double taken = damping_force(load, 0.9, velocity, 0.01);
            ASSERT_GE(taken * (velocity + 0.01 * (load - taken)), -1e-15);
        }
}

}  // namespace
}  // namespace grainfield::kernels
