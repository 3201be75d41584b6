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
    };
    for (const Refused& refused : cases) {
        FieldOptions options;
        refused.change(options);
        const std::string message = input_error([&] { options.validate(); });
        EXPECT_THAT(message, HasSubstr(std::string(refused.key) + " = "));
        EXPECT_THAT(message, HasSubstr(refused.value));
        EXPECT_EQ(input_error([&] { FieldGenerator(GridSpec{}, options); }), message);
    }
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
