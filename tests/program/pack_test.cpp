// `pack` as a program: what it says and writes, and that it goes on where it was stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;

/// `pack` of the small packing into a file.
std::vector<std::string> packing(const std::string& out,
                                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"pack", "--out", out};
    words.insert(words.end(), small_packing.begin(), small_packing.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(PackCommand, SaysWhatItPackedAndGoesOnWhereItWasStopped) {
    const Workplace place;
    const Outcome whole = place.run(packing(place.path("whole.h5")));
    ASSERT_EQ(whole.code, 0) << whole.err;
    const std::string hash = place.json("whole.json").at("state_hash");
    for (const std::string& text :
         {std::string("120 (60 in a block)"), std::string("50.00 %"), std::string("porosity"),
          std::string("R2 = "), hash, place.path("whole.h5")})
        EXPECT_THAT(whole.out, HasSubstr(text));
    EXPECT_FALSE(place.has("whole.checkpoint.bin"));

    const Outcome stopped =
        place.run(packing(place.path("P.h5"), {"--checkpoint-every", "1e-3"}),
                  SignalAfter{SIGINT, [&] { return place.has("P.checkpoint.bin"); }});
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("the same command with --resume goes on from it"));
    EXPECT_FALSE(place.has("P.h5"));
    const Outcome other =
        place.run(packing(place.path("P.h5"), {"--resume", "--set", "packing.seed=5"}));
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.err, HasSubstr("is of another config: here [packing] seed = 5"));
    const Outcome resumed = place.run({"pack", "--out", place.path("P.h5"), "--resume"});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(place.json("P.json").at("state_hash"), hash);
    EXPECT_FALSE(place.has("P.checkpoint.bin"));
}

}  // namespace
}  // namespace grainfield::program_tests
