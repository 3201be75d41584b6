// Options and grids that are refused, with messages that name key, value and what is allowed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

using testing::HasSubstr;

TEST(FieldOptions, DefaultsAreValid) {
    EXPECT_NO_THROW(FieldOptions().validate());
}

TEST(FieldOptions, MessagesNameKeyAndValue) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    struct Refused {
        std::function<void(FieldOptions&)> change;
        const char* key;
        const char* value;
    };
    const Refused cases[] = {
        {[](auto& o) { o.correlation_length[1] = 0.0; }, "field.correlation_length", "[10, 0, 10]"},
        {[](auto& o) { o.correlation_length[0] = -1.0; }, "field.correlation_length", "-1"},
        {[](auto& o) { o.correlation_length[2] = inf; }, "field.correlation_length", "inf"},
        {[](auto& o) { o.correlation_length[2] = std::nan(""); }, "field.correlation_length",
         "nan"},
        {[](auto& o) { o.stage0_cells = 0; }, "field.stage0_cells", "0"},
        {[](auto& o) { o.friction.minimum = -0.1; }, "field.friction.minimum", "-0.1"},
        {[](auto& o) { o.friction.maximum = 0.3; }, "field.friction.maximum", "0.3"},
        {[](auto& o) { o.friction.maximum = 1.6; }, "field.friction.maximum", "1.6"},
        {[](auto& o) { o.friction.s = 0.0; }, "field.friction.s", "0"},
        {[](auto& o) { o.stiffness.mean = -9e8; }, "field.stiffness.mean", "-900000000"},
        {[](auto& o) { o.stiffness.cov = 0.0; }, "field.stiffness.cov", "0"},
        {[](auto& o) { o.stiffness.cov = std::nan(""); }, "field.stiffness.cov", "nan"},
        {[](auto& o) { o.cross_correlation = 1.01; }, "field.cross_correlation", "1.01"},
        {[](auto& o) { o.cross_correlation = -2.0; }, "field.cross_correlation",
         "must be in [-1, 1]"},
        {[](auto& o) { o.cross_correlation = std::nan(""); }, "field.cross_correlation", "nan"},
        // Distributions that reach what the material cannot have.
        {[](auto& o) { o.stiffness.kind = MarginalKind::normal; }, "field.stiffness.cov",
         "-3.42e+09 Pa"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::normal;
             o.friction.cov = 0.2;
         },
         "field.friction.cov", "at -6 standard deviations"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::lognormal;
             o.friction.cov = 0.2;
         },
         "field.friction.cov", "at +6 standard deviations"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::weibull;
             o.friction.cov = 0.6;
         },
         "field.friction.cov", "at +6 standard deviations"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::normal;
             o.friction.mean = 1.4;
         },
         "field.friction.cov", "in [0, pi/2)"},
        {[](auto& o) {
             o.stiffness.kind = MarginalKind::weibull;
             o.stiffness.cov = 1e-4;
         },
         "field.stiffness.cov", "[0.001, 100]"},
        {[](auto& o) { o.stiffness.kind = MarginalKind::beta; }, "field.stiffness.marginal",
         "\"beta\": needs field.stiffness.minimum"},
        {[](auto& o) {
             o.stiffness.kind = MarginalKind::bounded;
             o.stiffness.minimum = 0.0;
             o.stiffness.maximum = 1e9;
         },
         "field.stiffness.minimum", "above 0"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::beta;
             o.friction.mean = 0.9;
         },
         "field.friction.mean", "between field.friction.minimum = 0.3"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::beta;
             o.friction.cov = 0.5;
         },
         "field.friction.cov", "must be below 0.495"},
        {[](auto& o) {
             o.friction.kind = MarginalKind::truncated_normal;
             o.friction.mean = 0.1;
             o.friction.cov = 0.1;
         },
         "field.friction.mean", "at least 1e-6"},
        {[](auto& o) { o.friction.mean_gradient = std::nan(""); }, "field.friction.mean_gradient",
         "nan"},
    };
    for (const Refused& refused : cases) {
        FieldOptions options;
        options.variable = Variable::both;
        refused.change(options);
        const std::string message = input_error([&] { options.validate(); });
        EXPECT_THAT(message, HasSubstr(std::string(refused.key) + " = "));
        EXPECT_THAT(message, HasSubstr(refused.value));
        EXPECT_EQ(input_error([&] { FieldGenerator(GridSpec{}, options); }), message);
    }
}

// A trend may leave what is allowed at an end of the sample only; the message says where.
TEST(FieldOptions, TrendsAreCheckedOnEveryRow) {
    FieldOptions options;
    options.friction.mean_gradient = 0.25;  // 0.3 - 0.25 (1.5 - 0.125) < 0 in the lowest row
    EXPECT_NO_THROW(options.validate());
    const std::string message = input_error([&] { options.validate(GridSpec{}); });
    EXPECT_THAT(message,
                testing::StartsWith("field.friction.mean_gradient = 0.25: in the cells at a "
                                    "height of 0.125 m: field.friction.minimum = -0.04"));
    options.friction.mean_gradient = 0.2;
    EXPECT_NO_THROW(options.validate(GridSpec{}));
    options.stiffness.mean_gradient = -7e8;
    EXPECT_THAT(input_error([&] { FieldGenerator(GridSpec{}, options); }),
                testing::StartsWith("field.stiffness.mean_gradient = -700000000: in the cells at a "
                                    "height of 2.875 m: field.stiffness.mean = "));
}

TEST(GridSpec, BlocksAndPointsMapToTheirCell) {
    const GridSpec grid;
    EXPECT_EQ(grid.size(), 432u);
    EXPECT_EQ(grid.index_of_block({5, 11, 5}), 431u);
    EXPECT_EQ(grid.index_of_block({1, 2, 3}), 1u + 6u * (2u + 12u * 3u));
    EXPECT_THAT(input_error([&] {
                    (void)grid.index_of_block({6, 0, 0});
                }),
                HasSubstr("block (6, 0, 0)"));
    EXPECT_THAT(input_error([&] { (void)grid.index_of_block({-1, -1, -1}); }), HasSubstr("-1"));
    EXPECT_EQ(grid.index_at({0.3, 0.6, 0.8}), grid.index(1, 2, 3));
    EXPECT_EQ(grid.index_at({-1e300, 1e300, 1.5}), grid.index(0, 11, 5));
}

}  // namespace
}  // namespace grainfield::randomfield
