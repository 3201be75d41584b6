// Measured values: the file, what is refused of it, and fields that honour it.

#include "randomfield/conditioning/field_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/random.hpp"
#include "tests/larger.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;
constexpr const char* full = "x,y,z,property,value,error\n";

class FieldData : public testing::Test {
  protected:
    FieldData() { fs::create_directories(folder_); }
    ~FieldData() override { fs::remove_all(folder_); }

    /// Options of both properties (or one) with this file as their data.
    FieldOptions options(const std::string& text, Variable variable = Variable::both) const {
        std::ofstream(file_) << text;
        FieldOptions options;
        options.variable = variable;
        options.correlation_length = paper_theta(0.5);
        options.cross_correlation = 0.7;
        options.data = file_.string();
        return options;
    }
    std::string refusal(const std::string& text, Variable variable = Variable::both) const {
        const FieldOptions bad = options(text, variable);
        return input_error([&] { FieldGenerator(GridSpec{}, bad); });
    }

    fs::path folder_ = fs::temp_directory_path() / ("grainfield_data_" + std::to_string(getpid()));
    fs::path file_ = folder_ / "cpt.csv";
};

TEST_F(FieldData, ReadsBothHeaders) {
    options(std::string("# a comment\n\n") + full +
            " 0.1, 2.9 ,1.5,friction_angle,0.55,0\r\n1.5,3,0,normal_stiffness,9e8,1e7\n");
    const auto measurements = read_measurements(file_, GridSpec{}, std::nullopt);
    ASSERT_EQ(measurements.size(), 2u);
    EXPECT_EQ(measurements[0].property, friction);
    EXPECT_EQ(measurements[0].position, Vec3(0.1, 2.9, 1.5));
    EXPECT_EQ(measurements[0].value, 0.55);
    EXPECT_EQ(measurements[0].error, 0.0);
    EXPECT_EQ(measurements[0].line, 4);
    EXPECT_EQ(measurements[1].property, stiffness);
    EXPECT_EQ(measurements[1].error, 1e7);

    options("x,y,z,value,error\n0,0,0,0.5,0.01\n");
    EXPECT_EQ(read_measurements(file_, GridSpec{}, friction).front().property, friction);
}

// 0.5 where 5e8 Pa was meant gave neighbours of 35 Pa.
TEST_F(FieldData, RefusesValuesFarFromTheirDistributionUnlessAskedFor) {
    const std::string mistaken = std::string(full) + "1,1,1,normal_stiffness,0.5,0\n";
    EXPECT_THAT(
        refusal(mistaken),
        testing::AllOf(HasSubstr(":2: value = 0.5: "), HasSubstr("allowed are 6"),
                       HasSubstr("is it in Pa? If it is meant, give field.data_deviations")));
    FieldOptions meant = options(mistaken);
    meant.data_deviations = 60;
    EXPECT_NO_THROW(FieldGenerator(GridSpec{}, meant));
    // Lognormal: the median times exp(+-6 s sqrt(gamma)), s^2 = ln(1 + 0.64).
    const FieldGenerator usual(GridSpec{},
                               options(std::string(full) + "1,1,1,friction_angle,0.6,0\n"));
    const double s = std::sqrt(std::log(1.64) * usual.gamma());
    const double median = usual.marginals(stiffness).row(0)(0.0);
    for (const double side : {-1.0, 1.0}) {
        const auto line = [&](double deviations, double errors) {
            const double value = median * std::exp(side * deviations * s);
            return fmt::format("{}1,1,1,normal_stiffness,{},{}\n", full, value, errors * value);
        };
        EXPECT_NO_THROW(FieldGenerator(GridSpec{}, options(line(5.99, 0))));
        EXPECT_THAT(refusal(line(6.01, 0)), HasSubstr("6.01 standard deviations"));
        EXPECT_NO_THROW(FieldGenerator(GridSpec{}, options(line(6.01, 0.1))));
    }
    EXPECT_THAT(refusal(std::string(full) + "1,1,1,normal_stiffness,0.5,0.1\n"),
                HasSubstr("standard deviations from the distribution of field.stiffness"));
}

