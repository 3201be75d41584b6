// Numbers and text as the page prints them.

#include "triaxial/report/text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace grainfield::triaxial::report {
namespace {

TEST(Text, RoundsToSignificantDigits) {
    EXPECT_EQ(significant(187.2634), "187.3");
    EXPECT_EQ(significant(0.0123456, 3), "0.0123");
    EXPECT_EQ(significant(-5.0, 3), "-5.00");
    EXPECT_EQ(significant(123456.7), "123457");
    EXPECT_EQ(significant(9.9996), "10.00");
    EXPECT_EQ(significant(0), "0");
    EXPECT_EQ(significant(2.5e-7, 2), "2.5e-07");
    EXPECT_EQ(significant(1e7, 3), "1.00e+07");
    EXPECT_EQ(significant(std::numeric_limits<double>::quiet_NaN()), "not a number");
}

TEST(Text, GroupsCounts) {
    EXPECT_EQ(count(0), "0");
    EXPECT_EQ(count(999), "999");
    EXPECT_EQ(count(151632), "151,632");
    EXPECT_EQ(count(-1234567), "-1,234,567");
    EXPECT_EQ(count(1e16), "1.000e+16");
    EXPECT_EQ(count(std::numeric_limits<double>::infinity()), "not a number");
}

TEST(Text, SaysDurations) {
    EXPECT_EQ(duration(12.94), "12.9 s");
    EXPECT_EQ(duration(252), "4 min 12 s");
    EXPECT_EQ(duration(3900), "1 h 05 min");
    EXPECT_EQ(duration(std::numeric_limits<double>::quiet_NaN()), "not a number");
}

TEST(Text, ShortensByCharacters) {
    EXPECT_EQ(shortened("abcdef", 6), "abcdef");
    EXPECT_EQ(shortened("abcdefg", 6), "ab…efg");
    EXPECT_EQ(shortened("äöüßäöü", 4), "ä…öü") << "no character is cut";
    EXPECT_EQ(characters("σ₃ = 1"), 6u);
    EXPECT_EQ(characters(shortened(std::string(500, 'x'), 40)), 40u);
}

TEST(Text, EscapesHtml) {
    EXPECT_EQ(escape("<a href='b'>&\"</a>"), "&lt;a href=&#39;b&#39;&gt;&amp;&quot;&lt;/a&gt;");
}

TEST(Text, Base64IsThatOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

}  // namespace
}  // namespace grainfield::triaxial::report
