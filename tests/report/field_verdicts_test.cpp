// The words of a verification: what is wrong is called OUTSIDE by the check that is about it.

#include "triaxial/report/field/field_verdicts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace grainfield::triaxial::report {
namespace {

using randomfield::BlockField;
using randomfield::FieldGenerator;
using randomfield::FieldOptions;
using testing::ElementsAre;
using testing::IsEmpty;

const randomfield::GridSpec grid{{3, 4, 2}, Vec3(0.25, 0.25, 0.25)};

/// The checks that are outside when fields of `drawn` are held against `expected`.
std::vector<std::string> outside(const FieldGenerator& expected, const FieldGenerator& drawn) {
    core::Monitor nobody;
    const auto verification =
        randomfield::verify(expected,
                            {[&](std::uint64_t k) { return drawn.draw_unconditional(k); },
                             [&](std::uint64_t k) { return drawn.draw(k); }},
                            1000, nobody);
    std::vector<std::string> checks;
    for (const Verdict& verdict : verdicts(expected, verification))
        if (!verdict.inside) checks.push_back(verdict.check);
    return checks;
}

FieldOptions paper() {
    FieldOptions options;
    options.variable = randomfield::Variable::both;
    options.correlation_length = Vec3(3.0, 0.3, 3.0);
    options.cross_correlation = 0.5;
    options.seed = 2;
    return options;
}

TEST(FieldVerdicts, NameWhatIsWrong) {
    const FieldGenerator right(grid, paper());
    EXPECT_THAT(outside(right, right), IsEmpty());

    FieldOptions wrong = paper();
    wrong.cross_correlation = 0.4;
    EXPECT_THAT(outside(right, FieldGenerator(grid, wrong)), ElementsAre("cross-correlation"));

    wrong = paper();
    wrong.correlation_length = Vec3(5.0, 0.5, 5.0);
    EXPECT_THAT(
        outside(right, FieldGenerator(grid, wrong)),
        testing::IsSupersetOf({"correlation, friction angle", "correlation, normal stiffness"}));

    wrong = paper();
    wrong.friction.s = 2.4;
    EXPECT_THAT(outside(right, FieldGenerator(grid, wrong)),
                ElementsAre("histogram, friction angle", "deviation, friction angle"));

    wrong = paper();
    wrong.stiffness.mean *= 1.08;
    EXPECT_THAT(outside(right, FieldGenerator(grid, wrong)),
                testing::IsSupersetOf({"mean, normal stiffness"}));
}

TEST(FieldVerdicts, NameDataThatAreNotHonoured) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("grainfield_verdicts_" + std::to_string(getpid()) + ".csv");
    const auto with = [&](const char* value) {
        std::ofstream(file) << "x,y,z,property,value,error\n0.1,0.1,0.1,friction_angle," << value
                            << ",0\n";
        FieldOptions options = paper();
        options.data = file.string();
        return FieldGenerator(grid, options);
    };
    const FieldGenerator right = with("0.7"), wrong = with("0.70001");
    std::filesystem::remove(file);
    EXPECT_THAT(outside(right, right), IsEmpty());
    EXPECT_THAT(outside(right, wrong), ElementsAre("data, friction angle"));
}

}  // namespace
}  // namespace grainfield::triaxial::report