TEST_F(FieldData, RefusesWithFileAndLine) {
    struct Case {
        const char* line;
        const char* message;
    };
    for (const Case& one : {
             Case{"1.6,1,1,friction_angle,0.6,0",
                  "x = 1.6: outside the sample, which lies in [0, 1.5] m"},
             Case{"1,-0.01,1,friction_angle,0.6,0",
                  "y = -0.01: outside the sample, which lies in [0, 3] m"},
             Case{"1,1,nan,friction_angle,0.6,0", "z = \"nan\": a finite number"},
             Case{"1,1,1,friction_angle,nan,0", "value = \"nan\": a finite number"},
             Case{"1,1,1,friction_angle,,0", "value = \"\": a finite number"},
             Case{"1,1,1,friction_angle,0.6,inf", "error = \"inf\": a finite number"},
             Case{"1,1,1,friction_angle,0.6,-0.1", "error = -0.1: must be a standard deviation"},
             Case{"1,1,1,friction_angle,1.6,0",
                  "value = 1.6: a friction_angle must be in [0, pi/2)"},
             Case{"1,1,1,normal_stiffness,0,0", "value = 0: a normal_stiffness must be above 0"},
             Case{"1,1,1,friction_angle,0.95,0",
                  "value = 0.95: exact, but outside what field.friction.marginal"},
             Case{"1,1,1,friction_angle,0.3,0", "between 0.3 and 0.9 rad"},
             Case{"1,1,1,cohesion,0.3,0", "property = \"cohesion\": friction_angle or"},
             Case{"1,1,1,friction_angle,0.3", "6 columns are expected, here are 5"},
             Case{"1,1,1,friction_angle,0.3,0,0", "6 columns are expected, here are 7"},
             Case{"0.3,0.3,0.3,friction_angle,0.61,0", "exact, and so is the value 0.6 of line 2"},
         }) {
        const std::string message =
            refusal(std::string(full) + "0.4,0.4,0.4,friction_angle,0.6,0\n" + one.line + "\n");
        EXPECT_THAT(message, StartsWith(file_.string() + ":3: ")) << one.line;
        EXPECT_THAT(message, HasSubstr(one.message));
    }
    EXPECT_THAT(refusal("x,y,value\n1,1,1\n"),
                HasSubstr(":1: header \"x,y,value\": x,y,z,property"));
    EXPECT_THAT(refusal("x,y,z,value,error\n1,1,1,0.6,0\n"), HasSubstr("two properties random"));
    EXPECT_THAT(refusal(""), HasSubstr(":1: header \"\""));
    EXPECT_THAT(refusal(full), HasSubstr("no values follow the header"));
    EXPECT_THAT(
        refusal(std::string(full) + "1,1,1,normal_stiffness,9e8,0\n", Variable::friction),
        HasSubstr(":2: property = normal_stiffness: field.variable does not make it random"));
    EXPECT_THAT(refusal(full, Variable::none), StartsWith("field.data = \""));

    FieldOptions missing = options(full);
    missing.data = (folder_ / "none.csv").string();
    EXPECT_THROW(FieldGenerator(GridSpec{}, missing), FileError);
}

