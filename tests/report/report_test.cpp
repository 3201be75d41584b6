// The page of one run: complete, self-contained, and with the numbers of its files.

#include "triaxial/report/report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "core/base/errors.hpp"
#include "tests/report/run_fixture.hpp"

namespace grainfield::triaxial {
namespace {

using fixture::Field;
using fixture::TestFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The page without its pictures' bytes, which could hold any text.
std::string without_pictures(const std::string& page) {
    std::string out;
    std::size_t at = 0;
    for (;;) {
        const std::size_t begin = page.find("base64,", at);
        if (begin == std::string::npos) return out + page.substr(at);
        out += page.substr(at, begin - at);
        at = page.find('"', begin);
    }
}

template <class Error>
std::string message_of(const std::filesystem::path& dir) {
    try {
        write_report(dir);
    } catch (const Error& e) {
        return e.what();
    }
    return "nothing was thrown";
}

TEST(Report, HoldsEveryFigure) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {.field = Field::stiffness});
    const auto path = write_report(folder.path());
    EXPECT_EQ(path, folder.path() / "report.html");
    const std::string page = fixture::read_file(path);
    EXPECT_EQ(fixture::occurrences(page, "<svg"), 6U);
    EXPECT_EQ(fixture::occurrences(page, "src=\"data:image/png;base64,iVBORw0KGgo"), 1U);
    EXPECT_EQ(fixture::occurrences(page, "<figcaption>"), 7U);
    for (const char* caption :
         {"secant to half the peak", "Mohr circle at peak", "Lateral stresses",
          "The sum closes to 0.087 % of the work put in", "coloured by normal stiffness",
          "Grading of the sample", "settled under its own weight"})
        EXPECT_THAT(page, HasSubstr(caption));
}

TEST(Report, OfARunWithoutALedgerLeavesItsFigureOut) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    std::filesystem::remove(folder.path() / "energy.csv");
    const std::string page = fixture::read_file(write_report(folder.path()));
    EXPECT_EQ(fixture::occurrences(page, "<svg"), 5U);
    EXPECT_THAT(page, Not(HasSubstr("energy ledger from the start")));
}

TEST(Report, NamesTheLineOfABrokenLedger) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    const auto path = folder.path() / "energy.csv";
    const std::string text = fixture::read_file(path);
    fixture::write_file(path, text.substr(0, text.find('\n') + 1) + "0,1,2,x,4,5,6,7,8\n");
    EXPECT_EQ(message_of<FileError>(folder.path()),
              path.string() + ":2: 'x' is not a finite number");
}

