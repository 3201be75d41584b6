// `field`, `convert` and `info` through the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::size_t cells = 6 * 12 * 6;
constexpr const char* spheres =
    "x,y,z,radius,normal_stiffness,friction_angle,vx,vy,vz,wx,wy,wz,block_i,block_j,block_k\n"
    "0.1,0.2,0.30000000000000004,0.1,900000000,0.6,1,2,3,4,5,6,0,0,0\n"
    "1.1,0.2,0.3,0.05,800000000,0.5,0,0,0,0,0,0,1,0,0\n";

TEST(Field, WritesTheContractsTable) {
    const Workplace place;
    const Outcome run = place.run({"field", "--set", "field.variable=friction", "--realizations",
                                   "2", "--out", place.path("f.csv")});
    ASSERT_EQ(run.code, 0) << run.err;
    const Table t = read_table(place.read("f.csv"));
    EXPECT_EQ(t.header, "realization,i,j,k,G,friction_angle,normal_stiffness");
    ASSERT_EQ(t.rows.size(), 2 * cells);
    for (std::size_t r = 0; r < t.rows.size(); ++r) {
        EXPECT_EQ(t.at(r, "realization"), r < cells ? 0 : 1);
        EXPECT_GT(t.at(r, "friction_angle"), 0.3);
        EXPECT_LT(t.at(r, "friction_angle"), 0.9);
        EXPECT_EQ(t.at(r, "normal_stiffness"), 9e8) << "not random";
    }
    for (const char* name : {"gamma", "covariance error", "6 x 12 x 6", "friction"})
        EXPECT_THAT(run.out, HasSubstr(name));
}

TEST(Field, DrawsGEvenWhereNothingIsRandom) {
    const Workplace place;
    ASSERT_EQ(place.run({"field", "--out", place.path("f.csv")}).code, 0);
    const Table t = read_table(place.read("f.csv"));
    ASSERT_EQ(t.rows.size(), cells);
    EXPECT_NE(t.at(0, "G"), t.at(cells - 1, "G"));
    EXPECT_EQ(t.at(0, "friction_angle"), 0.6);
}

TEST(Field, RealizationsDoNotDependOnTheirNumber) {
    const Workplace place;
    const auto draw = [&](const char* count, const char* name, const char* threads) {
        const Outcome run =
            place.run({"field", "--set", "field.variable=stiffness", "--set", "field.seed=7",
                       "--realizations", count, "--threads", threads, "--out", place.path(name)});
        EXPECT_EQ(run.code, 0) << run.err;
        return place.read(name);
    };
    const std::string one = draw("1", "1.csv", "1");
    const std::string five = draw("5", "5.csv", "3");
    EXPECT_THAT(five, StartsWith(one));
    EXPECT_EQ(draw("5", "again.csv", "2"), five);
}

TEST(Field, ReadsAConfigAndWritesHdf5) {
    const Workplace place;
    const std::string config = place.write("c.toml", "[packing]\nblocks = [2, 3, 2]\n");
    ASSERT_EQ(place.run({"field", config, "--out", place.path("f.h5")}).code, 0);
    const Outcome info = place.run({"info", place.path("f.h5")});
    EXPECT_EQ(info.code, 0);
    EXPECT_THAT(info.out, HasSubstr("/G: 1 x 2 x 3 x 2"));
}

TEST(Convert, RoundTripsThroughHdf5BitForBit) {
    const Workplace place;
    place.write("a.csv", spheres);
    const Outcome there = place.run({"convert", place.path("a.csv"), place.path("b.h5")});
    ASSERT_EQ(there.code, 0) << there.err;
    EXPECT_THAT(there.out, HasSubstr("2 spheres"));
    EXPECT_THAT(there.out, Not(HasSubstr("not written")));
    ASSERT_EQ(place.run({"convert", place.path("b.h5"), place.path("c.csv")}).code, 0);
    const Table a = read_table(place.read("a.csv"));
    const Table c = read_table(place.read("c.csv"));
    EXPECT_EQ(c.header, a.header);
    EXPECT_EQ(c.rows, a.rows);
}

