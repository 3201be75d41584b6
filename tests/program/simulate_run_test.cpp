// `simulate` as a program: its summary, threads, failure and interruption.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>

#include "kernels/vector/vector_tables.hpp"
#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

const std::string head = "[particles]\nfile = \"spheres.csv\"\n";
const std::string falling = "[gravity]\nacceleration = [0, -9.81, 0]\n";
const std::string floor_wall =
    "[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nfriction_angle = 0.3\n";

/// A lattice of n x n x n spheres of two sizes, slightly pressed together.
std::string lattice(int n) {
    std::string text = "x,y,z,radius,vx,vy,vz\n";
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const bool small = (i + 2 * j + 3 * k) % 5 == 0;
                const double values[] = {0.2 * i,       0.2 * j + 0.0999,
                                         0.1998 * k,    small ? 0.09 : 0.1,
                                         0.1 * (j % 3), -0.1 * (k % 2)};
                for (const double v : values) text += std::to_string(v) + ",";
                text += "0\n";
            }
    return text;
}

TEST(SimulateRun, SummaryIsComplete) {
    const Workplace place;
    const std::string scene = head + "[time]\nstep = 1e-5\nend = 1e-3\n" + falling + floor_wall;
    const Outcome run = place.simulate(lattice(3), scene, {"--threads", "2"});
    ASSERT_EQ(run.code, 0) << run.err;
    const nlohmann::json s = place.json("run/summary.json");
    EXPECT_EQ(s.at("particles"), 27);
    EXPECT_EQ(s.at("walls"), 1);
    EXPECT_EQ(s.at("steps"), 100);
    EXPECT_EQ(s.at("time_step_s"), 1e-5);
    EXPECT_EQ(s.at("threads"), 2);
    EXPECT_THAT(s.at("isa").get<std::string>(), AnyOf("scalar", "avx2", "avx512"));
    EXPECT_EQ(s.at("precision"), "double");
    EXPECT_GT(s.at("wall_seconds").at("total"), 0);
    EXPECT_GT(s.at("particle_steps_per_second"), 0);
    EXPECT_EQ(s.at("state_hash").get<std::string>().size(), 16U);
    EXPECT_THAT(run.out, HasSubstr(s.at("state_hash").get<std::string>()));
    const Table contacts = read_table(place.read("run/contacts.csv"));
    EXPECT_EQ(s.at("contacts"), contacts.rows.size());
}

/// Every instruction set and precision by name: the one asked for runs, or the message says why
/// not.
TEST(SimulateRun, AForcedInstructionSetRunsOrIsRefused) {
    for (const kernels::InstructionSet isa : kernels::instruction_sets)
        for (const std::string precision : {"double", "mixed"}) {
            const std::string name = kernels::name(isa);
            const Workplace place;
            const std::string scene = head + "[time]\nstep = 1e-5\nend = 1e-3\n" + floor_wall;
            const Outcome run = place.simulate(
                lattice(3), scene, {"--isa", name, "--set", "solver.precision=" + precision});
            if (!kernels::runs_here(isa)) {
                EXPECT_EQ(run.code, 2);
                EXPECT_THAT(run.err, HasSubstr("solver.isa = \"" + name + "\""));
                continue;
            }
            ASSERT_EQ(run.code, 0) << run.err;
            const nlohmann::json s = place.json("run/summary.json");
            EXPECT_EQ(s.at("isa"), name);
            EXPECT_EQ(s.at("precision"), precision);
        }
}

TEST(SimulateRun, QuietSaysNothingOnStderr) {
    const Workplace place;
    const std::string scene = head + "[time]\nstep = 1e-5\nend = 1e-3\n";
    EXPECT_THAT(place.simulate(lattice(2), scene).err, HasSubstr("simulating"));
    EXPECT_EQ(place.simulate(lattice(2), scene, {"--quiet"}).err, "");
}

TEST(SimulateRun, SettingsOverrideTheScene) {
    const Workplace place;
    const std::string scene = head + "[time]\nstep = 1e-5\nend = 1e-3\n";
    const Outcome run =
        place.simulate(lattice(2), scene, {"--set", "time.end=2e-3", "--set", "time.step=1e-4"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(place.json("run/summary.json").at("steps"), 20);
}

TEST(SimulateRun, ThreadsDoNotChangeTheState) {
    const Workplace place;
    // Enough spheres that loops are shared out among threads.
    const std::string spheres = lattice(18);
    const std::string scene = head + "[time]\nstep = 2e-5\nend = 1.2e-3\n" + falling + floor_wall +
                              "[output]\ninterval = 1\n[damping]\nforce = 0.2\n";
    std::string hash;
    for (const char* threads : {"1", "2", "3", "4"}) {
        const Outcome run = place.simulate(spheres, scene, {"--threads", threads});
        ASSERT_EQ(run.code, 0) << run.err;
        const std::string one = place.json("run/summary.json").at("state_hash");
        if (hash.empty()) hash = one;
        EXPECT_EQ(one, hash) << threads << " threads";
    }
}

TEST(SimulateRun, AnExplosionEndsWithThreeAndItsState) {
    const Workplace place;
    const Outcome run =
        place.simulate("x,y,z,radius\n0,0.1,0,0.1\n0.195,0.1,0,0.1\n",
                       head + "[time]\nstep = 5e-3\nend = 1000\n" + falling + floor_wall);
    EXPECT_EQ(run.code, 3) << run.err;
    const std::string state = place.path("run/state.h5");
    EXPECT_THAT(run.err, HasSubstr(state));
    EXPECT_TRUE(place.has("run/state.h5"));
    EXPECT_FALSE(place.has("run/trajectory.csv")) << "whole or not at all";
    const std::size_t at = run.err.find("step ");
    ASSERT_NE(at, std::string::npos) << run.err;
    EXPECT_LE(std::atoi(run.err.c_str() + at + 5), 300);
    const Outcome info = place.run({"info", state});
    EXPECT_EQ(info.code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("2 spheres"));
}

TEST(SimulateRun, ASignalEndsWith130AndTheState) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Workplace place;
        place.write("spheres.csv", lattice(4));
        const std::string scene = place.write(
            "scene.toml", head + "[time]\nstep = 1e-5\nend = 1e5\n[output]\ninterval = 1e5\n");
        const Outcome run =
            place.run({"simulate", scene, "--out", place.path("run")},
                      SignalAfter{signal, [&] { return holds_a_file(place.path("run")); }});
        EXPECT_EQ(run.code, 130) << run.err;
        EXPECT_THAT(run.err, HasSubstr(place.path("run/state.h5")));
        EXPECT_TRUE(place.has("run/state.h5"));
        const std::filesystem::directory_iterator files(place.path("run"));
        EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "state.h5 and nothing else";
    }
}

TEST(SimulateRun, ReusesAFolder) {
    const Workplace place;
    const std::string scene = head + "[time]\nstep = 1e-5\nend = 1e-4\n";
    ASSERT_EQ(place.simulate(lattice(2), scene).code, 0);
    place.write("run/mine.txt", "kept");
    ASSERT_EQ(place.simulate(lattice(3), scene).code, 0);
    EXPECT_EQ(place.json("run/summary.json").at("particles"), 27);
    EXPECT_EQ(place.read("run/mine.txt"), "kept");
}

}  // namespace
}  // namespace grainfield::program_tests
