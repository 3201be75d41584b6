// `pack --out P.h5` over a packing of that name, with something wrong at every call that writes its
// results: P.h5 is the old one byte for byte, or the new one, whole; --resume makes it the new one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/faults/small_sample.hpp"

namespace grainfield::program_tests {
namespace {

using testing::AnyOf;
using testing::Eq;

TEST(PackFaults, APackingIsTheOldOneOrTheNewOne) {
    const SmallRun pack("pack", "run/P.h5");
    const Workplace& place = pack.place;
    const auto& calls = pack.undisturbed.calls;
    pack.kill_at(first_call(
        calls, [](const Call& c) { return c.on_temporary(); }, last_save(calls)));
    place.write("killed/P.h5", "an old packing");
    place.write("killed/P.json", "{\"state_hash\": \"old\"}");
    const std::string whole = place.read("whole/P.h5");
    const std::string hash = place.json("whole/P.json").at("state_hash");
    const FaultyRun good = pack.resume();
    ASSERT_EQ(good.outcome.code, 0) << good.outcome.err;

    Tally tally("pack --resume", static_cast<int>(good.calls.size()));
    for (const std::string& kind : fault_kinds)
        for (const Call& call : good.calls) {
            const Fault fault{call.number, kind};
            if (!applies(kind, call)) continue;
            SCOPED_TRACE(in_words(fault, call));
            const FaultyRun run = pack.resume(fault);
            tally.ended(fault, run.outcome, place.path("run"));
            EXPECT_THAT(place.read("run/P.h5"), AnyOf(Eq("an old packing"), Eq(whole)));
            EXPECT_THAT(place.json("run/P.json").at("state_hash").get<std::string>(),
                        AnyOf("old", hash));
            if (run.outcome.code != 0) {
                pack.resume_in_peace();
                tally.resumed();
            }
            EXPECT_TRUE(place.read("run/P.h5") == whole);
            EXPECT_EQ(place.json("run/P.json").at("state_hash"), hash);
            if (testing::Test::HasFailure()) return;
        }
}

}  // namespace
}  // namespace grainfield::program_tests
