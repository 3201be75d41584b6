// Packings that cannot be: few or large grains that are shaken for ever, and gradings with more
// spheres than anybody means. Soft grains take long steps.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

Outcome pack(const Workplace& place, const std::vector<std::string>& settings) {
    std::vector<std::string> arguments{"pack", "--threads", "1", "--out", place.path("P.h5")};
    for (const std::string& setting : settings)
        arguments.insert(arguments.end(), {"--set", setting});
    return place.run(arguments);
}

const std::vector<std::string> soft_block{"packing.blocks=[1,1,1]",
                                          "particle.normal_stiffness=1e7"};

Outcome pack_soft(const Workplace& place, std::vector<std::string> settings) {
    settings.insert(settings.end(), soft_block.begin(), soft_block.end());
    return pack(place, settings);
}

// They were shaken for millions of steps: a lid that goes up and down was taken for progress.
TEST(ImpossiblePacking, EndsAndNamesThePorosityThatWasReached) {
    const Workplace place;
    for (const std::vector<std::string>& settings :
         {std::vector<std::string>{"packing.spheres=10"},
          {"packing.spheres=3", "packing.porosity=0.5"},
          {"grading.sieve_diameter=[0.03,0.04,0.1,0.12]", "grading.passing=[0,20,20,100]"}}) {
        const Outcome outcome = pack_soft(place, settings);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "packing.porosity = ")) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "which can have 0.") || has(outcome.err, "ended at 0.") ||
                    has(outcome.err, "without stress"))
            << outcome.err;
        EXPECT_TRUE(has(outcome.err, "another packing.seed, a larger packing.block"))
            << outcome.err;
        EXPECT_FALSE(place.has("P.h5"));
    }
}

TEST(ImpossiblePacking, LooserThanGravityLeavesItIsNamed) {
    const Workplace place;
    const Outcome outcome = pack_soft(place, {"packing.porosity=0.75", "packing.spheres=60"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(has(outcome.err, "(fallen and levelled)")) << outcome.err;
}

TEST(FewGrains, ArePackedWhereTheyCanBe) {
    const Workplace place;
    for (const std::vector<std::string>& settings :
         {std::vector<std::string>{"packing.spheres=1", "packing.porosity=0.48"},
          {"packing.spheres=8", "packing.compaction_friction=0.3"}}) {
        const Outcome outcome = pack_soft(place, settings);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "of the block's smallest side")) << outcome.err;
    }
    EXPECT_EQ(place.json("P.json").at("block_spheres"), 8);
    const double share = place.json("P.json").at("largest_grain_over_block");
    EXPECT_GT(share, 0.5);
    EXPECT_LE(share, 1);
}

TEST(WideGrading, IsRefusedBeforeAnythingIsPlaced) {
    const Workplace place;
    for (const std::string& finest :
         {std::string("[2e-6,0.02,0.2]"), std::string("[1e-4,0.02,0.2]"),
          std::string("[1e-30,0.02,0.2]"), std::string("[1e-200,0.02,0.2]")}) {
        const Outcome outcome =
            pack(place, {"grading.sieve_diameter=" + finest, "grading.passing=[0,10,100]",
                         "packing.blocks=[1,1,1]", "packing.porosity=0.5"});
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "packing.max_spheres = 1000000 are allowed")) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "give a finest sieve of 0.0002")) << outcome.err;
        EXPECT_FALSE(has(outcome.err, "spheres in a block, ")) << outcome.err;
    }
    const Outcome named = pack(place, {"packing.max_spheres=300"});
    EXPECT_EQ(named.code, 2);
    EXPECT_TRUE(has(named.err, "about 312 spheres are expected in a block")) << named.err;
}

TEST(SphereCount, IsSaidBeforeThePlacing) {
    const Workplace place;
    const Outcome outcome = pack_soft(place, {"packing.spheres=1"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(has(outcome.err, "1 spheres in a block, 1 in the sample")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "the largest of 1 grains, 0.2616 m")) << outcome.err;
    std::vector<std::string> test{"triaxial", "--out", place.path("run"), "--set",
                                  "packing.spheres=1"};
    const Outcome triaxial = place.run(test);
    EXPECT_EQ(triaxial.code, 2);
    EXPECT_TRUE(has(triaxial.err, "1 spheres in a block, 432 in the sample")) << triaxial.err;
}

}  // namespace
}  // namespace grainfield::case_tests
