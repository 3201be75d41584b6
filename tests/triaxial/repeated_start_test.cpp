// Starts of repeated tests: next to the sample, each another one, the same whenever it is asked
// for.

#include "triaxial/realization/repeated_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grainfield::triaxial {
namespace {

Sample a_thousand_spheres() {
    Sample sample;
    sample.spheres.resize(1000);
    for (std::size_t i = 0; i < 1000; ++i)
        sample.spheres.position.set(
            i, Vec3(0.1 * double(i % 10), 0.1 * double(i / 10 % 10), 0.1 * double(i / 100)));
    return sample;
}

TEST(RepeatedStart, LiesWithinHalfTheSpreadOfTheSample) {
    const Sample sample = a_thousand_spheres();
    const Sample start = start_of_repeat(sample, 1, 3);
    double least = 0, most = 0, sum = 0;
    for (std::size_t i = 0; i < 1000; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double shift = start.spheres.position[i][axis] - sample.spheres.position[i][axis];
            least = std::min(least, shift);
            most = std::max(most, shift);
            sum += shift;
        }
    // A coordinate below 1 m is rounded by 5.6e-17 m at most.
    EXPECT_GE(least, -0.5e-12 - 1e-16);
    EXPECT_LE(most, 0.5e-12 + 1e-16);
    EXPECT_LT(least, -0.49e-12);
    EXPECT_GT(most, 0.49e-12);
    // The mean of 3000 uniform numbers has a deviation of 1/sqrt(12 * 3000) of the spread.
    EXPECT_LT(std::abs(sum / 3000), 4 * 1e-12 / std::sqrt(36000.0));
}

TEST(RepeatedStart, IsAFunctionOfSeedAndRepeat) {
    const Sample sample = a_thousand_spheres();
    const auto positions = [&](std::uint64_t seed, std::int32_t repeat) {
        return start_of_repeat(sample, seed, repeat).spheres.position;
    };
    EXPECT_EQ(positions(1, 0), sample.spheres.position);
    EXPECT_EQ(positions(1, 2), positions(1, 2));
    EXPECT_NE(positions(1, 2), positions(1, 1));
    EXPECT_NE(positions(1, 2), positions(2, 2));
}

}  // namespace
}  // namespace grainfield::triaxial
