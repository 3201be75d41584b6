// Ticks that the report chooses, and the room that their labels need.

#include "triaxial/report/axis_ticks.hpp"

#include <gtest/gtest.h>

namespace grainfield::triaxial::report {
namespace {

TEST(AxisTicks, StepsAreRoundAndNoMoreThanAskedFor) {
    EXPECT_DOUBLE_EQ(round_step(4, 4), 1);
    EXPECT_DOUBLE_EQ(round_step(4.1, 4), 2);
    EXPECT_DOUBLE_EQ(round_step(10, 4), 5);
    EXPECT_DOUBLE_EQ(round_step(30, 4), 10);
    EXPECT_DOUBLE_EQ(round_step(0.06, 4), 0.02);
    EXPECT_DOUBLE_EQ(round_step(3 * 0.1, 3), 0.1) << "3 x 0.1 is above 0.3";
    for (const double span : {1e-9, 3.7e-4, 0.99, 7.0, 12345.0})
        for (const int intervals : {2, 4, 8}) {
            const double step = round_step(span, intervals);
            EXPECT_LE(span / step, intervals * (1 + 1e-8)) << span;
            EXPECT_GT(span / step, 0.35 * intervals) << span;
        }
}

TEST(AxisTicks, TheWidestLabelIsThatOfATickInside) {
    EXPECT_EQ(widest_label(0, 250, 50), 3u);
    EXPECT_EQ(widest_label(-0.012, 0.06, 0.02), 4u) << "0.02: -0.02 is outside";
    EXPECT_EQ(widest_label(-0.02, 0.06, 0.02), 5u);
    EXPECT_EQ(widest_label(0, 20000, 5000), 5u);
    EXPECT_EQ(widest_label(0.1, 0.2, 1), 0u) << "no tick";
}

}  // namespace
}  // namespace grainfield::triaxial::report
