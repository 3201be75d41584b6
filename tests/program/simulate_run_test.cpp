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
#include "tests/reliability/record.hpp"

namespace grainfield::program_tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

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
    const std::string scene =
        scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n" + falling + floor_wall;
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
            const std::string scene = scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n" + floor_wall;
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
    const std::string scene = scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n";
    EXPECT_THAT(place.simulate(lattice(2), scene).err, HasSubstr("simulating"));
    EXPECT_EQ(place.simulate(lattice(2), scene, {"--quiet"}).err, "");
}

TEST(SimulateRun, SettingsOverrideTheScene) {
    const Workplace place;
    const std::string scene = scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n";
    const Outcome run =
        place.simulate(lattice(2), scene, {"--set", "time.end=2e-3", "--set", "time.step=1e-4"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(place.json("run/summary.json").at("steps"), 20);
}

TEST(SimulateRun, ThreadsDoNotChangeTheState) {
    const Workplace place;
    // Enough spheres that loops are shared out among threads.
    const std::string spheres = lattice(18);
    const std::string scene = scene_head + "[time]\nstep = 2e-5\nend = 1.2e-3\n" + falling +
                              floor_wall + "[output]\ninterval = 1\n[damping]\nforce = 0.2\n";
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
                       scene_head + "[time]\nstep = 5e-3\nend = 1000\n" + falling + floor_wall);
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

TEST(SimulateRun, ASignalEndsWith130AndResumingGivesTheSameFiles) {
    // Spheres that fall and bounce for half a second of wall time or so, looked at often.
    const std::string scene = scene_head + "[time]\nstep = 2e-5\nend = 0.4\n" + falling +
                              floor_wall + "[output]\ninterval = 1e-3\n[damping]\nforce = 0.1\n";
    const Workplace undisturbed;
    ASSERT_EQ(undisturbed.simulate(lattice(4), scene).code, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGKILL}) {
        const Workplace place;
        place.write("spheres.csv", lattice(4));
        const std::string file = place.write("scene.toml", scene);
        const std::vector<std::string> command{
            "simulate", file, "--out", place.path("run"), "--checkpoint-every", "0.02"};
        const auto with = [&](std::vector<std::string> more) {
            more.insert(more.begin(), command.begin(), command.end());
            return more;
        };
        const Outcome run = place.run(
            command, SignalAfter{signal, [&] { return place.has("run/checkpoint.before.bin"); }});
        EXPECT_EQ(run.code, signal == SIGKILL ? 128 + SIGKILL : 130) << run.err;
        if (signal != SIGKILL) {
            EXPECT_THAT(run.err, HasSubstr(place.path("run/checkpoint.bin")));
        }
        EXPECT_FALSE(place.has("run/trajectory.csv")) << "whole or not at all";
        const Outcome other = place.run(with({"--resume", "--set", "time.safety=0.7"}));
        EXPECT_EQ(other.code, 2) << other.err;
        const Outcome resumed = place.run(with({"--resume", "--threads", "2"}));
        ASSERT_EQ(resumed.code, 0) << resumed.err;
        EXPECT_THAT(resumed.err, HasSubstr("goes on from"));
        for (const char* name : {"run/trajectory.csv", "run/energy.csv", "run/contacts.csv"})
            EXPECT_EQ(place.read(name), undisturbed.read(name)) << name;
        EXPECT_EQ(place.json("run/summary.json").at("state_hash"),
                  undisturbed.json("run/summary.json").at("state_hash"));
        const std::filesystem::directory_iterator files(place.path("run"));
        EXPECT_EQ(std::distance(begin(files), end(files)), 4) << "no checkpoint, no .part";
        reliability::record(
            "restarts",
            {{"of", "the program: `simulate`, a signal in mid-run"},
             {"kernels", "auto"},
             {"step", "?"},
             {"steps", "20000"},
             {"threads", "auto"},
             {"threads_after", "2"},
             {"same", reliability::same(place.json("run/summary.json").at("state_hash"),
                                        undisturbed.json("run/summary.json").at("state_hash"))}});
    }
}

TEST(SimulateRun, ResumesNothingButWhatItKnows) {
    const std::string scene = scene_head + "[time]\nstep = 2e-5\nend = 0.4\n" + falling +
                              floor_wall + "[output]\ninterval = 1e-3\n";
    const Workplace place;
    place.write("spheres.csv", lattice(4));
    const std::string file = place.write("scene.toml", scene);
    const std::vector<std::string> command{
        "simulate", file, "--out", place.path("run"), "--resume", "--checkpoint-every", "0.02"};
    // Nothing to resume: it begins.
    const Outcome stopped = place.run(
        command, SignalAfter{SIGINT, [&] { return place.has("run/checkpoint.before.bin"); }});
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("begins anew"));
    // Rows that are not there any more.
    const std::string rows = place.read("run/trajectory.csv.part");
    place.write("run/trajectory.csv.part", rows.substr(0, rows.size() / 2));
    const Outcome cut = place.run(command);
    EXPECT_EQ(cut.code, 4) << cut.err;
    EXPECT_THAT(cut.err, HasSubstr("trajectory.csv.part: is damaged"));
    place.write("run/trajectory.csv.part", rows + "rows of a run that was killed");
    // The last checkpoint is damaged, the one before is taken.
    std::string checkpoint = place.read("run/checkpoint.bin");
    checkpoint[checkpoint.size() / 2] = static_cast<char>(checkpoint[checkpoint.size() / 2] ^ 4);
    place.write("run/checkpoint.bin", checkpoint);
    // Other spheres are another run.
    place.write("spheres.csv", lattice(3));
    EXPECT_EQ(place.run(command).code, 2);
    place.write("spheres.csv", lattice(4));
    const Outcome resumed = place.run(command);
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("checkpoint.bin: is damaged: its checksum is wrong"));
    EXPECT_THAT(resumed.err, HasSubstr("goes on from " + place.path("run/checkpoint.before.bin")));
}

TEST(SimulateRun, ReusesAFolder) {
    const Workplace place;
    const std::string scene = scene_head + "[time]\nstep = 1e-5\nend = 1e-4\n";
    ASSERT_EQ(place.simulate(lattice(2), scene).code, 0);
    place.write("run/mine.txt", "kept");
    ASSERT_EQ(place.simulate(lattice(3), scene).code, 0);
    EXPECT_EQ(place.json("run/summary.json").at("particles"), 27);
    EXPECT_EQ(place.read("run/mine.txt"), "kept");
}

}  // namespace
}  // namespace grainfield::program_tests
