// curve.csv: what is read and what is refused, by line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/report/run_fixture.hpp"
#include "triaxial/report/curve_file.hpp"

namespace grainfield::triaxial::report {
namespace {

using testing::HasSubstr;

const std::string header =
    "axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,lateral_stress_z_Pa,"
    "volumetric_strain,unbalanced_force_ratio,time_s,contacts\n";
const std::string row = "0.001,5e4,150e3,101e3,99e3,0.0001,0.01,0.01,1000\n";

std::string refusal(const std::string& text) {
    const fixture::TestFolder folder;
    fixture::write_file(folder.path() / "curve.csv", text);
    try {
        read_curve(folder.path() / "curve.csv");
    } catch (const FileError& e) {
        return e.what();
    }
    return "nothing was thrown";
}

TEST(CurveFile, ReadsEveryColumn) {
    const fixture::TestFolder folder;
    fixture::write_file(folder.path() / "curve.csv", header + row + row);
    const Curve curve = read_curve(folder.path() / "curve.csv");
    ASSERT_EQ(curve.size(), 2U);
    EXPECT_EQ(curve.axial_strain[1], 0.001);
    EXPECT_EQ(curve.deviator_stress[1], 5e4);
    EXPECT_EQ(curve.axial_stress[1], 150e3);
    EXPECT_EQ(curve.lateral_stress_x[1], 101e3);
    EXPECT_EQ(curve.lateral_stress_z[1], 99e3);
    EXPECT_EQ(curve.volumetric_strain[1], 0.0001);
    EXPECT_EQ(curve.unbalanced_force_ratio[1], 0.01);
    EXPECT_EQ(curve.time[1], 0.01);
    EXPECT_EQ(curve.contacts[1], 1000);
}

TEST(CurveFile, NamesTheLineOfWhatIsWrong) {
    EXPECT_THAT(refusal(""), HasSubstr("curve.csv:1: the header must be"));
    EXPECT_THAT(refusal("strain,stress\n"), HasSubstr("curve.csv:1: the header must be"));
    EXPECT_THAT(refusal(header + row + "0.002,six,1,1,1,1,1,1,1\n"),
                HasSubstr("curve.csv:3: 'six' is not a finite number"));
    EXPECT_THAT(refusal(header + row + row + "0.002,nan,1,1,1,1,1,1,1\n"),
                HasSubstr("curve.csv:4: 'nan' is not a finite number"));
    EXPECT_THAT(refusal(header + "0.1,1,1\n"), HasSubstr("curve.csv:2: 3 cells, must be 9"));
    EXPECT_THAT(refusal(header + "1,1,1,1,1,1,1,1,1,1\n"),
                HasSubstr("curve.csv:2: more than 9 cells"));
    EXPECT_THAT(refusal(header + row), HasSubstr("1 rows, must be two at least"));
}

TEST(CurveFile, ServoErrorIsThatOfBothWallPairs) {
    Curve curve;
    curve.axial_strain = {0.0, 0.002};
    curve.lateral_stress_x = {103e3, 101e3};
    curve.lateral_stress_z = {100e3, 98e3};
    const ServoError error = servo_error(curve, 100e3);
    EXPECT_DOUBLE_EQ(error.rms, std::sqrt((9e-4 + 1e-4 + 4e-4) / 4));
    ASSERT_TRUE(error.max);
    EXPECT_NEAR(*error.max, 0.02, 1e-15);  // the 3 % come before 0.1 % of strain
    curve.axial_strain = {0.0, 0.0009};
    EXPECT_FALSE(servo_error(curve, 100e3).max);
}

}  // namespace
}  // namespace grainfield::triaxial::report
