// Gravity in the test: the bottom wall stands and carries the confining stress and the weight.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/files/sphere_file.hpp"
#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

double weight() {
    double volume = 0;
    for (const double r : packing().spheres.radius) volume += 4 * std::numbers::pi / 3 * r * r * r;
    return 9.81 * 2600 * volume;
}

// Six servo walls once let the sample fall for 200,001 steps.
TEST(GravityInTheTest, BottomStandsAndTheTestRuns) {
    const Workplace place;
    const Outcome outcome =
        shear(place, place.write("P.data", lammps_text({})), {"triaxial.gravity=9.81"}, "0.03");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json summary = place.json("run/summary.json");
    // 100 kPa on 0.25 m x 0.25 m are 6,250 N, the weight is 480 N: its mean stress adds 4 % at
    // most.
    EXPECT_NEAR(summary.at("peak_deviator_stress_Pa").get<double>(), 135.4e3, 10e3);
    EXPECT_NEAR(weight(), 480, 10);
    const core::SphereFile state = core::read_spheres(place.path("run/state.h5"));
    ASSERT_TRUE(state.box.has_value());
    // Walls start at the spheres.
    double bottom = 1;
    for (std::size_t i = 0; i < packing().spheres.size(); ++i)
        bottom = std::min(bottom, packing().spheres.position.y[i] - packing().spheres.radius[i]);
    EXPECT_NEAR(state.box->lower[1], bottom, 1e-7);  // digits of the file
}

}  // namespace
}  // namespace grainfield::case_tests
