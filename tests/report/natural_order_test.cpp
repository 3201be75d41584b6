// Names in the order of their numbers.

#include "triaxial/report/natural_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace grainfield::triaxial::report {
namespace {

TEST(NaturalOrder, IsThatOfTheNumbersInTheNames) {
    const std::vector<std::string> right{"",          "10 kPa",     "a",       "a=-2",   "a=-1",
                                         "a=0.1 b=2", "a=0.1 b=10", "a=0.12",  "a=1",    "a=1.0",
                                         "a=10x1x10", "a=10x2x10",  "a=50000", "a=1e6",  "a=2e+6",
                                         "a=text",    "b = -2",     "b = -1",  "run1.e", "run1.f",
                                         "run-1",     "run-2",      "run-10"};
    std::vector<std::string> names = right;
    std::ranges::reverse(names);
    std::ranges::sort(names, natural_less);
    EXPECT_THAT(names, testing::ElementsAreArray(right));
}

TEST(NaturalOrder, IsStrict) {
    for (const char* name : {"", "1", "1.0", "a=-1", "-", "1e", "1e+", "1."}) {
        EXPECT_FALSE(natural_less(name, name)) << name;
        for (const char* other : {"1.00", "b", "1e+x"})
            EXPECT_NE(natural_less(name, other), natural_less(other, name)) << name << " " << other;
    }
}

}  // namespace
}  // namespace grainfield::triaxial::report
