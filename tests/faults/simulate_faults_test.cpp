// `simulate` with something wrong at every call on its files, one after the other: the run goes on,
// or ends with a message that names the file, or is killed; --resume then ends with the files of an
// undisturbed run.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/faults/faults.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> tables{"trajectory.csv", "energy.csv", "contacts.csv"};
const std::vector<std::string> results{"trajectory.csv", "energy.csv", "contacts.csv",
                                       "summary.json"};

/// Two towers of spheres of two sizes that fall on a floor; rows every fifth step.
class Towers {
  public:
    Towers() {
        std::string spheres = "x,y,z,radius,vx,vy,vz\n";
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 5; ++j)
                spheres += std::to_string(0.195 * i) + "," + std::to_string(0.0999 + 0.2 * j) +
                           ",0," + (j % 2 == 0 ? "0.1" : "0.099") + ",0,-0.1,0\n";
        place.write("spheres.csv", spheres);
        command = {"simulate",
                   place.write("scene.toml",
                               "[particles]\nfile = \"spheres.csv\"\n"
                               "[time]\nstep = 2e-5\nend = 1e-3\n"
                               "[gravity]\nacceleration = [0, -9.81, 0]\n"
                               "[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n"
                               "friction_angle = 0.3\n[output]\ninterval = 1e-4\n"),
                   "--out", place.path("run"), "--quiet", "--threads", "1",
                   // As often as the program looks at the clock: every 16 steps, three times.
                   "--checkpoint-every", "1e-9"};
        undisturbed = run_with_fault(place, "run", command);
        EXPECT_EQ(undisturbed.outcome.code, 0) << undisturbed.outcome.err;
        copy_folder(place, "run", "undisturbed");
        std::filesystem::remove_all(place.path("run"));
        EXPECT_EQ(saves_before(1000000), 3);
    }

    /// Checkpoints that stand before call `number`.
    std::ptrdiff_t saves_before(int number) const {
        return std::count_if(
            undisturbed.calls.begin(), undisturbed.calls.end(),
            [&](const Call& c) { return c.number < number && c.is("rename", "/checkpoint.bin"); });
    }

    /// Results that are there are those of the undisturbed run, whole.
    void expect_whole_results() const {
        for (const std::string& name : tables)
            if (place.has("run/" + name)) {
                EXPECT_EQ(place.read("run/" + name), place.read("undisturbed/" + name)) << name;
            }
        if (place.has("run/summary.json")) {
            EXPECT_EQ(place.json("run/summary.json").at("state_hash"),
                      place.json("undisturbed/summary.json").at("state_hash"));
        }
    }
    void expect_all_results() const {
        for (const std::string& name : results) EXPECT_TRUE(place.has("run/" + name)) << name;
        expect_whole_results();
    }

    /// After a run with a fault: what it left, and what --resume makes of that. `before` is the
    /// folder that it began with.
    void expect_recovery(const Fault& fault, const Outcome& outcome, bool has_checkpoint,
                         Tally& tally, const std::string& before = "") const {
        tally.ended(fault, outcome, place.path("run"));
        expect_whole_results();
        if (outcome.code == 0) {
            expect_all_results();
            return;
        }
        if (!kills(fault.kind)) {
            std::vector<std::string> allowed = results;
            for (const char* name : {"trajectory.csv.part", "energy.csv.part", "checkpoint.bin",
                                     "checkpoint.before.bin"})
                allowed.emplace_back(name);
            // What the killed run left, where this one could not even begin.
            for (const char* name : {"checkpoint.bin.new", "checkpoint.lock"})
                if (place.has(before + "/" + name)) allowed.emplace_back(name);
            if (place.has("run")) {
                EXPECT_THAT(others_in(place, "run", allowed), IsEmpty());
            }
        }
        std::vector<std::string> again = with(command, "--resume");
        again.erase(std::find(again.begin(), again.end(), "--quiet"));
        const Outcome resumed = place.run(again);
        ASSERT_EQ(resumed.code, 0) << resumed.err;
        tally.resumed();
        EXPECT_THAT(resumed.err, HasSubstr(has_checkpoint ? "goes on from" : "begins anew"));
        expect_all_results();
        for (const std::string& other : others_in(place, "run", results))
            EXPECT_TRUE(kills(fault.kind) && other.starts_with(".grainfield-")) << other;
    }

    /// Leaves in folder `name` what a run that is killed at this call leaves.
    void prepare(const std::string& name, int at) const {
        std::filesystem::remove_all(place.path("run"));
        const FaultyRun run = run_with_fault(place, "run", command, {at, "kill"});
        ASSERT_EQ(run.outcome.code, 128 + SIGKILL);
        copy_folder(place, "run", name);
    }

    Workplace place;
    std::vector<std::string> command;
    FaultyRun undisturbed;
};

