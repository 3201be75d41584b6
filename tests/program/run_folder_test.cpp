// The folder of a run: one process at a time works in it, a run that fails or begins anew leaves
// what a finished one wrote, and a run goes on with the inputs that it began with or not at all.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A packing of 120 spheres, and tests of a thousandth of strain on it.
class RunFolder : public testing::Test {
  protected:
    RunFolder() {
        std::vector<std::string> pack{"pack", "--out", place_.path("P.h5")};
        pack.insert(pack.end(), small_packing.begin(), small_packing.end());
        const Outcome packed = place_.run(pack);
        EXPECT_EQ(packed.code, 0) << packed.err;
    }

    std::vector<std::string> test(const std::string& out, const std::string& packing,
                                  const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{"triaxial", "--out", place_.path(out)};
        if (!packing.empty()) words.insert(words.end(), {"--packing", place_.path(packing)});
        words.insert(words.end(), small_packing.begin(), small_packing.end());
        words.insert(words.end(), {"--set", "triaxial.max_axial_strain=0.001", "--set",
                                   "triaxial.strain_rate=1"});
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// Runs until it has made checkpoints, then stops it.
    Outcome stopped(std::vector<std::string> words, const std::string& out,
                    int signal = SIGINT) const {
        words.insert(words.end(), {"--checkpoint-every", "1e-9"});
        return place_.run(words, SignalAfter{signal, [this, out] {
                                                 return place_.has(out + "/checkpoint.before.bin");
                                             }});
    }
    std::map<std::string, std::string> files(const std::string& folder) const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::directory_iterator(place_.path(folder))) {
            const std::string name = entry.path().filename();
            all[name] = place_.read(folder + "/" + name);
        }
        return all;
    }

    Workplace place_;
};

TEST_F(RunFolder, GoesOnOnlyWithTheInputsThatItBeganWith) {
    const std::string data = place_.write("cpt.csv", "x,y,z,value,error\n0.1,0.1,0.1,0.5,0.1\n");
    const std::vector<std::string> field{"--set", "field.variable=friction", "--set",
                                         "field.data=" + data};
    const Outcome first = stopped(test("run", "P.h5", field), "run");
    ASSERT_EQ(first.code, 130) << first.err;
    const std::vector<std::string> resume{"triaxial", "--out", place_.path("run"), "--resume"};

    place_.write("cpt.csv", "x,y,z,value,error\n0.1,0.1,0.1,0.6,0.1\n");
    const Outcome other_data = place_.run(resume);
    EXPECT_EQ(other_data.code, 2) << other_data.err;
    EXPECT_THAT(other_data.err, HasSubstr("cpt.csv is not what it was"));
    place_.write("cpt.csv", "x,y,z,value,error\n0.1,0.1,0.1,0.5,0.1\n");

    const std::string packing = place_.read("P.h5");
    place_.write("P.h5", packing + " ");
    const Outcome other_packing = place_.run(resume);
    EXPECT_EQ(other_packing.code, 2) << other_packing.err;
    EXPECT_THAT(other_packing.err, HasSubstr("P.h5 is not what it was"));
    place_.write("P.h5", packing);
    const Outcome resumed = place_.run(resume);
    EXPECT_EQ(resumed.code, 0) << resumed.err;
}

TEST_F(RunFolder, ANewRunPutsTheCheckpointOfAnEarlierOneAway) {
    ASSERT_EQ(stopped(test("run", "P.h5"), "run").code, 130);
    const std::string before = place_.read("run/checkpoint.bin");
    // Killed before it has a checkpoint of its own.
    const Outcome killed =
        place_.run(test("run", "P.h5", {"--checkpoint-every", "0"}),
                   SignalAfter{SIGKILL, [&] { return place_.has("run/checkpoint.stale.bin"); }});
    ASSERT_EQ(killed.code, 128 + SIGKILL) << killed.err;
    EXPECT_EQ(place_.read("run/checkpoint.stale.bin"), before);
    EXPECT_FALSE(place_.has("run/checkpoint.bin"));
    const Outcome resumed = place_.run(test("run", "P.h5", {"--resume"}));
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("begins anew"));
    EXPECT_FALSE(place_.has("run/checkpoint.stale.bin"));
}

TEST_F(RunFolder, NamesNeedNotBeUtf8) {
    fs::create_directory(place_.path("caf\xe9"));
    fs::copy_file(place_.path("P.h5"), place_.path("caf\xe9/P\xff.h5"));
    const std::string packing = "caf\xe9/P\xff.h5", out = "caf\xe9/run\xc3";
    const Outcome first = stopped(test(out, packing), out);
    ASSERT_EQ(first.code, 130) << first.err;
    EXPECT_EQ(place_.run({"info", place_.path(out + "/checkpoint.bin")}).code, 0);
    const Outcome resumed = place_.run(test(out, packing, {"--resume"}));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(place_.run({"report", place_.path(out)}).code, 0);
    // Without the name of the packing it is that of the checkpoint.
    const std::string other = out + "2";
    ASSERT_EQ(stopped(test(other, packing), other).code, 130);
    EXPECT_EQ(place_.run({"triaxial", "--out", place_.path(other), "--resume"}).code, 0);
    // TOML holds UTF-8 only.
    place_.write("caf\xe9/c.toml", "[field]\nvariable = 'friction'\ndata = 'd.csv'\n");
    const Outcome data =
        place_.run({"triaxial", place_.path("caf\xe9/c.toml"), "--out", place_.path("third")});
    EXPECT_EQ(data.code, 2) << data.err;
    EXPECT_THAT(data.err, HasSubstr("is not UTF-8"));
    EXPECT_FALSE(place_.has("third")) << "an empty folder is left";
}

