// Campaigns survive: stopped or killed at any moment and started again, in shards, on any number
// of threads, they end with the same results; two processes do not meet; failures are rows.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <numeric>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <sstream>

#include "core/files/sphere_file.hpp"
#include "tests/program/program.hpp"
#include "tests/triaxial/small_test.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;

/// A packing of 200 spheres and a campaign on it, for all tests.
class MonteCarlo : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const triaxial::Sample sample = triaxial::testing::dense_sample(200);
        packing_ = std::make_unique<core::SphereFile>();
        packing_->spheres = sample.spheres;
        packing_->box = sample.box;
        packing_->has_normal_stiffness = packing_->has_friction_angle = packing_->has_block = true;
        packing_->kind = "packing";
        const Vec3 size = sample.box.size();
        config_ = fmt::format(
            "[packing]\nblocks = [2, 4, 2]\nblock = [{}, {}, {}]\n[field]\nvariable = "
            "'stiffness'\n[triaxial]\nmax_axial_strain = 0.02\n[montecarlo]\nrealizations = "
            "8\n[montecarlo.sweep]\n"
            "'field.stiffness.cov' = [0.4, 0.8]\n",
            size.x() / 2, size.y() / 4, size.z() / 2);
    }
    static void TearDownTestSuite() { packing_.reset(); }

    MonteCarlo() {
        core::write_spheres(place_.path("p.h5"), *packing_);
        place_.write("c.toml", config_);
    }

    std::vector<std::string> words(const std::string& out,
                                   const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"montecarlo",     place_.path("c.toml"), "--out",
                                     place_.path(out), "--packing",           place_.path("p.h5")};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Outcome run(const std::string& out, const std::vector<std::string>& more = {},
                const std::optional<SignalAfter>& signal = std::nullopt) const {
        return place_.run(words(out, more), signal);
    }
    /// A results file without the wall times.
    std::string table(const std::string& out, const std::string& name = "results.csv") const {
        std::string text;
        std::istringstream lines(place_.read(out + "/" + name));
        for (std::string line; std::getline(lines, line);) {
            std::istringstream fields(line);
            std::string field;
            for (int k = 0; std::getline(fields, field, ','); ++k)
                if (k != 9) text += field + ',';
            text += '\n';
        }
        return text;
    }
    /// Whole lines of all journals of a campaign.
    std::size_t rows(const std::string& out) const {
        std::size_t count = 0;
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator(place_.path(out), error))
            if (entry.path().extension() == ".journal") {
                const std::string text = place_.read(out + "/" + entry.path().filename().string());
                count += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
            }
        return count;
    }

    static std::unique_ptr<core::SphereFile> packing_;
    static std::string config_;
    Workplace place_;
};

std::unique_ptr<core::SphereFile> MonteCarlo::packing_;
std::string MonteCarlo::config_;

TEST_F(MonteCarlo, KilledAgainAndAgainItEndsWithTheSameResults) {
    ASSERT_EQ(run("whole", {"--quiet"}).code, 0);
    const std::string whole = table("whole");
    EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 1 + 2 * 8);
    EXPECT_EQ(whole.find("failed"), std::string::npos);

    int kills = 0;
    Outcome last;
    for (int attempt = 0; attempt < 60; ++attempt) {
        const std::size_t before = rows("killed");
        // Later and later after something has happened, at any moment of a run.
        const auto moment = std::make_shared<std::chrono::steady_clock::time_point>();
        const auto delay = std::chrono::milliseconds(7 * attempt % 60);
        const auto due = [&, moment] {
            const auto now = std::chrono::steady_clock::now();
            if (*moment == std::chrono::steady_clock::time_point{} &&
                (rows("killed") > before || (before == 0 && attempt < 5)))
                *moment = now;
            return *moment != std::chrono::steady_clock::time_point{} && now - *moment >= delay;
        };
        last =
            run("killed", {"--threads", attempt % 2 == 0 ? "1" : "2"}, SignalAfter{SIGKILL, due});
        EXPECT_GE(rows("killed"), before) << "a finished row is gone";
        if (last.code == 0) break;
        ASSERT_EQ(last.code, 128 + SIGKILL) << last.err;
        ++kills;
    }
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_GE(kills, 5);
    EXPECT_EQ(table("killed"), whole);
    EXPECT_EQ(table("killed", "deterministic.csv"), table("whole", "deterministic.csv"));
    // Done already: nothing is computed.
    const Outcome again = run("killed");
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.out, HasSubstr("rows computed           0"));
    EXPECT_EQ(table("killed"), whole);
}

