// `field` with measured data and with --verify, through the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <string>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* config =
    "[packing]\nblocks = [3, 4, 2]\n[field]\nvariable = \"both\"\ncross_correlation = 0.6\n"
    "correlation_length = [5, 0.5, 5]\ndata = \"cpt.csv\"\n"
    "friction.marginal = \"beta\"\nfriction.mean = 0.5\n"
    "stiffness.marginal = \"weibull\"\nstiffness.mean_gradient = -1e8\n";
constexpr const char* data =
    "x,y,z,property,value,error\n"
    "0.3,0.1,0.1,friction_angle,0.55,0\n0.3,0.6,0.1,normal_stiffness,4e8,0\n";

TEST(FieldData, AreHonouredAndFoundBesideTheConfig) {
    const Workplace place;
    const std::string file = place.write("c.toml", config);
    place.write("cpt.csv", data);
    const Outcome run =
        place.run({"field", file, "--realizations", "2", "--out", place.path("f.csv")});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("cpt.csv: 2 cells have values"));
    const Table t = read_table(place.read("f.csv"));
    ASSERT_EQ(t.rows.size(), 48u);
    for (const std::size_t first : {0u, 24u}) {
        EXPECT_NEAR(t.at(first + 1, "friction_angle"), 0.55, 1e-12);
        EXPECT_NEAR(t.at(first + 1 + 3 * 2, "normal_stiffness"), 4e8, 1e-3);
    }
    EXPECT_NE(t.at(2, "friction_angle"), t.at(26, "friction_angle"));
}

TEST(FieldData, FaultsEndWithTwoAndUnreadableFilesWithFour) {
    const Workplace place;
    const std::string file = place.write("c.toml", config);
    const auto outcome = [&] { return place.run({"field", file, "--out", place.path("f.csv")}); };
    Outcome run = outcome();
    EXPECT_EQ(run.code, 4);
    EXPECT_THAT(run.err, HasSubstr("cpt.csv: cannot be read"));
    place.write("cpt.csv", std::string(data) + "0.3,0.1,0.6,friction_angle,0.5,0\n");
    run = outcome();
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err,
                HasSubstr("cpt.csv:4: z = 0.6: outside the sample, which lies in [0, 0.5] m"));
    place.write("cpt.csv", std::string(data) + "0.3,0.1,0.2,friction_angle,0.5,0\n");
    run = outcome();
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err, HasSubstr("exact, and so is the value 0.55 of line 2"));
    EXPECT_FALSE(place.has("f.csv"));
    // A campaign and a test say so before they pack anything.
    for (const char* command : {"triaxial", "montecarlo"}) {
        run = place.run({command, file, "--out", place.path("out")});
        EXPECT_EQ(run.code, 2) << command;
        EXPECT_THAT(run.err, HasSubstr("cpt.csv:4: value = 0.5: exact")) << command;
    }
}

TEST(FieldVerify, PrintsVerdictsAndWritesThePage) {
    const Workplace place;
    const std::string file = place.write("c.toml", config);
    place.write("cpt.csv", data);
    const Outcome run =
        place.run({"field", file, "--verify", "--realizations", "200", "--out", place.path("v")});
    ASSERT_EQ(run.code, 0) << run.err;
    for (const char* check :
         {"correlation, friction angle             inside", "variance, normal stiffness",
          "histogram, friction angle", "mean, normal stiffness", "cross-correlation",
          "conditional mean, friction angle", "conditional variance, normal stiffness",
          "every check is inside its band"})
        EXPECT_THAT(run.out, HasSubstr(check));
    const std::string page = place.read("v/verification.html");
    EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(page, HasSubstr("</svg>"));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, Not(HasSubstr("OUTSIDE")));
    EXPECT_THAT(place.read("v/correlation.csv"),
                StartsWith("field,axis,lag_cells,lag_m,estimate,exact,low_99,high_99\n"
                           "friction_angle,x,0,0,"));
    EXPECT_THAT(place.read("v/histogram.csv"), HasSubstr("\nnormal_stiffness,-inf,"));
    EXPECT_THAT(place.read("v/variance.csv"), HasSubstr("\nfriction_angle,1,0,0,"));
}

