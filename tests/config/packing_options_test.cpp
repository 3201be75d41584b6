// The checks of the packing's own options, without a file.
#include "packing/packing_options.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/config/config_fixture.hpp"

namespace grainfield::packing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const double nan_value = std::nan("");
const double infinity = std::numeric_limits<double>::infinity();

TEST(PackingOptions, DefaultsAreFine) {
    EXPECT_NO_THROW(PackingOptions{}.validate());
    EXPECT_NO_THROW(Grading{}.validate());
}

template <class Change>
std::string refused(const Change& change) {
    PackingOptions options;
    change(options);
    return message_of<InputError>([&] { options.validate(); });
}

TEST(PackingOptions, RefusesWhatIsOutOfRange) {
    for (const double porosity : {0.2, 0.9, -1.0, nan_value, infinity})
        EXPECT_THAT(refused([&](auto& o) { o.porosity = porosity; }),
                    StartsWith("packing.porosity = "));
    for (const double gravity : {0.0, -9.81, nan_value, infinity})
        EXPECT_THAT(refused([&](auto& o) { o.gravity = gravity; }),
                    StartsWith("packing.gravity = "));
    for (const double side : {0.0, -0.25, nan_value, infinity})
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_THAT(refused([&](auto& o) { o.block[axis] = side; }),
                        StartsWith("packing.block = ["));
    for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_THAT(refused([&](auto& o) { o.blocks[axis] = 0; }), StartsWith("packing.blocks"));
    EXPECT_EQ(
        refused([](auto& o) {
            o.blocks = {2147483647, 2147483647, 2147483647};
        }),
        "packing.blocks = [2147483647, 2147483647, 2147483647]: fewer than 2^31 blocks in all "
        "are expected");
    EXPECT_THAT(refused([](auto& o) { o.spheres = 0; }),
                "packing.spheres = 0: a whole number >= 1 is expected");
    for (const std::int32_t most : {0, -1, 500'000'001})
        EXPECT_THAT(refused([&](auto& o) { o.max_spheres = most; }),
                    StartsWith("packing.max_spheres = "));
    for (const double stress : {0.0, -1.0, nan_value, infinity})
        EXPECT_THAT(refused([&](auto& o) { o.isotropic_stress = stress; }),
                    StartsWith("packing.isotropic_stress = "));
}

std::string refused(const Grading& grading) {
    return message_of<InputError>([&] { grading.validate(); });
}

TEST(Grading, RefusesSievesOutOfOrder) {
    EXPECT_THAT(refused({{0.1, 0.1}, {0, 100}}), HasSubstr("overlapping sieve sizes"));
    EXPECT_THAT(refused({{0.2, 0.1}, {0, 100}}), HasSubstr("overlapping sieve sizes"));
    EXPECT_THAT(refused({{0.0, 0.1}, {0, 100}}), StartsWith("grading.sieve_diameter = [0, 0.1]"));
    EXPECT_THAT(refused({{nan_value, 0.1}, {0, 100}}), StartsWith("grading.sieve_diameter"));
    EXPECT_THAT(refused({{0.1, nan_value}, {0, 100}}), StartsWith("grading.sieve_diameter"));
    EXPECT_THAT(refused({{0.1, nan_value, 0.3}, {0, 0, 100}}), StartsWith("grading.sieve"));
    EXPECT_THAT(refused({{0.1, infinity}, {0, 100}}), StartsWith("grading.sieve_diameter"));
    EXPECT_THAT(refused({{0.1}, {100}}), HasSubstr("at least 2"));
    EXPECT_THAT(refused({{}, {}}), HasSubstr("at least 2"));
}

TEST(Grading, RefusesCurvesThatAreNone) {
    EXPECT_THAT(refused({{0.1, 0.2}, {0, 50, 100}}), HasSubstr("2 numbers, one a sieve"));
    EXPECT_THAT(refused({{0.1, 0.2}, {}}), HasSubstr("2 numbers, one a sieve"));
    EXPECT_THAT(refused({{0.1, 0.2}, {1, 100}}), HasSubstr("start at 0"));
    EXPECT_THAT(refused({{0.1, 0.2}, {0, 99}}), HasSubstr("end at 100"));
    EXPECT_THAT(refused({{0.1, 0.2, 0.3, 0.4}, {0, 60, 50, 100}}), HasSubstr("never fall"));
    EXPECT_THAT(refused({{0.1, 0.2, 0.3}, {0, nan_value, 100}}), StartsWith("grading.passing"));
    EXPECT_THAT(refused({{0.1, 0.2}, {nan_value, 100}}), StartsWith("grading.passing"));
}

TEST(Grading, TwoSievesAreEnough) {
    EXPECT_NO_THROW((Grading{{0.1, 0.2}, {0, 100}}.validate()));
}

}  // namespace
}  // namespace grainfield::packing
