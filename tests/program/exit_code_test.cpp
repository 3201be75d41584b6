// Every kind of bad input ends with the contract's exit code and a message that names what is
// wrong, and leaves no results behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* two_spheres = "x,y,z,radius\n0,0.1,0,0.1\n1,0.1,0,0.1\n";
constexpr const char* short_scene =
    "[particles]\nfile = \"spheres.csv\"\n[time]\nstep = 1e-5\nend = 1e-4\n";
constexpr const char* plain_floor = "[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n";

void expect_failure(const Outcome& outcome, int code, const std::string& message) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("grainfield: "));
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(outcome.out, "");
}

struct SceneFault {
    const char* name;
    std::string spheres, scene;
    const char* message;
};

void PrintTo(const SceneFault& fault, std::ostream* out) {
    *out << fault.name;
}

class BadScene : public testing::TestWithParam<SceneFault> {};

TEST_P(BadScene, IsRefusedWithItsPlace) {
    const Workplace place;
    expect_failure(place.simulate(GetParam().spheres, GetParam().scene), 2, GetParam().message);
    EXPECT_FALSE(place.has("run/summary.json"));
}

const std::string scene = short_scene;
const SceneFault scene_faults[] = {
    {"UnknownKey", two_spheres, scene + "[particle]\ndensty = 2600\n", "densty"},
    {"WrongType", two_spheres, scene + "[particle]\ndensity = \"heavy\"\n", "scene.toml:7"},
    {"NegativeRadius", "x,y,z,radius\n0,0,0,-1\n", scene, "spheres.csv:2: column radius = -1"},
    {"EmptySpheres", "", scene, "spheres.csv:1"},
    {"NoSphere", "x,y,z,radius\n", scene, "at least one"},
    {"EmptyScene", two_spheres, "", "particles.file"},
    {"NotANumber", "x,y,z,radius\n0,0,0,1\n0,nan,0,1\n", scene, "spheres.csv:3: column y = nan"},
    {"OutsideTheWalls", "x,y,z,radius\n0,-5,0,0.1\n", scene + plain_floor, "sphere 0 (line 2)"},
    {"IntoAWall", "x,y,z,radius\n0,0.089,0,0.1\n", scene + plain_floor, "beyond wall 0"},
    {"Overlap", "x,y,z,radius\n0,1,0,0.1\n0.189,1,0,0.1\n", scene, "10 %"},
    {"WideVectorUnits", two_spheres, scene + "[solver]\nisa = \"avx1024\"\n", "\"avx512\""},
    {"NoWholeStep", two_spheres,
     "[particles]\nfile = \"spheres.csv\"\n[time]\nstep = 1\nend = 0.1\n", "time.end"},
    {"StressWithoutABox", two_spheres, scene + plain_floor + "stress = 1e5\n", "opposite walls"},
    {"StressOnATiltedWall", two_spheres,
     scene + "[[wall]]\npoint = [0, -9, 0]\nnormal = [1, 1, 0]\nstress = 1e5\n", "along an axis"},
};
INSTANTIATE_TEST_SUITE_P(Each, BadScene, testing::ValuesIn(scene_faults),
                         [](const auto& fault) { return fault.param.name; });

struct UsageFault {
    const char* name;
    std::vector<std::string> arguments;
    const char* message;
};

void PrintTo(const UsageFault& fault, std::ostream* out) {
    *out << fault.name;
}

class BadUsage : public testing::TestWithParam<UsageFault> {};

TEST_P(BadUsage, EndsWithTwo) {
    const Workplace place;
    std::vector<std::string> arguments = GetParam().arguments;
    for (std::string& word : arguments)
        if (word == "OUT") word = place.path("field.csv");
    expect_failure(place.run(arguments), 2, GetParam().message);
    EXPECT_FALSE(place.has("field.csv"));
}

