// A fixed time step above the stability limit: the run says so, and what the limit is.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

const std::string above = "is above the stability limit 2/omega_max of ";

/// A sphere of radius 0.1 m on a slope, undamped.
std::string slope(double step) {
    return program_tests::scene_head +
           fmt::format(
               "[particle]\ndensity = 2600\nstiffness_ratio = 0.5\n"
               "[gravity]\nacceleration = [5, -8.66, 0]\n[time]\nend = 0.5\nstep = {}\n"
               "[output]\ninterval = 0.1\n"
               "[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nfriction_angle = 0.6\n"
               "normal_stiffness = 1e7\n",
               step);
}
const std::string resting =
    "x,y,z,radius,normal_stiffness,friction_angle\n0,0.0999999,0,0.1,1e7,0.3\n";

// Sliding and rolling go together: omega^2 = 3.5 K_s/m, above K_n/m at K_s = K_n/2.
double limit_on_slope() {
    const double stiffness = 0.1 * 1e7 / 2, mass = 2600 * core::sphere_volume(0.1);
    return 2 / std::sqrt(3.5 * 0.5 * stiffness / mass);
}

// It once ended with 0 and an energy that grew.
TEST(FixedStep, AboveTheLimitIsNamedWithIt) {
    const double limit = limit_on_slope();
    const Workplace place;
    for (const double share : {0.3, 0.98, 1.02, 1.4}) {
        const Outcome outcome = place.simulate(resting, slope(share * limit), {"--threads", "1"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const nlohmann::json warnings = place.json("run/summary.json").at("warnings");
        EXPECT_EQ(warnings.empty(), share < 1) << share;
        EXPECT_EQ(has(outcome.out, above + fmt::format("{:.4g} s", limit)), share > 1)
            << outcome.out;
    }
}

TEST(FixedStep, ThatBlowsUpIsNamedInTheError) {
    const Workplace place;
    const Outcome outcome = place.simulate(resting, slope(0.05), {"--threads", "1"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(has(outcome.err, above)) << outcome.err;
}

// Contacts that last for a step or two, between the looks at the contacts that there are.
TEST(FixedStep, TooLongForAContactThatIsShortIsNamed) {
    const Workplace place;
    const std::string pair = "x,y,z,radius,vx,vy,vz\n0,0,0,0.1,1,0,0\n0.21,0,0,0.1,-1,0,0\n";
    const auto time = [](const char* step) {
        return program_tests::scene_head + "[time]\nend = 0.1\nstep = " + step + "\n";
    };
    ASSERT_EQ(place.simulate(pair, time("2e-3"), {"--threads", "1"}).code, 0);
    const nlohmann::json warnings = place.json("run/summary.json").at("warnings");
    ASSERT_EQ(warnings.size(), 2u) << warnings;
    EXPECT_TRUE(has(warnings[0], above)) << warnings;
    EXPECT_TRUE(has(warnings[1], "the energies close only to")) << warnings;
    ASSERT_EQ(place.simulate(pair, time("1e-4"), {"--threads", "1"}).code, 0);
    EXPECT_TRUE(place.json("run/summary.json").at("warnings").empty());
    // A drop, with nothing in touch at the start.
    const Outcome drop =
        place.simulate("x,y,z,radius\n0,0.5,0,0.1\n",
                       program_tests::scene_head + program_tests::falling +
                           program_tests::floor_wall + "[time]\nend = 1\nstep = 5e-3\n",
                       {"--threads", "1"});
    EXPECT_EQ(drop.code, 3);
    EXPECT_TRUE(has(drop.err, above)) << drop.err;
}

TEST(FixedStep, OfATestAboveTheLimitIsNamed) {
    const Workplace place;
    const std::string file = place.write("P.data", lammps_text({}));
    EXPECT_EQ(shear(place, file, {"time.step=3e-5"}).code, 0);
    const Outcome wild = shear(place, file, {"time.step=1e-4"});
    EXPECT_EQ(wild.code, 3);
    EXPECT_TRUE(has(wild.err, above)) << wild.err;
    // Just above the limit of the end, 45 us: the curve looks sound.
    const Outcome close = shear(place, file, {"time.step=4.8e-5"});
    EXPECT_TRUE(has(close.out + close.err, above)) << close.out << close.err;
}

}  // namespace
}  // namespace grainfield::case_tests