TEST_F(MonteCarlo, AFullDiskEndsItAndLosesNothing) {
    ASSERT_EQ(run("whole").code, 0);
    ASSERT_EQ(run("full", {"--set", "montecarlo.realizations=1"}).code, 0);
    const std::size_t before = rows("full");
    // No file may grow beyond 4 KiB: the journal soon cannot. The shell's ignored signal is passed
    // on, so that the program sees the error of its write.
    std::string command = "trap '' XFSZ; ulimit -f 4; exec " GRAINFIELD_PROGRAM;
    for (const std::string& word : words("full")) command += " '" + word + "'";
    const std::string log = place_.path("full.log");
    const int status = std::system(("bash -c \"" + command + "\" >'" + log + "' 2>&1").c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 4) << place_.read("full.log");
    EXPECT_THAT(place_.read("full.log"), HasSubstr("cannot be written"));
    EXPECT_GT(rows("full"), before);
    EXPECT_LT(rows("full"), 18u);
    EXPECT_EQ(run("full").code, 0);
    EXPECT_EQ(table("full"), table("whole"));
}

TEST_F(MonteCarlo, ClosedStreamsDoNotHarmTheJournal) {
    const std::vector<std::string> one{"--set", "montecarlo.realizations=1"};
    EXPECT_EQ(place_.run_in_shell(words("out", one), "0<&- 1>&- 2>&-"), 0);
    const std::size_t before = rows("out");
    EXPECT_EQ(before, 4u);
    const Outcome again = run("out", one);
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("rows computed           0"));
}

TEST_F(MonteCarlo, InterruptedItSaysHowFarItIs) {
    const Outcome stopped =
        run("out", {"--threads", "1"}, SignalAfter{SIGINT, [&] { return rows("out") >= 3; }});
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("of 18 rows are done"));
    EXPECT_GE(std::ranges::count(table("out"), '\n'), 1 + 1);
    EXPECT_LT(rows("out"), 18u);
    EXPECT_EQ(run("out").code, 0);
    EXPECT_EQ(rows("out"), 18u);
}

TEST_F(MonteCarlo, ShardsInOneFolderAndMergedFoldersGiveTheSame) {
    ASSERT_EQ(run("whole").code, 0);
    for (const char* shard : {"2/3", "1/3", "3/3"}) {
        ASSERT_EQ(run("shared", {"--shard", shard}).code, 0);
        ASSERT_EQ(run(std::string("part") + shard[0], {"--shard", shard}).code, 0);
    }
    EXPECT_EQ(table("shared"), table("whole"));
    const Outcome merged = run(
        "merged", {"--merge", place_.path("part1"), place_.path("part2"), place_.path("part3")});
    EXPECT_EQ(merged.code, 0) << merged.err;
    EXPECT_EQ(table("merged"), table("whole"));
    EXPECT_EQ(table("merged", "deterministic.csv"), table("whole", "deterministic.csv"));
}

TEST_F(MonteCarlo, RowsAreTheSameOnAnyThreadsAndOfTheTriaxialCommand) {
    ASSERT_EQ(run("one", {"--threads", "1"}).code, 0);
    ASSERT_EQ(run("three", {"--threads", "3"}).code, 0);
    ASSERT_EQ(run("pair", {"--threads", "2", "--abreast", "1"}).code, 0);
    EXPECT_EQ(table("one"), table("three"));
    EXPECT_EQ(table("one"), table("pair"));
    std::filesystem::path start;
    for (const auto& entry : std::filesystem::directory_iterator(place_.path("one/starts")))
        if (entry.path().extension() == ".h5") start = entry.path();
    const Outcome single =
        place_.run({"triaxial", place_.path("one/cases/cov=0.8.toml"), "--packing", start.string(),
                    "--realization", "5", "--out", place_.path("single")});
    ASSERT_EQ(single.code, 0) << single.err;
    EXPECT_THAT(place_.read("one/cases/cov=0.8.toml"), HasSubstr(start.filename().string()));
    // One test alone keeps the energy ledger, a campaign does not: the state is the same.
    const nlohmann::json summary = place_.json("single/summary.json");
    EXPECT_LT(summary["energy_closing_error"], 5e-3);
    EXPECT_GT(summary["energy_J"]["friction_work"], 0);
    const Table energy = read_table(place_.read("single/energy.csv"));
    const auto sum = [](const std::vector<double>& row) {
        return std::accumulate(row.begin() + 1, row.end(), 0.0);
    };
    EXPECT_NEAR(sum(energy.rows.back()), sum(energy.rows.front()),
                5e-3 * summary["energy_J"]["external_work"].get<double>());
    const std::string hash = summary["state_hash"];
    EXPECT_THAT(table("one"), testing::ContainsRegex("cov=0.8,5,1,done,.*" + hash));
}

