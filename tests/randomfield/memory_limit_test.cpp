// What a grid needs is counted before it is taken.

#include "randomfield/memory_limit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

using testing::HasSubstr;

TEST(MemoryLimit, RefusesJustMoreThanThereIs) {
    const double memory = memory_of_process();
    EXPECT_GT(memory, 1e8);
    EXPECT_LT(memory, 1e15);
    const GridSpec grid;
    EXPECT_EQ(input_error([&] { require_memory(grid, memory, "this"); }), "");
    EXPECT_THAT(input_error([&] { require_memory(grid, 2.0 * memory, "this"); }),
                testing::AllOf(HasSubstr("6 x 12 x 6 cells with this need "),
                               HasSubstr("lower packing.blocks to at most 216 cells")));
    EXPECT_THAT(input_error([&] { require_memory(grid, 4.0 * memory, 1000, "in a file"); }),
                HasSubstr("lower --realizations to at most 250, or packing.blocks"));
}

// A limit below the machine's memory counts, and a realization is refused by seven columns of
// numbers: the grid that just fits them passes, half as many cells more do not.
TEST(MemoryLimit, CountsAllColumnsOfARealization) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
    rlimit limited = before;
    limited.rlim_cur = rlim_t{1} << 40;  // never reached, unlike the grids' 1e9 cells
    ASSERT_EQ(setrlimit(RLIMIT_AS, &limited), 0);
    EXPECT_LE(memory_of_process(), 1099511627776.0);
    setrlimit(RLIMIT_AS, &before);
    const auto most = static_cast<std::int32_t>(memory_of_process() / (7.0 * 8.0 * 1e6));
    FieldOptions options;
    const GridSpec large{{1000, 1000, most + most / 2}, Vec3(0.25, 0.25, 0.25)};
    if (large.size() > 1'000'000'000) GTEST_SKIP() << "more memory than any grid may take";
    EXPECT_THAT(input_error([&] { FieldGenerator(large, options); }),
                HasSubstr("cells with one realization need"));
}

}  // namespace
}  // namespace grainfield::randomfield
