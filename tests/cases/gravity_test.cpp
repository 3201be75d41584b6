// Gravity in the test: the bottom wall stands and carries the confining stress and the weight.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/files/sphere_file.hpp"
#include "tests/cases/sample.hpp"
#include "triaxial/report/curve_file.hpp"

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

// Half the weight once stood in the deviator stress from the first point on: at 10 kPa E50 was
// 30 MPa instead of 14 (0.02/s to 1 % of strain).
TEST(GravityInTheTest, WeightIsNoStrength) {
    const Workplace place;
    const std::string packing = place.write("P.data", lammps_text({}));
    double first[2], peak[2], E50[2];
    for (int k : {0, 1}) {
        const Outcome outcome =
            shear(place, packing,
                  {"triaxial.confining_stress=10e3", "triaxial.strain_rate=0.02",
                   k == 0 ? "triaxial.gravity=0" : "triaxial.gravity=9.81"},
                  "0.01");
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const nlohmann::json summary = place.json("run/summary.json");
        peak[k] = summary.at("peak_deviator_stress_Pa");
        E50[k] = summary.at("E50_Pa");
        first[k] = triaxial::report::read_curve(place.path("run/curve.csv")).deviator_stress[1];
    }
    EXPECT_LT(std::abs(first[1]), 1.2e3);  // half the weight: 3.8 kPa
    EXPECT_NEAR(peak[1], peak[0], 0.3 * peak[0]);
    EXPECT_NEAR(E50[1], E50[0], 0.4 * E50[0]);
}

}  // namespace
}  // namespace grainfield::case_tests