TEST(Report, NeedsNothingFromOutside) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    std::string page = without_pictures(fixture::read_file(write_report(folder.path())));
    EXPECT_EQ(fixture::occurrences(page, "src="),
              fixture::occurrences(page, "src=\"data:image/png;"));
    for (const char* name_space : {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"})
        page = std::regex_replace(page, std::regex(name_space), "");
    for (const char* outside : {"http:", "https:", "file:", "@import", "<link", "<script"})
        EXPECT_THAT(page, Not(HasSubstr(outside)));
    std::smatch match;
    for (std::string rest = page; std::regex_search(rest, match, std::regex(R"(href=['"]([^'"]))"));
         rest = match.suffix())
        EXPECT_EQ(match[1], "#");
}

TEST(Report, IdsAreUnique) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    const std::string page = without_pictures(fixture::read_file(write_report(folder.path())));
    const std::regex id(R"(\sid=['"]([^'"]+)['"])");
    std::set<std::string> ids;
    for (std::sregex_iterator it(page.begin(), page.end(), id), end; it != end; ++it)
        EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
    EXPECT_FALSE(ids.empty());
}

TEST(Report, ShowsTheNumbersOfTheSummary) {
    const TestFolder folder;
    const auto summary = fixture::write_run(folder.path(), {.field = Field::stiffness});
    const std::string page = fixture::read_file(write_report(folder.path()));
    const auto cell = [](const std::string& value) { return "<td>" + value + "</td>"; };
    const double q = summary["peak_deviator_stress_Pa"], modulus = summary["E50_Pa"];
    const double phi = summary["friction_angle_rad"];
    EXPECT_THAT(page, HasSubstr(cell(fmt::format("{:.1f} kPa", 1e-3 * q))));
    EXPECT_THAT(page, HasSubstr(cell(fmt::format("{:.2f} MPa", 1e-6 * modulus))));
    EXPECT_THAT(page, HasSubstr(cell(fmt::format("{:.2f}°", phi * 180 / std::numbers::pi))));
    EXPECT_THAT(page, HasSubstr("0.5000 rad"));
    for (const char* value :
         {"1.12 %",   "100.0 kPa",     "171,234",    "0.4003",     "6,480",
          "6,321",    "32.14 µs",      "0.0930 %",   "0.260 %",    "-0.210 %",
          "0.000810", "74.50 million", "3 min 03 s", "4 min 01 s", "12.9 s",
          "avx512",   "mixed",         "0.1.0",      "0.8478",     "<code>9c1f0b7ad2e45513</code>"})
        EXPECT_THAT(page, HasSubstr(cell(value)));
    EXPECT_THAT(page, HasSubstr("<dt>unheard_of_key</dt><dd>shown &lt;as it is&gt;</dd>"));
    EXPECT_THAT(page, HasSubstr("<dt>energy.external_work_J</dt><dd>1840.2</dd>"));
    EXPECT_THAT(page, HasSubstr("# comment with &lt;angle&gt; &amp; ampersand"));
}

TEST(Report, FitsTheEnvelopeThroughCompanions) {
    const TestFolder folder;
    const std::array companions{folder.path() / "at-200", folder.path() / "at-400"};
    fixture::write_run(folder.path() / "at-100", {});
    fixture::write_run(companions[0], {.confining_stress = 200e3});
    fixture::write_run(companions[1], {.confining_stress = 400e3});
    const std::string page = fixture::read_file(write_report(folder.path() / "at-100", companions));
    EXPECT_THAT(page, HasSubstr("Mohr circles at peak strength of 3 runs"));
    EXPECT_THAT(page, HasSubstr("φ = 28.6° (0.5000 rad)"));
}

// A field and none are two soils: the line through both would have a cohesion that neither has.
TEST(Report, FitsNoEnvelopeThroughRunsThatCannotBeCompared) {
    const TestFolder folder;
    const std::array companions{folder.path() / "field", folder.path() / "small",
                                folder.path() / "at-200"};
    fixture::write_run(folder.path() / "at-100", {});
    fixture::write_run(companions[0],
                       {.confining_stress = 200e3, .field = fixture::Field::stiffness});
    fixture::write_run(companions[1], {.confining_stress = 200e3, .blocks = {1, 2, 1}});
    fixture::write_run(companions[2], {.confining_stress = 200e3});
    const std::string page = fixture::read_file(write_report(folder.path() / "at-100", companions));
    EXPECT_THAT(page, HasSubstr("Run “field” cannot be compared with this one"));
    EXPECT_THAT(page, HasSubstr("random field: none here, stiffness there"));
    EXPECT_THAT(page, HasSubstr("Run “small” cannot be compared with this one"));
    EXPECT_THAT(page, HasSubstr("Mohr circles at peak strength of 2 runs"));
    const std::string alone =
        fixture::read_file(write_report(folder.path() / "at-100", std::span(companions).first(1)));
    EXPECT_THAT(alone,
                HasSubstr("Whether the intercept is zero can only be told from runs at other"));
}

TEST(Report, NamesTheMohrCirclesWithTheUnitOfTheAxes) {
    const TestFolder folder;
    const std::array companions{folder.path() / ("at-200-" + std::string(100, 'x') + "-end")};
    fixture::write_run(folder.path() / "at-100", {});
    fixture::write_run(companions[0], {.confining_stress = 200e3});
    const std::string page = fixture::read_file(write_report(folder.path() / "at-100", companions));
    EXPECT_THAT(page, AllOf(HasSubstr("at-100, σ₃ = 100 kPa"), HasSubstr("xxx-end, σ₃ = 200 kPa"),
                            Not(HasSubstr("τ = 0"))));
    const std::string alone = fixture::read_file(write_report(folder.path() / "at-100"));
    EXPECT_THAT(alone, AllOf(HasSubstr("τ = σ tan 28.6°"), Not(HasSubstr("at-100, σ₃"))));
}

/// Replaces every number of a column of a table by a multiple of it.
void scale_column(const std::filesystem::path& file, std::size_t column, double factor) {
    std::istringstream lines(fixture::read_file(file));
    std::string line, text;
    for (bool header = true; std::getline(lines, line); header = false) {
        std::istringstream fields(line);
        std::size_t c = 0;
        for (std::string field; std::getline(fields, field, ','); ++c)
            text += (c > 0 ? "," : "") +
                    (c == column && !header ? fmt::format("{}", factor * std::stod(field)) : field);
        text += '\n';
    }
    fixture::write_file(file, text);
}

TEST(Report, NamesOfAxesStayInsideTheFigure) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    scale_column(folder.path() / "curve.csv", 5, 1e-3);  // ticks such as -0.0002
    for (const std::size_t column : {3u, 5u, 6u, 7u})
        scale_column(folder.path() / "energy.csv", column, 2e3);  // and such as 200000
    const std::string page = fixture::read_file(write_report(folder.path()));
    const std::regex rotated(R"(translate\(([-0-9.]+),[-0-9.]+\) rotate\((?:-90|270))");
    std::size_t found = 0;
    for (std::sregex_iterator it(page.begin(), page.end(), rotated), end; it != end; ++it, ++found)
        EXPECT_GE(std::stod((*it)[1]), 12) << "the baseline of letters 10 px high";
    EXPECT_EQ(found, 7U);  // two of the stress-strain curve, one of each other figure
}

TEST(Report, SaysWhereARunEndedBeforeTheServosCount) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    scale_column(folder.path() / "curve.csv", 0, 0.04);
    const std::string page = fixture::read_file(write_report(folder.path()));
    EXPECT_EQ(fixture::occurrences(page, "the run ended before 0.1 % of strain"), 2U);
    EXPECT_THAT(page, Not(HasSubstr("largest after 0.1 % of strain")));
}

TEST(Report, RefusesCompanionsAtTheSameConfiningStress) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    const std::array companions{folder.path()};
    EXPECT_THROW(write_report(folder.path(), companions), InputError);
}

TEST(Report, DoesWithoutAPacking) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {.field = Field::friction, .packing = false});
    const std::string page = fixture::read_file(write_report(folder.path()));
    EXPECT_EQ(fixture::occurrences(page, "<svg"), 4U);
    EXPECT_THAT(page, HasSubstr("holds no <code>packing.json</code>"));
}

