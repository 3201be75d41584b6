// The grid of a random field, and its trend over height, are those of the sample that is sheared.

#include <gtest/gtest.h>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

// Nearly the mean alone: 9e8 Pa at mid-height, softer by 1e8 Pa with every metre up.
const std::vector<std::string> trend{"field.variable=\"stiffness\"", "field.stiffness.cov=1e-6",
                                     "field.stiffness.mean_gradient=-1e8"};

class FieldGrid : public testing::Test {
  protected:
    Outcome shear_with_trend(const std::string& file, std::vector<std::string> settings = {}) {
        settings.insert(settings.end(), trend.begin(), trend.end());
        return shear(place_, file, settings, "0.0005");
    }
    /// Mean stiffness of the spheres in the lower and the upper half of the final state [Pa].
    void expect_halves(double lower, double upper) {
        const core::ParticleStore s = core::read_spheres(place_.path("run/state.h5")).spheres;
        const double middle = core::bounding_box(s).lower.y() + 0.247;
        double sum[2] = {0, 0}, count[2] = {0, 0};
        for (std::size_t i = 0; i < s.size(); ++i) {
            const int half = s.position.y[i] < middle ? 0 : 1;
            sum[half] += s.normal_stiffness[i];
            ++count[half];
        }
        // Some spheres have crossed the middle since their cell was found: 0.1 % at most.
        EXPECT_NEAR(sum[0] / count[0], lower, 2e-3 * lower);
        EXPECT_NEAR(sum[1] / count[1], upper, 2e-3 * upper);
    }

    Workplace place_;
};

// With the default grid of 6 x 12 x 6 blocks the means once were 1.0375e9 and 1.0125e9 Pa.
TEST_F(FieldGrid, WithoutAWordOnBlocksIsThatOfTheSample) {
    const core::ParticleStore& s = packing().spheres;
    std::string plain = "x,y,z,radius\n", moved = plain;
    for (std::size_t i = 0; i < s.size(); ++i)
        for (const auto& [text, x, y] :
             {std::tuple{&plain, 0.0, 0.0}, std::tuple{&moved, 10., -3.}})
            *text += std::to_string(s.position.x[i] + x) + "," +
                     std::to_string(s.position.y[i] + y) + "," + std::to_string(s.position.z[i]) +
                     "," + std::to_string(s.radius[i]) + "\n";
    for (const auto& [name, text] :
         {std::pair{"blocks.csv", csv_text()}, std::pair{"plain.csv", plain},
          std::pair{"moved.csv", moved}, std::pair{"P.data", lammps_text({.lid = 0.7})}}) {
        SCOPED_TRACE(name);
        const Outcome outcome = shear_with_trend(place_.write(name, text));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        expect_halves(9.125e8, 8.875e8);
    }
}

// Cells of 0.125 m: rows at 0.1875 and 0.0625 m from the middle, whose spheres are not as many.
TEST_F(FieldGrid, ThatIsGivenAndFitsIsTaken) {
    const std::string file = place_.write("P.data", lammps_text({}));
    const Outcome outcome =
        shear_with_trend(file, {"packing.blocks=[2,4,2]", "packing.block=[0.125,0.125,0.125]"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_halves(9.137e8, 8.866e8);
}

TEST_F(FieldGrid, ThatIsGivenAndDoesNotFitIsRefused) {
    const std::string file = place_.write("P.data", lammps_text({}));
    for (const std::vector<std::string>& setting : std::vector<std::vector<std::string>>{
             {"packing.blocks=[6,12,6]"},
             {"packing.blocks=[2,4,2]"},
             {"packing.blocks=[1,1,1]"},
             {"packing.block=[0.5,0.5,0.5]"},
             {"packing.blocks=[2,4,2]", "packing.block=[0.1,0.1,0.1]"}}) {
        const Outcome outcome = shear_with_trend(file, setting);
        EXPECT_EQ(outcome.code, 2) << setting[0];
        EXPECT_TRUE(has(outcome.err, "which measures 0.25")) << outcome.err;
    }
    // Blocks that the spheres know.
    const Outcome known =
        shear_with_trend(place_.write("P.csv", csv_text()), {"packing.blocks=[2,2,1]"});
    EXPECT_EQ(known.code, 2);
    EXPECT_TRUE(has(known.err, "in 1 x 2 x 1 blocks")) << known.err;
}

}  // namespace
}  // namespace grainfield::case_tests