TEST_F(MonteCarlo, ACaseEndsOnceItsIntervalsAreNarrowEnoughAtTheSameRow) {
    const std::vector<std::string> target{"--set", "montecarlo.realizations=200", "--set",
                                          "montecarlo.target_mean_error=0.1", "--threads"};
    for (const char* threads : {"1", "3"}) {
        std::vector<std::string> more = target;
        more.emplace_back(threads);
        const Outcome outcome = run(threads, more);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    const std::string one = table("1");
    EXPECT_EQ(one, table("3"));
    // The case that varies more takes more realizations; none takes all.
    const auto count = [&](const std::string& name) {
        long n = 0;
        std::istringstream lines(one);
        for (std::string line; std::getline(lines, line);) n += line.starts_with(name);
        return n;
    };
    EXPECT_GE(count("cov=0.4"), 20);
    EXPECT_GE(count("cov=0.8"), count("cov=0.4"));
    EXPECT_LT(count("cov=0.8"), 200);
    EXPECT_LT(count("cov=0.4"), 200);
}

TEST_F(MonteCarlo, TheSecondProcessSaysSoAndStops) {
    Outcome second;
    const Outcome first = run("out", {"--threads", "1"},
                              SignalAfter{SIGTERM, [&] {
                                              if (rows("out") == 0) return false;
                                              second = run_program(words("out"), place_.path("."));
                                              return true;
                                          }});
    EXPECT_EQ(first.code, 130);
    EXPECT_EQ(second.code, 2);
    EXPECT_THAT(second.err, HasSubstr("works on this campaign already"));
    EXPECT_EQ(run("out").code, 0);
}

TEST_F(MonteCarlo, ARunThatFailsIsARowAndTheOthersGoOn) {
    // A step far beyond the limit breaks the runs of one of the cases.
    place_.write("c.toml", config_ + "'time.step' = ['auto', 0.0010000001]\n");
    const Outcome outcome = run("out", {"--set", "montecarlo.realizations=2"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string results = table("out");
    EXPECT_THAT(results, HasSubstr("cov=0.4 step=auto,1,1,done,"));
    EXPECT_THAT(results, HasSubstr("cov=0.4 step=0.0010000001,1,1,failed,,,,,,"));
    EXPECT_THAT(place_.read("out/failures.csv"), HasSubstr("cov=0.4 step=0.0010000001,1,\""));
    // Its name is wider than the column of names: a gap stays, and the others keep in line.
    EXPECT_THAT(outcome.out, HasSubstr("cov=0.4 step=auto          2 of 2 done"));
    EXPECT_THAT(outcome.out, HasSubstr("step=0.0010000001  0 of 2 done, 2 failed"));
}

TEST_F(MonteCarlo, DamagedPackingsAndStartsAreMadeAgain) {
    place_.write("c.toml",
                 "field.variable = 'stiffness'\n[triaxial]\nmax_axial_strain = 0.001\n"
                 "strain_rate = 1\n");
    const auto run = [&](const std::string& out, const std::string& realizations) {
        std::vector<std::string> all{"montecarlo", place_.path("c.toml"), "--out",
                                     place_.path(out)};
        all.insert(all.end(), small_packing.begin(), small_packing.end());
        all.insert(all.end(), {"--set", "montecarlo.realizations=" + realizations});
        return place_.run(all);
    };
    ASSERT_EQ(run("whole", "2").code, 0);
    ASSERT_EQ(run("out", "1").code, 0);
    for (const char* folder : {"packings", "starts"})
        for (const auto& entry :
             std::filesystem::directory_iterator(place_.path(std::string("out/") + folder)))
            if (entry.path().extension() == ".h5")
                std::filesystem::resize_file(entry.path(),
                                             std::filesystem::file_size(entry.path()) / 2);
    const Outcome again = run("out", "2");
    ASSERT_EQ(again.code, 0) << again.err;
    const auto first = again.err.find("it is made again");
    EXPECT_NE(again.err.find("it is made again", first + 1), std::string::npos) << again.err;
    EXPECT_EQ(table("out"), table("whole"));
}

TEST_F(MonteCarlo, ThreadsThatCannotBeCreatedEndIt) {
    const std::string log = place_.path("log.txt");
    const auto begin = std::chrono::steady_clock::now();
    // Each thread wants 8 MB of addresses for its stack.
    EXPECT_EQ(
        place_.run_in_shell(words("out", {"--set", "montecarlo.realizations=1000", "--abreast",
                                          "1000", "--threads", "1"}),
                            ">/dev/null 2>'" + log + "'", "ulimit -s 8192; ulimit -v 4000000"),
        2);
    EXPECT_THAT(place_.read("log.txt"), HasSubstr("threads cannot be created"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST_F(MonteCarlo, BadUseIsRefused) {
    for (const char* shard : {"0/3", "4/3", "1", "a/b", "1/3/5", "-1/2"}) {
        const Outcome outcome = run("out", {"--shard", shard});
        EXPECT_EQ(outcome.code, 2) << shard;
        EXPECT_THAT(outcome.err, HasSubstr("--shard"));
    }
    EXPECT_FALSE(place_.has("out"));
    EXPECT_EQ(run("out", {"--merge", place_.path("nowhere")}).code, 4);
    ASSERT_EQ(run("out", {"--set", "montecarlo.realizations=1"}).code, 0);
    const Outcome other = run("out", {"--set", "particle.density=2500"});
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.err, HasSubstr("density"));
}

}  // namespace
}  // namespace grainfield::program_tests