TEST(Report, SaysWhenNoPeakWasFound) {
    const TestFolder folder;
    auto summary = fixture::write_run(folder.path(), {});
    summary.erase("failure");  // as earlier versions wrote it
    summary["peak_found"] = false;
    fixture::write_file(folder.path() / "summary.json", summary.dump());
    const std::string page = fixture::read_file(write_report(folder.path()));
    EXPECT_THAT(page, AllOf(HasSubstr("No peak was found"), HasSubstr("shows no peak before"),
                            Not(HasSubstr(">Peak deviator stress")), Not(HasSubstr("peaks at"))));
}

TEST(Report, SaysWhatTheLargestStressIsAndWhyTheRunEnded) {
    const TestFolder folder;
    auto summary = fixture::write_run(folder.path(), {});
    const auto page_of = [&](const char* failure, const char* end_reason) {
        summary["failure"] = failure;
        summary["end_reason"] = end_reason;
        fixture::write_file(folder.path() / "summary.json", summary.dump());
        return fixture::read_file(write_report(folder.path()));
    };
    EXPECT_THAT(page_of("peak", "peak"),
                AllOf(HasSubstr("the sample peaks at"), HasSubstr(">Peak deviator stress"),
                      HasSubstr("stayed more than 10 % below its peak"),
                      Not(HasSubstr("No peak was found"))));
    EXPECT_THAT(page_of("plateau", "plateau"),
                AllOf(HasSubstr("the sample levels off at"), HasSubstr("of the plateau"),
                      HasSubstr("had levelled off"), Not(HasSubstr("peaks at")),
                      Not(HasSubstr(">Peak deviator stress")), Not(HasSubstr("No peak"))));
    EXPECT_THAT(page_of("strain-limit", "asked"),
                AllOf(HasSubstr("shows no peak before"), HasSubstr(">Largest deviator stress"),
                      HasSubstr("the axial strain asked for was reached"),
                      HasSubstr("No peak was found"), Not(HasSubstr("peaks at"))));
    summary["failure"] = "collapse";
    fixture::write_file(folder.path() / "summary.json", summary.dump());
    EXPECT_THAT(message_of<FileError>(folder.path()),
                AllOf(HasSubstr("summary.json"), HasSubstr("'failure'"), HasSubstr("collapse")));
}

TEST(Report, GivesTheSmoothedModulusWhereItDiffers) {
    const TestFolder folder;
    auto summary = fixture::write_run(folder.path(), {});
    const auto page_of = [&](double ratio) {
        summary["smoothed_E50_Pa"] = ratio * summary["E50_Pa"].get<double>();
        fixture::write_file(folder.path() / "summary.json", summary.dump());
        return fixture::read_file(write_report(folder.path()));
    };
    EXPECT_THAT(page_of(1.019), Not(HasSubstr("from the smoothed curve")));
    EXPECT_THAT(page_of(1.021), HasSubstr("from the smoothed curve"));
}