TEST(SimulateFaults, AtEveryCall) {
    const Towers t;
    Tally tally("simulate", static_cast<int>(t.undisturbed.calls.size()));
    for (const std::string& kind : fault_kinds)
        for (const Call& call : t.undisturbed.calls) {
            const Fault fault{call.number, kind};
            if (!applies(kind, call)) continue;
            SCOPED_TRACE(in_words(fault, call));
            std::filesystem::remove_all(t.place.path("run"));
            const FaultyRun run = run_with_fault(t.place, "run", t.command, fault);
            // What was saved before the fault is not lost by it; a save after it may have been
            // good.
            const bool has_checkpoint = t.saves_before(call.number) > 0 ||
                                        t.place.has("run/checkpoint.bin") ||
                                        t.place.has("run/checkpoint.before.bin");
            t.expect_recovery(fault, run.outcome, has_checkpoint, tally);
            if (testing::Test::HasFailure()) return;
        }
}

/// Leaves it as one that was killed between two saves, in the midst of one, or between the names of
/// its results; the run that goes on from there meets a fault.
TEST(SimulateFaults, AtEveryCallOfARunThatResumes) {
    const Towers t;
    const auto& calls = t.undisturbed.calls;
    const int between = first_call(calls, [&](const Call& c) {
        return c.is("rename", "/checkpoint.bin") && t.saves_before(c.number) == 1;
    });
    const int midst = first_call(
        calls, [](const Call& c) { return c.is("write", "/checkpoint.bin.new"); }, between);
    const int named =
        first_call(calls, [](const Call& c) { return c.is("rename", "/energy.csv"); });
    const std::vector<std::string> again = with(t.command, "--resume");
    const std::pair<std::string, int> moments[] = {
        {"between saves", between}, {"in a save", midst + 1}, {"at its results", named}};
    for (const auto& [moment, killed_at] : moments) {
        t.prepare("prepared", killed_at);
        const FaultyRun whole = run_with_fault(t.place, "run", again);
        ASSERT_EQ(whole.outcome.code, 0) << whole.outcome.err;
        Tally tally("simulate --resume, killed " + moment, static_cast<int>(whole.calls.size()));
        for (const std::string& kind : fault_kinds)
            for (const Call& call : whole.calls) {
                const Fault fault{call.number, kind};
                if (!applies(kind, call)) continue;
                SCOPED_TRACE(in_words(fault, call));
                copy_folder(t.place, "prepared", "run");
                const FaultyRun run = run_with_fault(t.place, "run", again, fault);
                t.expect_recovery(fault, run.outcome, true, tally, "prepared");
                if (testing::Test::HasFailure()) return;
            }
    }
}

/// A table's rows that fsync() failed on are written once more before the next checkpoint counts:
/// the system has forgotten which of them never reached the disk.
TEST(SimulateFaults, RowsThatMayNotHaveReachedTheDiskAreWrittenAgain) {
    const Towers t;
    const auto writes = [](const FaultyRun& run) {
        return std::count_if(run.calls.begin(), run.calls.end(),
                             [](const Call& c) { return c.is("pwrite", "/trajectory.csv.part"); });
    };
    const int at = first_call(t.undisturbed.calls,
                              [](const Call& c) { return c.is("fsync", "/trajectory.csv.part"); });
    const FaultyRun run = run_with_fault(t.place, "run", t.command, {at, "eio"});
    EXPECT_EQ(run.outcome.code, 0) << run.outcome.err;
    EXPECT_EQ(writes(run), writes(t.undisturbed) + 1);
    t.expect_all_results();
}

/// Run after run is killed in a save: there is one unfinished checkpoint, not a heap of them.
TEST(SimulateFaults, UnfinishedCheckpointsDoNotHeapUp) {
    const Towers t;
    const int at = first_call(t.undisturbed.calls,
                              [](const Call& c) { return c.is("write", "/checkpoint.bin.new"); });
    for (int k = 0; k < 4; ++k) {
        const FaultyRun run = run_with_fault(t.place, "run", t.command, {at, "half_kill"});
        EXPECT_EQ(run.outcome.code, 128 + SIGKILL);
        EXPECT_THAT(others_in(t.place, "run",
                              {"trajectory.csv.part", "energy.csv.part", "checkpoint.lock"}),
                    testing::ElementsAre("checkpoint.bin.new"));
    }
    // One that needs no checkpoint of its own leaves none of the others' either.
    std::vector<std::string> command = t.command;
    command.back() = "0";
    EXPECT_EQ(t.place.run(command).code, 0);
    EXPECT_THAT(others_in(t.place, "run", results), IsEmpty());
    t.expect_all_results();
}

}  // namespace
}  // namespace grainfield::program_tests
