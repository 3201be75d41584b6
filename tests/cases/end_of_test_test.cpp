// When a test is over: a loose sample falls and recovers, so that a dip is not its end.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

/// "auto" gives the largest deviator stress that there is up to 15 % of strain [kPa].
double peak_of_whole_test(const std::vector<std::string>& settings) {
    const Workplace place;
    const std::string file = place.write("P.csv", csv_text());
    const auto peak = [&](const std::string& strain) {
        const Outcome outcome = shear(place, file, settings, strain);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return place.json("run/summary.json").at("peak_deviator_stress_Pa").get<double>() / 1e3;
    };
    const double found = peak("\"auto\"");
    // At the limit it has seen all that there is.
    if (place.json("run/summary.json").at("end_reason") == "strain-limit") return found;
    EXPECT_NEAR(peak("0.15"), found, 0.02 * found) << "the curve goes on above what was reported";
    return found;
}

// Once reported as 120.7 kPa at 0.7 %. Another instruction set gives another curve: the peak of
// this sample scatters by 3 %.
TEST(EndOfATest, IsNotADipThatPasses) {
    EXPECT_NEAR(peak_of_whole_test({}), 135.4, 0.05 * 135.4);
}

// Once 100.7 kPa. The strain at the peak is that of soft contacts: 7 to 14 %.
TEST(EndOfATest, OfSoftSpheresIsFarOut) {
    EXPECT_NEAR(peak_of_whole_test({"particle.normal_stiffness=3e7"}), 137.0, 0.05 * 137.0);
}

TEST(EndOfATest, OfATestAtAnotherStressIsNoneEither) {
    EXPECT_NEAR(peak_of_whole_test({"triaxial.confining_stress=50e3"}), 67, 7);
}

}  // namespace
}  // namespace grainfield::case_tests
