// Logs and results that go nowhere: a log that cannot be written changes nothing, results that
// cannot be written are told by the exit code, and files are what they are.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;

constexpr const char* one_sphere = "x,y,z,radius\n0,0.1,0,0.1\n";
const std::string some_steps = scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n";

TEST(Streams, ALogThatCannotBeWrittenChangesNothing) {
    const Workplace place;
    const Outcome whole = place.simulate(one_sphere, some_steps);
    ASSERT_EQ(whole.code, 0) << whole.err;
    const std::string hash = place.json("run/summary.json").at("state_hash");
    for (const char* log :
         {">/dev/null 2>/dev/full", ">/dev/null 2>&-", "2>&1 >&- | exit", "0<&- 1>&- 2>&-"}) {
        SCOPED_TRACE(log);
        const std::vector<std::string> words{"simulate", place.path("scene.toml"), "--out",
                                             place.path("again")};
        EXPECT_EQ(place.run_in_shell(words, log), 0);
        EXPECT_EQ(place.json("again/summary.json").at("state_hash"), hash);
        std::filesystem::remove_all(place.path("again"));
    }
    // The message of an error is lost, its code is not.
    EXPECT_EQ(place.run_in_shell({"info", place.path("none.csv")}, "2>/dev/full"), 4);
    EXPECT_EQ(place.run_in_shell({"infos"}, "2>&-"), 2);
    EXPECT_EQ(place.run_in_shell({}, "2>/dev/full"), 2);
}

TEST(Streams, ResultsThatCannotBeWrittenEndWithFour) {
    const Workplace place;
    ASSERT_EQ(place.simulate(one_sphere, some_steps).code, 0);
    for (const char* out : {">/dev/full", "| exit"}) {
        SCOPED_TRACE(out);
        const std::string log = place.path("log.txt");
        const std::vector<std::string> words{"simulate", place.path("scene.toml"), "--out",
                                             place.path("again")};
        EXPECT_EQ(place.run_in_shell(words, "2>'" + log + "' " + out), 4);
        EXPECT_THAT(place.read("log.txt"), HasSubstr("standard output: cannot be written"));
        EXPECT_TRUE(place.has("again/summary.json")) << "the results in files are there";
        std::filesystem::remove_all(place.path("again"));
    }
    EXPECT_EQ(place.run_in_shell({"info", place.path("scene.toml")}, ">/dev/full"), 4);
}

TEST(Streams, AFileLargerThanTheLimitIsAnErrorOfWriting) {
    const Workplace place;
    place.write("spheres.csv", one_sphere);
    place.write("scene.toml", some_steps + "[output]\ninterval = 1e-5\n");
    const std::string log = place.path("log.txt");
    const std::vector<std::string> words{"simulate", place.path("scene.toml"), "--out",
                                         place.path("run")};
    EXPECT_EQ(place.run_in_shell(words, ">/dev/null 2>'" + log + "'", "ulimit -f 1"), 4);
    EXPECT_THAT(place.read("log.txt"), HasSubstr("cannot be written"));
    EXPECT_FALSE(place.has("run/trajectory.csv"));
}

}  // namespace
}  // namespace grainfield::program_tests