TEST_F(FieldData, ValuesOfOneBlockCombineByTheirPrecision) {
    const GridSpec grid;
    MarginalOptions normal{MarginalKind::normal, {}, {}, 2.0, 0.6, 0.1};
    const RowMarginals rows(normal, friction, grid, 0.8);
    const auto marginals = [&](Property) { return &rows; };
    const LocalAverageCovariance covariance(grid.cell_size, {paper_theta(0.5)}, grid.cells);
    const Vec3 here(0.1, 0.1, 0.1);
    // Scores 1 and -0.5 with errors of 0.5 and 1 in the score.
    auto data = cell_data("f", {{friction, here, 0.66, 0.03, 1}, {friction, here, 0.57, 0.06, 2}},
                          grid, covariance, 0.0, marginals);
    ASSERT_EQ(data.size(), 1u);
    EXPECT_NEAR(data[0].variance, 1.0 / (4.0 + 1.0), 1e-9);  // the slope is good to 1e-9 here
    EXPECT_NEAR(data[0].score, (4.0 * 1.0 - 0.5) / 5.0, 1e-9);
    // The exact value alone counts, and may be said twice.
    data = cell_data("f",
                     {{friction, here, 0.66, 0.03, 1},
                      {friction, here, 0.63, 0.0, 2},
                      {friction, here, 0.63, 0.0, 3}},
                     grid, covariance, 0.0, marginals);
    ASSERT_EQ(data.size(), 1u);
    EXPECT_EQ(data[0].variance, 0.0);
    EXPECT_NEAR(data[0].score, 0.5, 1e-12);
}

TEST_F(FieldData, FieldsHonourExactValuesOfEveryMarginal) {
    for (const MarginalKind kind :
         {MarginalKind::bounded, MarginalKind::lognormal, MarginalKind::normal,
          MarginalKind::truncated_normal, MarginalKind::beta, MarginalKind::weibull}) {
        FieldOptions both = options(std::string(full) +
                                    "0.4,0.4,0.4,friction_angle,0.71,0\n"
                                    "0.4,0.7,0.4,friction_angle,0.55,0\n"
                                    "1.4,2.9,0.1,normal_stiffness,5e8,0\n");
        both.friction.kind = kind;
        if (kind != MarginalKind::normal) both.stiffness.kind = kind;
        both.stiffness.minimum = 1e8;
        both.stiffness.maximum = 4e9;
        both.stiffness.cov = 0.5;
        both.stiffness.preserve_mean = true;
        both.friction.mean_gradient = -0.01;
        const FieldGenerator generator(GridSpec{}, both);
        for (std::uint64_t k = 0; k < 3; ++k) {
            const BlockField field = generator.draw(k);
            const GridSpec& grid = field.grid;
            EXPECT_NEAR(field.friction_angle[grid.index(1, 1, 1)], 0.71, 1e-12);
            EXPECT_NEAR(field.friction_angle[grid.index(1, 2, 1)], 0.55, 1e-12);
            EXPECT_NEAR(field.normal_stiffness[grid.index(5, 11, 0)], 5e8, 5e8 * 1e-12);
        }
    }
}

// A subdivided field has an approximate covariance, but its known values are as exact.
TEST_F(FieldData, SubdividedFieldsHonourExactValuesToo) {
    FieldOptions fine =
        options("x,y,z,value,error\n0.4,0.4,0.4,0.71,0\n0.4,0.6,0.4,0.4,0\n", Variable::friction);
    fine.method = Method::las_classic;
    fine.stage0_cells = 54;
    const FieldGenerator generator({{12, 24, 12}, Vec3(0.125, 0.125, 0.125)}, fine);
    ASSERT_EQ(generator.generator().subdivisions(), 2u);
    const BlockField field = generator.draw(1);
    EXPECT_NEAR(field.friction_angle[field.grid.index(3, 3, 3)], 0.71, 1e-12);
    EXPECT_NEAR(field.friction_angle[field.grid.index(3, 4, 3)], 0.4, 1e-12);
}

// The random numbers behind a field are those it has without data.
TEST_F(FieldData, ConditioningIsAppliedToTheUnconditionalField) {
    const FieldOptions with = options(std::string(full) +
                                      "0.4,0.4,0.4,friction_angle,0.71,0.02\n"
                                      "1.4,2.9,0.1,normal_stiffness,5e8,0\n");
    FieldOptions without = with;
    without.data.clear();
    const FieldGenerator conditional(GridSpec{}, with), plain(GridSpec{}, without);
    for (const std::uint64_t k : {0u, 5u}) {
        BlockField field = plain.draw(k);
        EXPECT_EQ(conditional.draw_unconditional(k).G, field.G);
        EXPECT_EQ(conditional.draw_unconditional(k).normal_stiffness, field.normal_stiffness);
        std::vector<double> errors(2);
        core::RandomStream(with.seed, core::Stream::field_data).normals(k, 0, errors);
        conditional.conditioning()->apply(field.G, field.G_stiffness, errors);
        const BlockField drawn = conditional.draw(k);
        EXPECT_EQ(drawn.G, field.G);
        EXPECT_EQ(drawn.G_stiffness, field.G_stiffness);
        EXPECT_NE(drawn.G, plain.draw(k).G);
    }
}