TEST(Convert, SaysWhatTheTargetCannotHold) {
    const Workplace place;
    place.write("a.csv", spheres);
    const Outcome lammps = place.run({"convert", place.path("a.csv"), place.path("b.data")});
    ASSERT_EQ(lammps.code, 0) << lammps.err;
    for (const char* lost : {"normal stiffnesses", "friction angles", "blocks", "2600 kg/m3"})
        EXPECT_THAT(lammps.out, HasSubstr(lost));
    EXPECT_THAT(lammps.out, Not(HasSubstr("velocities")));
    const Outcome yade = place.run({"convert", place.path("b.data"), place.path("c.txt")});
    ASSERT_EQ(yade.code, 0) << yade.err;
    for (const char* lost : {"the box", "masses", "velocities and spins"})
        EXPECT_THAT(yade.out, HasSubstr(lost));
    EXPECT_EQ(place.read("c.txt"),
              "#format x_y_z_r\n0.1 0.2 0.30000000000000004 0.1\n1.1 0.2 0.3 0.05\n");
}

// Walls start at the spheres, whatever lid a file of another program has; masses are the file's.
TEST(GivenPacking, IsTakenAsItIs) {
    const Workplace place;
    std::vector<std::string> pack{"pack", "--out", place.path("P.h5")};
    pack.insert(pack.end(), small_packing.begin(), small_packing.end());
    ASSERT_EQ(place.run(pack).code, 0);
    const auto triaxial = [&](const std::string& packing, const std::vector<std::string>& more) {
        std::vector<std::string> words{"triaxial",
                                       "--packing",
                                       place.path(packing),
                                       "--threads",
                                       "1",
                                       "--set",
                                       "triaxial.max_axial_strain=0.001",
                                       "--out",
                                       place.path("run")};
        words.insert(words.end(), more.begin(), more.end());
        return place.run(words);
    };
    const Outcome contradiction = triaxial("P.h5", {"--set", "packing.porosity=0.36"});
    EXPECT_EQ(contradiction.code, 2);
    EXPECT_THAT(contradiction.err, HasSubstr("packing.porosity = 0.36: contradicts the packing"));
    EXPECT_FALSE(place.has("run"));
    ASSERT_EQ(triaxial("P.h5", {}).code, 0);
    for (const char* line :
         {"porosity = 0.486 ", "spheres = 60 ", "blocks = [1, 2, 1] ", "passing = [0, 50, 100] "})
        EXPECT_THAT(place.read("run/config.toml"), HasSubstr(line));

    ASSERT_EQ(place.run({"convert", place.path("P.h5"), place.path("P.data")}).code, 0);
    const std::string text = place.read("P.data");
    const std::size_t end = text.find(" ylo yhi"), begin = text.rfind(' ', end - 1);
    std::string hash;
    for (const std::string& lid : {text.substr(begin + 1, end - begin - 1), std::string("0.9")}) {
        place.write("lid.data", text.substr(0, begin + 1) + lid + text.substr(end));
        const Outcome run = triaxial("lid.data", {});
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_THAT(run.out, HasSubstr("2600 kg/m3"));
        EXPECT_EQ(run.err.find("walls start at the spheres") != std::string::npos, lid == "0.9");
        const std::string found = place.json("run/summary.json")["state_hash"];
        EXPECT_EQ(found, hash.empty() ? found : hash);
        hash = found;
    }
}

TEST(Convert, FollowsNoDetourOntoItself) {
    const Workplace place;
    place.write("a.csv", spheres);
    std::filesystem::create_symlink(place.path("a.csv"), place.path("link.csv"));
    EXPECT_EQ(place.run({"convert", place.path("a.csv"), place.path("link.csv")}).code, 2);
    EXPECT_EQ(place.read("a.csv"), spheres);
}

TEST(Info, DescribesWhatSimulateWrites) {
    const Workplace place;
    const std::string scene =
        "[particles]\nfile = \"spheres.csv\"\n[time]\nstep = 1e-5\nend = 1e-4\n";
    ASSERT_EQ(place.simulate(spheres, scene).code, 0);
    EXPECT_THAT(place.run({"info", place.path("spheres.csv")}).out, HasSubstr("2 spheres"));
    EXPECT_THAT(place.run({"info", place.path("run/trajectory.csv")}).out,
                HasSubstr("trajectory: 22 rows"));
    EXPECT_THAT(place.run({"info", place.path("run/energy.csv")}).out, HasSubstr("energy balance"));
    EXPECT_THAT(place.run({"info", place.path("run/summary.json")}).out, HasSubstr("state_hash"));
    EXPECT_THAT(place.run({"info", place.path("scene.toml")}).out, HasSubstr("[particles]"));
}

}  // namespace
}  // namespace grainfield::program_tests
