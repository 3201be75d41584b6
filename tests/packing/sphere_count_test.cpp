// How many spheres a grading asks for, and which ones are refused for it.
#include "packing/sphere_count.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "packing/grading.hpp"
#include "tests/packing/small_samples.hpp"

namespace grainfield::packing {
namespace {

using ::testing::HasSubstr;
using testing::kernels_here;

std::string refused(const PackingOptions& options, const Grading& grading) {
    return message_of<InputError>([&] { require_countable(options, grading); });
}

/// One straight piece from a to b: <D^3> = 2 a^2 b^2/(a + b).
double straight(const PackingOptions& options, double a, double b) {
    return (1 - options.porosity) * options.block.prod() /
           (std::numbers::pi / 6 * 2 * a * a * b * b / (a + b));
}

TEST(SphereCount, IsThatOfTheNumberDensity) {
    PackingOptions options;
    EXPECT_NEAR(spheres_a_block(options, {{1e-4, 0.1}, {0, 100}}), straight(options, 1e-4, 0.1),
                1e-9 * straight(options, 1e-4, 0.1));
    EXPECT_EQ(sphere_count_text(options, {}), "about 312 spheres in a block, 134571 in the sample");
    options.spheres = 351;
    EXPECT_EQ(sphere_count_text(options, {}), "351 spheres in a block, 151632 in the sample");
}

TEST(SphereCount, CutCurveIsTheSameCurveAboveTheCut) {
    const Grading grading{{0.01, 0.02, 0.04, 0.1}, {0, 20, 20, 100}};
    const Grading cut = without_finer(grading, 0.015);
    EXPECT_EQ(cut.sieve_diameter, (std::vector<double>{0.015, 0.02, 0.04, 0.1}));
    ASSERT_EQ(cut.passing.size(), 4U);
    EXPECT_EQ(cut.passing[0], 0);
    EXPECT_NEAR(cut.passing[1], 100 * 10.0 / 90, 1e-12);
    EXPECT_NEAR(cut.passing[2], 100 * 10.0 / 90, 1e-12);
    EXPECT_EQ(cut.passing[3], 100);
    EXPECT_NO_THROW(cut.validate());
    // On a sieve, and in a gap.
    EXPECT_EQ(without_finer(grading, 0.02).passing, (std::vector<double>{0, 0, 100}));
    EXPECT_EQ(without_finer(grading, 0.03).passing, (std::vector<double>{0, 0, 100}));
    EXPECT_EQ(without_finer(grading, 0.01).passing, grading.passing);
}

TEST(SphereCount, TooManyAreRefusedWithASieveThatWouldDo) {
    PackingOptions options;
    options.blocks = {1, 1, 1};
    for (const double finest : {1e-4, 2e-6, 1e-9}) {
        const Grading grading{{finest, 0.02, 0.2}, {0, 10, 100}};
        const std::string message = refused(options, grading);
        EXPECT_THAT(message, HasSubstr("100 % of them are between the sieves of"));
        const std::string before = "give a finest sieve of ";
        const auto at = message.find(before);
        ASSERT_NE(at, std::string::npos) << message;
        const double advised = std::stod(message.substr(at + before.size()));
        // It does, and one that is a tenth finer does not.
        EXPECT_NO_THROW(require_countable(options, without_finer(grading, advised)));
        EXPECT_NE(refused(options, without_finer(grading, 0.9 * advised)), "");
        options.max_spheres = most_spheres;
        if (straight(options, finest, 0.02) < 1e9) {
            EXPECT_NO_THROW(require_countable(options, grading));
        }
        options.max_spheres = 1000000;
    }
}

TEST(SphereCount, NoCutHelpsWhereEvenTheLargestAreTooMany) {
    PackingOptions options;
    options.block = Vec3(100, 100, 100);
    EXPECT_THAT(refused(options, {}), HasSubstr("allowed; "));
    EXPECT_THAT(refused(options, {{1e-3, 2e-3}, {0, 100}}), HasSubstr("give a smaller packing"));
}

TEST(SphereCount, NumbersThatOverflowAreRefused) {
    PackingOptions options;
    options.max_spheres = most_spheres;
    for (const double finest : {1e-12, 1e-100, 1e-160, 1e-200, 1e-300})
        EXPECT_THAT(refused(options, {{finest, 0.2}, {0, 100}}), HasSubstr("packing.max_spheres"))
            << finest;
    options.block = Vec3(1e300, 1e300, 1);
    EXPECT_THAT(refused(options, {}), HasSubstr("packing.max_spheres"));
    EXPECT_THAT(message_of<InputError>([&] {
                    draw_diameters({{1e-6, 0.2}, {0, 100}}, 0.01, 1, std::nullopt);
                }),
                HasSubstr("too many to be numbered"));
}

TEST(SphereCount, AskedForAreLimitedAsWell) {
    PackingOptions options;
    options.blocks = {1, 1, 1};
    options.max_spheres = 350;
    options.spheres = 351;
    EXPECT_THAT(refused(options, {}), HasSubstr("packing.spheres = 351: "));
    options.spheres = 350;
    EXPECT_NO_THROW(require_countable(options, {}));
}

TEST(LargestGrain, ThatDoesNotFitIsRefusedBeforeItIsPlaced) {
    // One sphere of the block's solids: sqrt[3](0.6 6/pi) = 1.046 of its side.
    PackingOptions options;
    options.spheres = 1;
    core::Monitor monitor;
    const std::string message =
        message_of<InputError>([&] { pack_block(options, {}, {}, kernels_here(), monitor); });
    EXPECT_THAT(message, HasSubstr("the largest of 1 grains, 0.2616 m (diameters are scaled by "));
    EXPECT_THAT(message, HasSubstr("does not fit"));
    // As tall as the other sides, which it fits.
    options.block = Vec3(0.3, 0.2, 0.3);
    EXPECT_THAT(
        message_of<InputError>([&] { pack_block(options, {}, {}, kernels_here(), monitor); }),
        HasSubstr("does not fit"));
}

}  // namespace
}  // namespace grainfield::packing
