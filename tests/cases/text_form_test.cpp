// Tables as spreadsheets and other programs write them: refused, with what is foreign in their
// form, by `info` and `convert` alike. Nothing is read by guess.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

/// Both refuse it with 2 and a message that names the file and has this part.
void expect_refused(const std::string& name, const std::string& text, const std::string& part) {
    const Workplace place;
    const std::string file = place.write(name, text);
    const Outcome convert = place.run({"convert", file, place.path("out.h5")});
    const Outcome info = place.run({"info", file});
    EXPECT_EQ(convert.code, 2) << convert.out;
    EXPECT_EQ(info.code, 2) << info.out;
    EXPECT_TRUE(has(convert.err, part)) << convert.err;
    EXPECT_TRUE(has(convert.err, file)) << convert.err;
    EXPECT_TRUE(has(info.err, part)) << info.err;
    EXPECT_FALSE(place.has("out.h5"));
}

TEST(TextForm, ForeignSeparatorsAreNamed) {
    for (const auto& [separator, name] :
         {std::pair{";", "semicolons (;)"}, std::pair{"\t", "tabs"}, std::pair{"|", "bars (|)"},
          std::pair{" ", "blanks"}, std::pair{":", "colons (:)"}, std::pair{"; ", "semicolons"}})
        expect_refused("P.csv", csv_text({.separator = separator}),
                       fmt::format("its fields are separated by {}", name));
    const std::string german = csv_text({.separator = ";", .line_end = "\r\n", .decimal = ","});
    expect_refused("P.csv", german, "its fields are separated by semicolons (;)");
    expect_refused("P.csv", german, "its numbers have decimal commas");
    expect_refused("P.txt", "0.1,0.1,0.1,0.05\n", "commas stand in it");
    expect_refused("P.txt", "0.1;0.1;0.1;0.05\n", "semicolons stand in it");
}

TEST(TextForm, DecimalCommasAreNamed) {
    expect_refused("P.csv", csv_text({.decimal = ","}), "decimal commas: must be points");
    expect_refused("P.csv", "x,y,z,radius\n\"0,1\",\"0,1\",\"0,1\",\"0,05\"\n", "decimal commas");
    expect_refused("P.txt", "0,1 0,1 0,1 0,05\n", "it has a decimal comma");
    std::string data = lammps_text({});
    data.replace(data.find("0.0233"), 6, "0,0233");
    expect_refused("P.data", data, "it has a decimal comma");
}

TEST(TextForm, QuotesAreNamed) {
    expect_refused("P.csv", csv_text({.quote = "\""}), "stand in quotes");
    expect_refused("P.csv", csv_text({.quote = "'"}), "stand in quotes");
    expect_refused("P.csv", "x,y,z,radius\n\"0.1\",0.1,0.1,0.05\n", "the number stands in quotes");
    // An apostrophe between thousands is none.
    expect_refused("P.csv", "x,y,z,radius\n1'000.5,0,0,1\n", "must be a finite number [m]\n");
}

TEST(TextForm, LineEndsAndEncodingsAreNamed) {
    expect_refused("P.csv", csv_text({.line_end = "\r"}), "its lines end with CR alone (old Mac)");
    expect_refused("P.txt", "0 0 0 1\r3 0 0 1\r", "its lines end with CR alone (old Mac)");
    const auto utf16 = [](const std::string& text) {
        std::string wide = "\xff\xfe";
        for (const char c : text) wide += {c, '\0'};
        return wide;
    };
    expect_refused("P.csv", utf16("x,y,z,radius\n0,0,0,1\n"), "it looks like UTF-16");
    expect_refused("P.txt", utf16("0 0 0 1\n"), "it looks like UTF-16");
}

TEST(TextForm, NumbersOfOtherLanguagesAreNamed) {
    for (const auto& [number, why] :
         {std::pair{"1.0D-01", "its exponent begins with D"}, std::pair{"1d-1", "begins with d"},
          std::pair{"1.0-101", "its exponent has no letter"},
          std::pair{"\xe2\x88\x92"
                    "0.1",
                    "its minus is not the ASCII one"},
          std::pair{"0.1 m", "a unit follows the number"},
          std::pair{"100mm", "a unit follows the number"},
          std::pair{"\xc2\xa0"
                    "0.1",
                    "a non-breaking blank"}}) {
        expect_refused("P.csv", fmt::format("x,y,z,radius\n0,0,0,{}\n", number), why);
        if (!has(number, " ") && !has(number, "\xa0"))
            expect_refused("P.txt", fmt::format("0 0 0 {}\n", number), why);
    }
}

TEST(TextForm, HeadersThatAreNoneOrForeignAreNamed) {
    expect_refused("P.csv", "0.1,0.1,0.1,0.05\n0.3,0.1,0.1,0.05\n", "must be a header");
    expect_refused("P.csv", "x,y,z,radius,\n0,0,0,1,\n", "behind which no name stands");
    expect_refused("P.csv", ",x,y,z,radius\n0,0,0,0,1\n", "column '' is unknown");
    expect_refused("P.csv", "X,Y,Z,R\n0,0,0,1\n", "column 'X' is unknown; required: x,y,z,radius");
    expect_refused("P.csv", "x,y,z,diameter\n0,0,0,1\n", "column 'diameter' is unknown");
    // As ParaView saves a table.
    expect_refused("P.csv", "radius,Points:0,Points:1,Points:2\n1,0,0,0\n",
                   "column 'Points:0' is unknown");
}

TEST(TextForm, WhatStandsInTheManualIsRead) {
    const Workplace place;
    for (const CsvForm& form : {CsvForm{}, CsvForm{.separator = ", "}, CsvForm{.line_end = "\r\n"}})
        for (const char* before : {"", "\xEF\xBB\xBF", "# my spheres\n"}) {
            const std::string file = place.write("P.csv", before + csv_text(form));
            const Outcome outcome = place.run({"convert", file, place.path("out.txt")});
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            EXPECT_EQ(core::read_spheres(place.path("out.txt")).spheres.radius,
                      packing().spheres.radius);
        }
}

}  // namespace
}  // namespace grainfield::case_tests