TEST_F(RunFolder, ASecondProcessSaysSoAndStops) {
    place_.write("spheres.csv", "x,y,z,radius\n0,1,0,0.1\n");
    const std::string scene =
        place_.write("scene.toml", scene_head + "[time]\nstep = 1e-6\nend = 1000\n");
    const std::vector<std::string> simulate{"simulate", scene, "--out", place_.path("run")};
    std::vector<std::string> pack{"pack", "--out", place_.path("other.h5")};
    pack.insert(pack.end(), small_packing.begin(), small_packing.end());
    struct Pair {
        std::vector<std::string> first, second;
        std::string lock;
    };
    for (const Pair& pair : {Pair{simulate, simulate, "run/checkpoint.lock"},
                             Pair{simulate, test("run", "P.h5"), "run/checkpoint.lock"},
                             Pair{simulate, {"report", place_.path("run")}, "run/checkpoint.lock"},
                             Pair{pack, pack, "other.checkpoint.lock"}}) {
        SCOPED_TRACE(pair.second[0]);
        Outcome second;
        const Outcome first = place_.run(
            pair.first, SignalAfter{SIGTERM, [&] {
                                        if (!place_.has(pair.lock)) return false;
                                        second = run_program(pair.second, place_.path("."));
                                        return true;
                                    }});
        EXPECT_EQ(first.code, 130);
        EXPECT_EQ(second.code, 2) << second.err;
        EXPECT_THAT(second.err, HasSubstr("works here already"));
        EXPECT_FALSE(place_.has(pair.lock));
    }
}

TEST_F(RunFolder, AFailedRunLeavesAFinishedOneAsItIs) {
    ASSERT_EQ(place_.run(test("run", "")).code, 0);
    const auto finished = files("run");
    ASSERT_TRUE(finished.contains("packing.h5"));
    // A step beyond the limit of stability, in a test on another packing.
    const Outcome failed =
        place_.run(test("run", "", {"--set", "packing.blocks=[2,2,1]", "--set", "time.step=1e-3"}));
    ASSERT_EQ(failed.code, 3) << failed.err;
    for (const auto& [name, content] : finished)
        EXPECT_TRUE(place_.has("run/" + name) && place_.read("run/" + name) == content) << name;

    const Outcome third = place_.run(test("run", "", {"--set", "packing.blocks=[2,2,1]"}));
    ASSERT_EQ(third.code, 0) << third.err;
    const auto replaced = files("run");
    for (const auto& [name, content] : replaced)
        EXPECT_TRUE(finished.contains(name) && finished.at(name) != content) << name;
    EXPECT_EQ(replaced.size(), finished.size());

    // A sample that is read brings no packing.json: that of another one must go.
    ASSERT_EQ(place_.run({"convert", place_.path("P.h5"), place_.path("P.csv")}).code, 0);
    ASSERT_EQ(place_.run(test("run", "P.csv")).code, 0);
    EXPECT_FALSE(place_.has("run/packing.json"));
}

TEST_F(RunFolder, AFailedSceneLeavesAFinishedOneAsItIs) {
    const std::string spheres = "x,y,z,radius\n0,0.1,0,0.1\n0.195,0.1,0,0.1\n";
    ASSERT_EQ(place_.simulate(spheres, scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n").code, 0);
    const auto finished = files("run");
    const std::string heating =
        scene_head + "[time]\nstep = 5e-3\nend = 1000\n" + falling + floor_wall;
    const Outcome failed = place_.simulate(spheres, heating);
    ASSERT_EQ(failed.code, 3);
    EXPECT_THAT(failed.err, HasSubstr("state.failed.h5"));
    for (const auto& [name, content] : finished) EXPECT_EQ(place_.read("run/" + name), content);
    ASSERT_EQ(place_.simulate(spheres, scene_head + "[time]\nstep = 2e-5\nend = 1e-3\n").code, 0);
    EXPECT_EQ(files("run").size(), finished.size());
}

TEST_F(RunFolder, IsClearedOfWhatKilledWritesLeft) {
    fs::create_directory(place_.path("run"));
    place_.write("run/.grainfield-1-0.tmp", "of a killed process");
    place_.write("run/.grainfield-2-0.tmp", "of one that may be writing");
    place_.write("run/mine.tmp", "");
    for (const char* name : {"run/.grainfield-1-0.tmp", "run/mine.tmp"})
        fs::last_write_time(place_.path(name),
                            fs::file_time_type::clock::now() - std::chrono::minutes(2));
    place_.write("spheres.csv", "x,y,z,radius\n0,1,0,0.1\n");
    ASSERT_EQ(place_
                  .run({"simulate", place_.write("scene.toml", scene_head + "[time]\nend = 1e-4\n"),
                        "--out", place_.path("run")})
                  .code,
              0);
    EXPECT_FALSE(place_.has("run/.grainfield-1-0.tmp"));
    EXPECT_TRUE(place_.has("run/.grainfield-2-0.tmp"));
    EXPECT_TRUE(place_.has("run/mine.tmp"));
}

}  // namespace
}  // namespace grainfield::program_tests