// Drawn fields against the mean and variance that algebra predicts for every cell: the largest of
// 2 x 864 z values at a significance of 1e-6 by Bonferroni: 6.1; with the tail of the chi-squared
// distribution of 2,000 draws 6.6. A column of data with errors, both properties.
TEST_F(FieldData, DrawsHaveTheConditionalMeanAndVariance) {
    std::string text = full;
    for (int j = 0; j < 12; j += 2)
        text += "0.8," + std::to_string(0.25 * j + 0.1) + ",0.8,friction_angle," +
                std::to_string(0.5 + 0.02 * j) + "," + (j == 4 ? "0" : "0.02") + "\n";
    text += "0.1,1.6,1.4,normal_stiffness,2e9,1e8\n";
    const FieldGenerator generator(GridSpec{}, options(text));
    const Conditioning& conditioning = *generator.conditioning();
    const int draws = 2000;
    for (const Property property : {friction, stiffness}) {
        const std::vector<double> mean = conditioning.mean(property);
        const std::vector<double> variance = conditioning.variance(property);
        std::vector<double> sum(432, 0.0), square(432, 0.0);
        for (int k = 0; k < draws; ++k) {
            const BlockField field = generator.draw(static_cast<std::uint64_t>(k));
            const auto& g = property == friction ? field.G : field.G_stiffness;
            for (std::size_t c = 0; c < 432; ++c) {
                sum[c] += g[c] - mean[c];
                square[c] += (g[c] - mean[c]) * (g[c] - mean[c]);
            }
        }
        double worst = 0.0;
        std::size_t known = 0;
        for (std::size_t c = 0; c < 432; ++c) {
            if (variance[c] < 1e-12) {
                EXPECT_LT(square[c] / draws, 1e-20);
                ++known;
                continue;
            }
            worst = larger(worst, std::abs(sum[c]) / std::sqrt(draws * variance[c]));
            worst =
                larger(worst, std::abs(square[c] / variance[c] - draws) / std::sqrt(2.0 * draws));
        }
        EXPECT_EQ(known, property == friction ? 1u : 0u);
        EXPECT_LT(worst, 6.6);
        EXPECT_GT(worst, 1.5);
    }
}

// E[k]/mu with data is the mean of what is drawn with them: five standard errors, 6e-7.
TEST_F(FieldData, TheMeanRatioIsThatOfTheFieldsWithData) {
    FieldOptions stiff =
        options("x,y,z,value,error\n0.8,1.6,0.8,4e9,0\n0.1,0.1,0.1,1e8,2e7\n", Variable::stiffness);
    stiff.correlation_length = paper_theta(1.0);
    const FieldGenerator generator(GridSpec{}, stiff);
    const int draws = 2000;
    double sum = 0.0, square = 0.0;
    for (int k = 0; k < draws; ++k) {
        const BlockField field = generator.draw(static_cast<std::uint64_t>(k));
        double mean = 0.0;
        for (const double value : field.normal_stiffness) mean += value / 432 / 9e8;
        sum += mean;
        square += mean * mean;
    }
    const double mean = sum / draws;
    const double error = std::sqrt((square / draws - mean * mean) / draws);
    EXPECT_NEAR(generator.stiffness_mean_ratio(), mean, 5.0 * error);
    EXPECT_GT(std::abs(generator.marginals(stiffness).mean_ratio() - mean), 20.0 * error);
}

}  // namespace
}  // namespace grainfield::randomfield
