// `triaxial --repeats`: the first is the run without it, others differ, and a series that is
// interrupted goes on to the same bytes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Tests of two thousandths of strain on a packing of 120 spheres.
class Repeats : public testing::Test {
  protected:
    Repeats() {
        std::vector<std::string> pack{"pack", "--out", place_.path("P.h5")};
        pack.insert(pack.end(), small_packing.begin(), small_packing.end());
        const Outcome packed = place_.run(pack);
        EXPECT_EQ(packed.code, 0) << packed.err;
    }
    std::vector<std::string> test(const std::string& out, const std::vector<std::string>& more,
                                  const std::string& packing = "P.h5") const {
        std::vector<std::string> words{"triaxial", "--out", place_.path(out)};
        if (!packing.empty()) words.insert(words.end(), {"--packing", place_.path(packing)});
        words.insert(words.end(), small_packing.begin(), small_packing.end());
        words.insert(words.end(), {"--set", "triaxial.max_axial_strain=0.002", "--set",
                                   "triaxial.strain_rate=1"});
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// Runs a series until one of its repeats has saved its state, then stops it.
    Outcome stopped_in(const std::string& folder, const std::vector<std::string>& words, int repeat,
                       int signal) const {
        std::vector<std::string> often = words;
        often.insert(often.end(), {"--checkpoint-every", "1e-9"});
        const std::string before = folder + "/repeat" + std::to_string(repeat - 1) + ".part";
        fs::file_time_type saved;
        return place_.run(often,
                          SignalAfter{signal, [&, this] {
                                          if (repeat > 0 && !place_.has(before + "/summary.json"))
                                              return false;
                                          std::error_code missing;
                                          const auto time = fs::last_write_time(
                                              place_.path(folder + "/checkpoint.bin"), missing);
                                          if (missing) return false;
                                          if (saved == fs::file_time_type()) saved = time;
                                          return time != saved;
                                      }});
    }
    void expect_same_series(const std::string& a, const std::string& b, int repeats) const {
        std::vector<std::string> names{"repeats.csv", "repeats.json"};
        for (int r = 0; r < repeats; ++r)
            for (const char* name : {"curve.csv", "energy.csv", "state.h5", "config.toml"})
                names.push_back("repeat" + std::to_string(r) + "/" + name);
        for (const std::string& name : names)
            EXPECT_TRUE(place_.read(a + "/" + name) == place_.read(b + "/" + name)) << name;
    }

    Workplace place_;
};

TEST_F(Repeats, FirstIsTheRunWithoutThemAndOthersDiffer) {
    ASSERT_EQ(place_.run(test("plain", {})).code, 0);
    const Outcome series = place_.run(test("series", {"--repeats", "3"}));
    ASSERT_EQ(series.code, 0) << series.err;
    EXPECT_THAT(series.out, HasSubstr("largest deviator stress (kPa)"));
    const std::string plain = place_.json("plain/summary.json").at("state_hash");
    std::vector<std::string> hashes;
    std::vector<double> moduli;
    for (const char* repeat : {"repeat0", "repeat1", "repeat2"}) {
        const auto summary = place_.json("series/" + std::string(repeat) + "/summary.json");
        hashes.push_back(summary.at("state_hash"));
        moduli.push_back(summary.at("E50_Pa"));
    }
    EXPECT_EQ(hashes[0], plain);
    EXPECT_NE(hashes[1], plain);
    EXPECT_NE(hashes[2], plain);
    EXPECT_NE(hashes[2], hashes[1]);
    EXPECT_EQ(place_.read("series/repeat0/curve.csv"), place_.read("plain/curve.csv"));
    EXPECT_EQ(place_.read("series/repeat1/config.toml"), place_.read("plain/config.toml"));
    EXPECT_EQ(place_.read("series/repeat2/packing.json"), place_.read("P.json"));
    // By hand from the repeats.
    const auto E50 = place_.json("series/repeats.json").at("E50_Pa");
    const double mean = (moduli[0] + moduli[1] + moduli[2]) / 3;
    double squares = 0;
    for (const double modulus : moduli) squares += (modulus - mean) * (modulus - mean);
    EXPECT_NEAR(E50.at("mean").get<double>(), mean, 1e-9 * mean);
    EXPECT_NEAR(E50.at("deviation").get<double>(), std::sqrt(squares / 2), 1e-9 * mean);

    // Both kinds of folders are ones of `report`.
    fs::remove(place_.path("series/report.html"));
    EXPECT_EQ(place_.run({"report", place_.path("series/repeat1")}).code, 0);
    EXPECT_EQ(place_.run({"report", place_.path("series")}).code, 0);
    EXPECT_THAT(place_.read("series/report.html"), HasSubstr("repeats 1 to 2"));
    EXPECT_EQ(place_.run({"report", place_.path("series"), place_.path("plain")}).code, 2);

    // Nothing of another run or series stays behind.
    ASSERT_EQ(place_.run(test("series", {"--repeats", "2"})).code, 0);
    EXPECT_FALSE(place_.has("series/repeat2"));
    ASSERT_EQ(place_.run(test("series", {})).code, 0);
    EXPECT_FALSE(place_.has("series/repeats.json") || place_.has("series/repeats.csv"));
    EXPECT_FALSE(place_.has("series/repeat0") || place_.has("series/repeat1"));
    ASSERT_EQ(place_.run(test("series", {"--repeats", "2"})).code, 0);
    EXPECT_FALSE(place_.has("series/summary.json") || place_.has("series/curve.csv"));
}

TEST_F(Repeats, AStoppedSeriesGoesOnToTheSameBytes) {
    // The packing is made by the series itself, and kept in its folder.
    ASSERT_EQ(place_.run(test("whole", {"--repeats", "3"}, "")).code, 0);
    ASSERT_TRUE(place_.has("whole/packing.h5"));
    const auto words = test("series", {"--repeats", "3"}, "");
    const Outcome stopped = stopped_in("series", words, 1, SIGINT);
    ASSERT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("--resume goes on"));
    EXPECT_FALSE(place_.has("series/repeat1.part/summary.json"));
    const auto first = fs::last_write_time(place_.path("series/repeat0.part/state.h5"));

