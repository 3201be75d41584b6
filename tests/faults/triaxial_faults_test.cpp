// `triaxial` with something wrong at every call that writes its results, and at a spread of those
// of its checkpoints: files are whole or not there, and --resume ends with those of an undisturbed
// run.

#include <gtest/gtest.h>

#include "tests/faults/small_sample.hpp"

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;

SmallRun small_test() {
    return {"triaxial",
            "run",
            {"--set", "triaxial.max_axial_strain=0.001", "--set", "triaxial.strain_rate=1"}};
}

/// Every file that is there is whole. Wall times differ from run to run.
void expect_whole_files(const Workplace& place) {
    for (const std::string name :
         {"curve.csv", "energy.csv", "state.h5", "config.toml", "packing.h5"})
        if (place.has("run/" + name)) {
            EXPECT_TRUE(place.read("run/" + name) == place.read("whole/" + name)) << name;
        }
    for (const std::string name : {"summary.json", "packing.json"})
        if (place.has("run/" + name)) {
            EXPECT_EQ(place.json("run/" + name).at("state_hash"),
                      place.json("whole/" + name).at("state_hash"));
        }
    if (place.has("run/report.html")) {
        EXPECT_TRUE(place.read("run/report.html").ends_with("</html>\n"));
    }
}

/// `--resume` of what the run was killed with, with a fault at each of these calls; then without.
void resume_with_faults(const SmallRun& test, const std::vector<Call>& calls, Tally& tally) {
    const Workplace& place = test.place;
    std::vector<std::string> whole;
    for (const auto& entry : fs::directory_iterator(place.path("whole")))
        whole.push_back(entry.path().filename());
    for (const std::string& kind : fault_kinds)
        for (const Call& call : calls) {
            const Fault fault{call.number, kind};
            if (!applies(kind, call)) continue;
            SCOPED_TRACE(in_words(fault, call));
            const FaultyRun run = test.resume(fault);
            tally.ended(fault, run.outcome, place.path("run"));
            expect_whole_files(place);
            if (run.outcome.code != 0) {
                test.resume_in_peace();
                tally.resumed();
                expect_whole_files(place);
            }
            for (const std::string& name : whole) EXPECT_TRUE(place.has("run/" + name)) << name;
            for (const std::string& other : others_in(place, "run", whole)) {
                // A finished run whose checkpoints cannot be removed is finished all the same.
                EXPECT_TRUE(run.outcome.code == 0 ? other.starts_with("checkpoint.")
                                                  : other.starts_with(".grainfield-"))
                    << other;
            }
            if (testing::Test::HasFailure()) return;
        }
}

TEST(TriaxialFaults, AtEveryCallForItsResults) {
    const SmallRun test = small_test();
    const auto& calls = test.undisturbed.calls;
    test.kill_at(first_call(
        calls, [](const Call& c) { return c.on_temporary(); }, last_save(calls)));
    const FaultyRun good = test.resume();
    ASSERT_EQ(good.outcome.code, 0) << good.outcome.err;
    std::vector<Call> results;  // saves before them are for the test below
    for (const Call& call : good.calls)
        if (call.number > last_save(good.calls)) results.push_back(call);
    Tally tally("triaxial --resume, results", static_cast<int>(results.size()));
    resume_with_faults(test, results, tally);
}

TEST(TriaxialFaults, AtASpreadOfCallsFromThePackingOn) {
    const SmallRun test = small_test();
    test.kill_at(
        first_call(test.undisturbed.calls, [](const Call& c) { return c.on_temporary(); }));
    const FaultyRun good = test.resume();
    ASSERT_EQ(good.outcome.code, 0) << good.outcome.err;
    // All that writes the packing's files, and the two saves after them; then one call in 97, which
    // has no divisor in common with the calls of a save: they all get their turn.
    const auto saved = [](const Call& c) { return c.is("rename", "/checkpoint.bin"); };
    const int packed =
        first_call(good.calls, [](const Call& c) { return c.is("rename", "/packing.json"); });
    const int second = first_call(good.calls, saved, first_call(good.calls, saved, packed) + 1);
    std::vector<Call> chosen;
    for (const Call& call : good.calls)
        if (call.number <= second + 3 || call.number % 97 == 0) chosen.push_back(call);
    Tally tally("triaxial --resume from the packing on (" + std::to_string(chosen.size()) +
                    " calls chosen)",
                static_cast<int>(good.calls.size()));
    resume_with_faults(test, chosen, tally);
}

// Of a packing that is given, what is known of it follows into the run's folder, and stays there.
TEST(TriaxialFaults, KilledAfterItKeptThePackingsJson) {
    const Workplace place;
    std::vector<std::string> words{"pack", "--out", place.path("P.h5")};
    words.insert(words.end(), small_packing.begin(), small_packing.end());
    ASSERT_EQ(place.run(words).code, 0);
    const std::vector<std::string> test{"triaxial",
                                        "--packing",
                                        place.path("P.h5"),
                                        "--out",
                                        place.path("run"),
                                        "--set",
                                        "triaxial.max_axial_strain=0.0005",
                                        "--set",
                                        "triaxial.strain_rate=1",
                                        "--checkpoint-every",
                                        "1e-9"};
    fs::create_directory(place.path("run"));
    const FaultyRun whole = run_with_fault(place, "run", test);
    ASSERT_EQ(whole.outcome.code, 0) << whole.outcome.err;
    const int kept =
        first_call(whole.calls, [](const Call& c) { return c.is("rename", "/packing.json"); });
    const int next = first_call(
        whole.calls, [](const Call& c) { return applies("kill", c); }, kept + 1);
    fs::remove_all(place.path("run"));
    fs::create_directory(place.path("run"));
    ASSERT_EQ(run_with_fault(place, "run", test, {next, "kill"}).outcome.code, 128 + SIGKILL);
    const Outcome resumed = place.run(with(test, "--resume"));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    ASSERT_TRUE(place.has("run/packing.json"));
    EXPECT_EQ(place.read("run/packing.json"), place.read("P.json"));
}

}  // namespace
}  // namespace grainfield::program_tests