// Beside a file of fields, and with a generator that is far off: the printed verdict says so.
TEST(FieldVerify, SaysWhatIsOutsideItsBand) {
    const Workplace place;
    const Outcome run = place.run({"field", "--verify", "--set", "field.variable=friction", "--set",
                                   "field.method=las-classic", "--set", "field.stage0_cells=54",
                                   "--set", "field.correlation_length=[1, 0.1, 1]",
                                   "--realizations", "300", "--out", place.path("f.csv")});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("correlation, friction angle             OUTSIDE"));
    EXPECT_THAT(run.out,
                HasSubstr("3.96e-01 of gamma at most, by algebra: an approximating method"));
    EXPECT_THAT(run.out, HasSubstr("checks are OUTSIDE their band"));
    EXPECT_TRUE(place.has("f.csv"));
    EXPECT_THAT(place.read("f-verify/verification.html"), HasSubstr("<b>OUTSIDE</b>"));
}

TEST(FieldVerify, NeedsRealizationsEnough) {
    const Workplace place;
    const Outcome run =
        place.run({"field", "--verify", "--realizations", "99", "--out", place.path("v")});
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err, HasSubstr("--realizations = 99: a whole number in [100, 1000000000] is "
                                   "expected with --verify"));
    EXPECT_FALSE(place.has("v"));
}

TEST(Field, RefusesNumbersOfRealizationsThatAreNone) {
    const Workplace place;
    for (const char* count : {"0", "-3", "1e3", "two", "", "1000000001", "99999999999999999999"}) {
        const Outcome run =
            place.run({"field", "--realizations", count, "--out", place.path("f.csv")});
        EXPECT_EQ(run.code, 2) << count;
        EXPECT_THAT(run.err, HasSubstr(std::string("--realizations = ") + count +
                                       ": a whole number in [1, 1000000000] is expected"));
    }
    EXPECT_FALSE(place.has("f.csv"));
}

TEST(Field, RefusesAFileOfMoreFieldsThanTheMemoryHolds) {
    const Workplace place;
    const Outcome run = place.run(
        {"field", "--realizations", "1000000000", "--out", place.path("f.h5"), "--quiet"});
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err, HasSubstr("1000000000 realizations of 6 x 12 x 6 cells in one .h5 file"));
    EXPECT_THAT(run.err, HasSubstr("lower --realizations to at most "));
}

// What was there stays, and nothing else is left beside it.
TEST(Field, LeavesNothingBehindWhenInterrupted) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Workplace place;
        place.write("f.csv", "old");
        const std::filesystem::path folder =
            std::filesystem::path(place.path("f.csv")).parent_path();
        const auto files = [&] {
            std::size_t count = 0;
            for (const auto& entry : std::filesystem::directory_iterator(folder))
                count += entry.path().extension() == ".tmp" || entry.path().extension() == ".csv";
            return count;
        };
        const Outcome run = place.run(
            {"field", "--realizations", "100000000", "--out", place.path("f.csv"), "--quiet"},
            SignalAfter{signal, [&] { return files() == 2; }});
        EXPECT_EQ(run.code, 130);
        EXPECT_THAT(run.err, HasSubstr("interrupted: no fields were written"));
        EXPECT_EQ(files(), 1u);
        EXPECT_EQ(place.read("f.csv"), "old");
    }
}

// Two exact values that no field of this correlation length holds, and marginals that data lift
// out of what the property can be: the file and line, or the file and the key.
TEST(Field, RefusesDataThatCannotBeHonoured) {
    const Workplace place;
    place.write("at-odds.csv", "x,y,z,value,error\n0.1,0.1,0.1,0.35,0\n0.1,0.3,0.1,0.85,0\n");
    place.write("high.csv", "x,y,z,value,error\n0.1,0.1,0.1,1.5,0\n");
    const auto refusal = [&](const std::string& keys) {
        const Outcome run =
            place.run({"field", place.write("c.toml", "[field]\nvariable = \"friction\"\n" + keys),
                       "--out", place.path("f.csv")});
        EXPECT_EQ(run.code, 2) << keys;
        return run.err;
    };
    EXPECT_THAT(refusal("correlation_length = [1e13, 1e13, 1e13]\ndata = \"at-odds.csv\"\n"),
                HasSubstr("at-odds.csv:"));
    EXPECT_THAT(refusal("data = \"high.csv\"\ndata_deviations = 20\n[field.friction]\n"
                        "marginal = \"normal\"\n"),
                testing::AllOf(HasSubstr("high.csv: with these values field.friction.marginal"),
                               HasSubstr("allowed is in [0, pi/2)")));
}

}  // namespace
}  // namespace grainfield::program_tests