    const Outcome other = place_.run(test("series", {"--repeats", "4", "--resume"}, ""));
    EXPECT_EQ(other.code, 2) << other.err;
    EXPECT_THAT(other.err, HasSubstr("--repeats = 4: the checkpoint is of 3"));

    std::vector<std::string> resume = words;
    resume.emplace_back("--resume");
    const Outcome killed = stopped_in("series", resume, 2, SIGKILL);
    ASSERT_EQ(killed.code, 128 + SIGKILL) << killed.err;
    // Without --repeats it is what the checkpoint says.
    const Outcome resumed = place_.run(test("series", {"--resume"}, ""));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(fs::last_write_time(place_.path("series/repeat0/state.h5")), first)
        << "a finished repeat was run again";
    expect_same_series("series", "whole", 3);
    EXPECT_EQ(place_.read("series/packing.h5"), place_.read("whole/packing.h5"));
    EXPECT_FALSE(place_.has("series/checkpoint.bin"));
}

TEST_F(Repeats, AFinishedRunStaysUntilTheSeriesHasItsResults) {
    ASSERT_EQ(place_.run(test("out", {})).code, 0);
    const std::vector<std::string> results{"summary.json", "curve.csv",   "energy.csv",
                                           "state.h5",     "report.html", "config.toml"};
    std::vector<std::string> before;
    for (const std::string& name : results) before.push_back(place_.read("out/" + name));
    const auto series = test("out", {"--repeats", "2"});
    ASSERT_EQ(stopped_in("out", series, 1, SIGINT).code, 130);
    for (std::size_t k = 0; k < results.size(); ++k)
        EXPECT_EQ(place_.read("out/" + results[k]), before[k]) << results[k];
    // A file of the user's stays for good.
    place_.write("out/notes.txt", "mine");
    ASSERT_EQ(place_.run(series).code, 0);
    EXPECT_FALSE(place_.has("out/summary.json") || place_.has("out/repeat0.part"));
    EXPECT_TRUE(place_.has("out/notes.txt") && place_.has("out/repeat1/summary.json"));
}

TEST_F(Repeats, ACheckpointOfASingleRunIsNotOneOfASeries) {
    ASSERT_EQ(stopped_in("run", test("run", {}), 0, SIGINT).code, 130);
    const Outcome other = place_.run(test("run", {"--repeats", "2", "--resume"}));
    EXPECT_EQ(other.code, 2) << other.err;
    EXPECT_THAT(other.err, HasSubstr("--repeats = 2: the checkpoint is of a single run"));
}

TEST_F(Repeats, FewerThanTwoOrTooManyAreRefused) {
    for (const char* repeats : {"0", "1", "1001", "-2", "2.5"}) {
        const Outcome refused = place_.run(test("series", {"--repeats", repeats}));
        EXPECT_EQ(refused.code, 2) << refused.err;
        EXPECT_THAT(refused.err, HasSubstr("--repeats"));
        EXPECT_FALSE(place_.has("series"));
    }
}

TEST_F(Repeats, OneThatFailsIsNamed) {
    const Outcome failed =
        place_.run(test("series", {"--repeats", "2", "--set", "time.step=1e-3"}));
    ASSERT_EQ(failed.code, 3) << failed.err;
    EXPECT_THAT(failed.err, HasSubstr("repeat 0 of 0-1: "));
    EXPECT_THAT(failed.err, HasSubstr("repeat0.part/state.h5"));
    EXPECT_TRUE(place_.has("series/repeat0.part/state.h5"));
    EXPECT_FALSE(place_.has("series/repeats.csv"));
}

}  // namespace
}  // namespace grainfield::program_tests