const UsageFault usage_faults[] = {
    {"NoSubcommand", {}, "a subcommand is needed"},
    {"UnknownSubcommand", {"fields"}, "'fields' is no subcommand; allowed: convert, field"},
    {"UnknownOption", {"--verbose"}, "--verbose"},
    {"NoThreads", {"field", "--out", "OUT", "--threads", "0"}, "1 to 1024"},
    {"TooManyThreads", {"field", "--out", "OUT", "--threads", "1025"}, "1 to 1024"},
    {"ThreadsNoNumber", {"field", "--out", "OUT", "--threads", "two"}, "1 to 1024"},
    {"OutMissing", {"field"}, "--out"},
    {"WrongSuffix", {"field", "--out", "a.txt"}, ".csv or .h5"},
    {"NoRealization", {"field", "--out", "OUT", "--realizations", "0"}, "--realizations = 0"},
    {"ThetaZero",
     {"field", "--out", "OUT", "--set", "field.correlation_length=[10,0,10]"},
     "field.correlation_length"},
    {"MarginalTurned",
     {"field", "--out", "OUT", "--set", "field.friction.minimum=0.95"},
     "field.friction"},
    {"UnknownKey", {"field", "--out", "OUT", "--set", "field.sed=1"}, "field.seed"},
    {"ConvertOntoItself", {"convert", "a.csv", "./a.csv"}, "must differ"},
    {"InfoOfAStranger", {"info", "a.pdf"}, "allowed"},
};
INSTANTIATE_TEST_SUITE_P(Each, BadUsage, testing::ValuesIn(usage_faults),
                         [](const auto& fault) { return fault.param.name; });

TEST(BadFile, MissingOnesEndWithFour) {
    const Workplace place;
    expect_failure(place.run({"info", place.path("none.csv")}), 4, "none.csv");
    expect_failure(place.run({"convert", place.path("none.csv"), place.path("b.csv")}), 4, "none");
    expect_failure(place.run({"field", place.path("none.toml"), "--out", place.path("f.csv")}), 4,
                   "none.toml");
    expect_failure(place.run({"simulate", place.path("none.toml"), "--out", place.path("r")}), 4,
                   "none.toml");
    expect_failure(place.run({"report", place.path("none")}), 4, "none");
    expect_failure(
        place.run({"simulate", place.write("s.toml", short_scene), "--out", place.path("r")}), 4,
        "spheres.csv");
}

TEST(BadFile, ThoseThatCannotBeWrittenEndWithFour) {
    const Workplace place;
    const std::string spheres = place.write("a.csv", two_spheres);
    expect_failure(place.run({"field", "--out", place.path("no/such/folder/f.csv")}), 4, "f.csv");
    expect_failure(place.run({"convert", spheres, place.path("no/b.h5")}), 4, "b.h5");
    place.write("spheres.csv", two_spheres);
    expect_failure(
        place.run({"simulate", place.write("s.toml", short_scene), "--out", place.path("a.csv")}),
        4, "a.csv");
    EXPECT_EQ(place.read("a.csv"), two_spheres) << "an existing file was harmed";
    EXPECT_EQ(place.run({"simulate", place.path("s.toml"), "--out", "/proc/none"}).code, 4);
}

TEST(BadFile, CorruptOnesEndWithFour) {
    const Workplace place;
    place.write("noise.h5", "this is no HDF5 file");
    expect_failure(place.run({"info", place.path("noise.h5")}), 4, "noise.h5");
    place.write("a.csv", two_spheres);
    ASSERT_EQ(place.run({"convert", place.path("a.csv"), place.path("a.h5")}).code, 0);
    const std::string whole = place.read("a.h5");
    place.write("half.h5", whole.substr(0, whole.size() / 2));
    expect_failure(place.run({"convert", place.path("half.h5"), place.path("b.csv")}), 4,
                   "half.h5");
    EXPECT_FALSE(place.has("b.csv"));
}

TEST(Usage, HelpAndVersionEndWithZero) {
    const Workplace place;
    EXPECT_THAT(place.run({"--version"}).out, StartsWith("grainfield "));
    const Outcome help = place.run({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr("Example"));
    for (const char* command :
         {"pack", "field", "triaxial", "report", "simulate", "convert", "info"}) {
        EXPECT_THAT(help.out, HasSubstr(command));
        const Outcome one = place.run({command, "--help"});
        EXPECT_EQ(one.code, 0);
        for (const char* word : {"Example:\n  grainfield ", "--threads", "--set", "--quiet"})
            EXPECT_THAT(one.out, HasSubstr(word)) << command;
    }
}

TEST(Usage, SettingsNobodyReadsAreStillChecked) {
    const Workplace place;
    const std::string spheres = place.write("a.csv", two_spheres);
    const Outcome unused = place.run({"info", spheres, "--set", "field.seed=3"});
    EXPECT_EQ(unused.code, 0);
    EXPECT_THAT(unused.err, HasSubstr("no effect"));
    expect_failure(place.run({"info", spheres, "--set", "no.such=3"}), 2, "no");
}

}  // namespace
}  // namespace grainfield::program_tests
