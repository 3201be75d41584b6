// Whatever the program is at, it hears a signal soon; those that only concern one write end
// nothing.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>

#include "tests/program/program.hpp"
#include "tests/report/run_fixture.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

/// A run that gets a signal half a second after `ready`, and how long it took to end then.
struct Heard {
    Outcome outcome;
    double seconds = 0;
};
Heard signalled(
    const Workplace& place, const std::vector<std::string>& words, int signal,
    const std::function<bool()>& ready = [] { return true; }) {
    std::optional<Clock::time_point> since;
    Clock::time_point sent;
    const auto when = [&] {
        if (!since && ready()) since = Clock::now();
        sent = Clock::now();
        return since && sent - *since > std::chrono::milliseconds(500);
    };
    Heard heard;
    std::optional<Clock::time_point> last;
    heard.outcome = place.run(words, SignalAfter{signal, [&] {
                                                     const bool now = when();
                                                     if (now) last = Clock::now();
                                                     return now;
                                                 }});
    EXPECT_TRUE(last.has_value()) << "it ended before: " << heard.outcome.err;
    if (last) heard.seconds = std::chrono::duration<double>(Clock::now() - *last).count();
    return heard;
}

constexpr double soon = 2;  // [s]

TEST(Signals, AreHeardWhilePlacingManySpheres) {
    const Workplace place;
    const Heard heard = signalled(
        place,
        {"pack", "--threads", "1", "--out", place.path("P.h5"), "--set", "packing.blocks=[1,1,1]",
         "--set", "packing.spheres=200000", "--set", "packing.porosity=0.5"},
        SIGTERM);
    EXPECT_EQ(heard.outcome.code, 130) << heard.outcome.err;
    EXPECT_LT(heard.seconds, soon);
}

TEST(Signals, AreHeardWhileALargeCampaignIsPlanned) {
    const Workplace place;
    const Heard heard = signalled(place,
                                  {"montecarlo",
                                   place.write("c.toml",
                                               "[field]\nvariable = 'stiffness'\n[montecarlo]\n"
                                               "realizations = 9000000\n"),
                                   "--out", place.path("out")},
                                  SIGHUP);
    EXPECT_EQ(heard.outcome.code, 130) << heard.outcome.err;
    EXPECT_LT(heard.seconds, soon);
    const Outcome more = place.run({"montecarlo", place.path("c.toml"), "--out", place.path("b"),
                                    "--set", "montecarlo.realizations=2000000000"});
    EXPECT_EQ(more.code, 2);
    EXPECT_THAT(more.err, HasSubstr("at most 10000000 are allowed"));
}

TEST(Signals, AreHeardWhileGnuplotHangs) {
    const Workplace place;
    triaxial::fixture::write_run(place.path("run"), {});
    std::filesystem::create_directory(place.path("bin"));
    const std::string script = place.write(
        "bin/gnuplot", "#!/bin/sh\necho $$ >'" + place.path("started") + "'\nexec sleep 600\n");
    ::chmod(script.c_str(), 0755);
    std::filesystem::create_directory(place.path("tmp"));
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", (place.path("bin") + ":" + path).c_str(), 1);
    ::setenv("TMPDIR", place.path("tmp").c_str(), 1);
    const Heard heard = signalled(place, {"report", place.path("run")}, SIGINT,
                                  [&] { return place.has("started"); });
    ::setenv("PATH", path.c_str(), 1);
    ::unsetenv("TMPDIR");
    EXPECT_EQ(heard.outcome.code, 130) << heard.outcome.err;
    EXPECT_LT(heard.seconds, soon);
    EXPECT_FALSE(holds_a_file(place.path("tmp"))) << "its temporary folder is left";
    EXPECT_FALSE(
        std::filesystem::exists("/proc/" + std::to_string(std::stoi(place.read("started")))))
        << "gnuplot goes on";
}

TEST(Signals, NohupIsRespected) {
    const Workplace place;
    place.write("spheres.csv", "x,y,z,radius\n0,0.1,0,0.1\n");
    place.write("scene.toml", scene_head + "[time]\nstep = 1e-5\nend = 1e-3\n");
    const std::vector<std::string> words{"simulate", place.path("scene.toml"), "--out",
                                         place.path("run")};
    EXPECT_EQ(place.run_in_shell(words, ">/dev/null 2>&1 & kill -HUP $!; wait $!; exit $?",
                                 "trap '' HUP"),
              0);
}

}  // namespace
}  // namespace grainfield::program_tests
