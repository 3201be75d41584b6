// The verification finds what is wrong, and seldom what is not.

#include "randomfield/verification.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

std::size_t outside(const FieldCheck& check) {
    std::size_t count = 0;
    for (const CorrelationEstimates& axis : check.correlation)
        for (const Estimate& one : axis) count += one.inside() ? 0 : 1;
    return count;
}

std::size_t outside(const HistogramCheck& check) {
    std::size_t count = check.mean.inside() ? 0 : 1;
    for (const Estimate& share : check.shares) count += share.inside() ? 0 : 1;
    return count;
}

FieldOptions paper(Variable variable, double theta_y) {
    FieldOptions options;
    options.variable = variable;
    options.correlation_length = paper_theta(theta_y);
    return options;
}

TEST(Verification, FindsNothingWrongWithTheExactField) {
    FieldOptions options = paper(Variable::both, 0.5);
    options.cross_correlation = 0.6;
    options.stiffness.mean_gradient = 1e8;
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 400);
    ASSERT_EQ(result.fields.size(), 2u);
    EXPECT_LT(result.covariance_error->covariance, 1e-12);
    ASSERT_TRUE(result.cross_correlation);
    EXPECT_TRUE(result.cross_correlation->inside());
    EXPECT_DOUBLE_EQ(result.cross_correlation->exact, 0.6);
    for (const FieldCheck& field : result.fields) {
        EXPECT_EQ(outside(field), 0u);
        EXPECT_EQ(field.variance.outside, 0u);
        EXPECT_EQ(outside(*field.histogram), 0u);
        EXPECT_EQ(field.correlation[0].size(), 6u);
        EXPECT_EQ(field.correlation[1].size(), 12u);
        // physics.md: correlation of cells one apart, in x and y.
        EXPECT_NEAR(field.correlation[0][1].exact, 0.9764, 0.5e-4);
        EXPECT_NEAR(field.correlation[1][1].exact, 0.5477, 0.5e-4);
        EXPECT_LT(field.correlation[1][1].half_width, 0.15);  // bands that say something
        EXPECT_NEAR(field.histogram->sampled_deviation / field.histogram->deviation, 1.0, 0.2);
    }
}

// Subdivision as published, 3 x 6 x 3 -> 6 x 12 x 6: largest covariance error 0.396 of gamma.
TEST(Verification, FindsTheErrorOfSubdivision) {
    FieldOptions options = paper(Variable::friction, 0.1);
    options.method = Method::las_classic;
    options.stage0_cells = 54;
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 400);
    EXPECT_NEAR(result.covariance_error->covariance, 0.396, 0.5e-3);
    EXPECT_GT(outside(result.fields.front()), 2u);
    EXPECT_EQ(result.fields.front().variance.outside, 0u);  // exact after one split
}

// After several splits the variances are off too, and so is what is distributed by them.
TEST(Verification, FindsWrongVariances) {
    FieldOptions options = paper(Variable::friction, 0.1);
    options.method = Method::las_classic;
    options.stage0_cells = 1;
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 2000);
    EXPECT_GT(result.covariance_error->variance, 0.05);
    EXPECT_GT(result.fields.front().variance.outside, 10u);
}

// Of 100 checks that are held to be wrong 1 % of the time each, 9 and more are so once in 1e6.
TEST(Verification, RaisesFewFalseAlarms) {
    std::size_t correlation = 0, variance = 0, histogram = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        FieldOptions options = paper(Variable::stiffness, 0.3);
        options.seed = seed;
        const Verification result =
            verify(FieldGenerator({{3, 4, 2}, Vec3(0.25, 0.25, 0.25)}, options), 200);
        const FieldCheck& field = result.fields.front();
        correlation += outside(field) > 0 ? 1 : 0;
        variance += field.variance.outside > 0 ? 1 : 0;
        histogram += outside(*field.histogram) > 0 ? 1 : 0;
    }
    EXPECT_LT(correlation, 9u);
    EXPECT_LT(variance, 9u);
    EXPECT_LT(histogram, 14u);  // two checks in one, the mean of lognormal values is skewed
}

TEST(Verification, ChecksTheDataTheyAreConditionedOn) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("grainfield_verify_" + std::to_string(getpid()) + ".csv");
    std::ofstream(file) << "x,y,z,value,error\n0.1,0.1,0.1,0.7,0\n0.8,1.6,0.8,0.5,0.01\n";
    FieldOptions options = paper(Variable::friction, 0.5);
    options.data = file.string();
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 300);
    std::filesystem::remove(file);
    const FieldCheck& field = result.fields.front();
    EXPECT_EQ(outside(field), 0u);  // of the field without data
    ASSERT_TRUE(field.data);
    EXPECT_EQ(field.data->cells, 2u);
    EXPECT_EQ(field.data->exact, 1u);
    EXPECT_LT(field.data->largest_miss, 1e-12);
    EXPECT_LT(field.data->mean_off, field.data->mean_allowed);
    EXPECT_EQ(field.data->variance.outside, 0u);
    EXPECT_TRUE(std::isnan(field.data->variance.ratio[0]));
}

TEST(Verification, IsTheSameOnAnyNumberOfThreads) {
    const FieldGenerator generator(GridSpec{}, paper(Variable::none, 0.5));
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const Verification one = verify(generator, 100);
    omp_set_num_threads(3);
    const Verification three = verify(generator, 100);
    omp_set_num_threads(before);
    EXPECT_EQ(one.fields[0].variance.ratio, three.fields[0].variance.ratio);
    EXPECT_EQ(one.fields[0].correlation[1][5].half_width,
              three.fields[0].correlation[1][5].half_width);
    EXPECT_FALSE(one.fields[0].histogram);
    EXPECT_NE(input_error([&] { verify(generator, 99); }).find("--realizations = 99"),
              std::string::npos);
}

}  // namespace
}  // namespace grainfield::randomfield