TEST(Report, SaysInWordsWhatTheCaseIsAndWhatMakesItDoubtful) {
    const TestFolder folder;
    auto summary = fixture::write_run(folder.path(), {});
    summary.erase("state_hash");
    summary.erase("lateral_stress_rms_error");
    summary.erase("lateral_stress_max_error");
    const auto page_of = [&](const std::string& name) {
        summary["case"] = name;
        fixture::write_file(folder.path() / "summary.json", summary.dump());
        return fixture::read_file(write_report(folder.path()));
    };
    // A folder of before, which does not say how it was sheared.
    EXPECT_THAT(page_of("none"),
                AllOf(HasSubstr("uniform properties"),
                      HasSubstr("aim: 0.5 %; from the records of curve.csv"),
                      Not(HasSubstr("Hash of the final state")), Not(HasSubstr("Quasi-static")),
                      Not(HasSubstr("Warning: "))));
    summary["quasi_static"] = true;
    summary["warnings"] = nlohmann::json::array();
    summary["damping_share"] = 0.234;
    summary["kinetic_over_elastic_energy"] = 0.0123;
    summary["lateral_stress_rms_error_to_E50"] = 0.0456;
    summary["lateral_stress_rms_error_to_peak"] = 0.00789;
    EXPECT_THAT(page_of("both"),
                AllOf(HasSubstr("random friction angle and stiffness"), HasSubstr(">yes<"),
                      HasSubstr("23 %"), HasSubstr("0.012"), HasSubstr("4.56 %"),
                      HasSubstr("0.789 %"), Not(HasSubstr("Warning: "))));
    summary["quasi_static"] = false;
    summary["warnings"] = {"held <badly>", "not quasi-static"};
    EXPECT_THAT(
        page_of("my <own>"),
        AllOf(HasSubstr("Triaxial test: my &lt;own&gt;"), HasSubstr(">no<"),
              HasSubstr("Warning: held &lt;badly&gt;."), HasSubstr("Warning: not quasi-static.")));
}

TEST(Report, NamesAMissingFile) {
    for (const char* name : {"summary.json", "curve.csv", "config.toml", "state.h5"}) {
        const TestFolder folder;
        fixture::write_run(folder.path(), {});
        std::filesystem::remove(folder.path() / name);
        EXPECT_THAT(message_of<FileError>(folder.path()), HasSubstr(name));
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "report.html"));
    }
}

TEST(Report, NamesACorruptFile) {
    const TestFolder folder;
    const auto summary = fixture::write_run(folder.path(), {});
    const auto replaced = [&](const char* name, const std::string& text) {
        fixture::write_run(folder.path(), {});
        fixture::write_file(folder.path() / name, text);
        return message_of<FileError>(folder.path());
    };
    EXPECT_THAT(replaced("summary.json", "{\"particles\": 12,"),
                AllOf(HasSubstr("summary.json"), HasSubstr("not valid JSON")));
    auto lacking = summary;
    lacking.erase("E50_Pa");
    EXPECT_THAT(replaced("summary.json", lacking.dump()), HasSubstr("key 'E50_Pa' is missing"));
    lacking["E50_Pa"] = "stiff";
    EXPECT_THAT(replaced("summary.json", lacking.dump()),
                HasSubstr("key 'E50_Pa' must be a number, is \"stiff\""));
    lacking["E50_Pa"] = 0;
    EXPECT_THAT(replaced("summary.json", lacking.dump()),
                HasSubstr("'E50_Pa' must be positive, is 0"));
    EXPECT_THAT(replaced("config.toml", "[triaxial]\nstrain_rate = \n"),
                HasSubstr("config.toml:2"));
    EXPECT_THAT(replaced("packing.json", "[1, 2]"), HasSubstr("packing.json"));
    EXPECT_THAT(replaced("packing.json", R"({"grading": {"sieve_diameter_m": [0.01, 0.02],
                         "target_passing_percent": [0], "achieved_passing_percent": [0, 100]}})"),
                HasSubstr("grading.target_passing_percent"));
    EXPECT_THAT(replaced("state.h5", "no HDF5 at all"), HasSubstr("state.h5"));
}

TEST(Report, SaysThatGnuplotIsMissing) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    const std::string path = getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const std::string message = message_of<FileError>(folder.path());
    setenv("PATH", path.c_str(), 1);
    EXPECT_THAT(message, HasSubstr("gnuplot-nox"));
}

TEST(Report, KeepsTheOldPageOnFailure) {
    const TestFolder folder;
    fixture::write_run(folder.path(), {});
    fixture::write_file(folder.path() / "report.html", "old");
    fixture::write_file(folder.path() / "curve.csv", "");
    EXPECT_THROW(write_report(folder.path()), FileError);
    EXPECT_EQ(fixture::read_file(folder.path() / "report.html"), "old");
}

}  // namespace
}  // namespace grainfield::triaxial
