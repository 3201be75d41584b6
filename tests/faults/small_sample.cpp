#include "tests/faults/small_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;

// As often as the program looks at the clock: 16 steps.
const std::vector<std::string> often{"--checkpoint-every", "1e-9"};

/// A gnuplot that draws nothing, in no time: what the figures show is not the matter here.
void stand_in_for_gnuplot(const Workplace& place) {
    fs::create_directory(place.path("bin"));
    const std::string script =
        place.write("bin/gnuplot",
                    "#!/bin/sh\nfor script; do :; done\necho '<svg></svg>' >${script%.gp}.out\n");
    ::chmod(script.c_str(), 0755);
    static const std::string path = std::getenv("PATH");
    ::setenv("PATH", (place.path("bin") + ":" + path).c_str(), 1);
}

}  // namespace

SmallRun::SmallRun(const std::string& subcommand, const std::string& target,
                   const std::vector<std::string>& more)
    : command_{subcommand, "--out", place.path(target)} {
    for (const auto* words : {&small_packing, &often, &more})
        command_.insert(command_.end(), words->begin(), words->end());
    stand_in_for_gnuplot(place);
    fs::create_directory(place.path("run"));
    undisturbed = run_with_fault(place, "run", command_);
    EXPECT_EQ(undisturbed.outcome.code, 0) << undisturbed.outcome.err;
    fs::rename(place.path("run"), place.path("whole"));
}

void SmallRun::kill_at(int call) const {
    fs::remove_all(place.path("run"));
    fs::create_directory(place.path("run"));
    const FaultyRun run = run_with_fault(place, "run", command_, {call, "kill"});
    ASSERT_EQ(run.outcome.code, 128 + SIGKILL) << run.outcome.err;
    copy_folder(place, "run", "killed");
}

FaultyRun SmallRun::resume(const Fault& fault) const {
    copy_folder(place, "killed", "run");
    return run_with_fault(place, "run", with(command_, "--resume"), fault);
}

void SmallRun::resume_in_peace() const {
    const Outcome resumed = place.run(with(command_, "--resume"));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, testing::HasSubstr("goes on from"));
}

int last_save(const std::vector<Call>& calls) {
    int last = 0;
    for (const Call& call : calls)
        if (call.is("rename", "checkpoint.bin")) last = call.number;
    return last;
}

}  // namespace grainfield::program_tests
