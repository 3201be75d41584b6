// What reaches gnuplot: texts of any kind are shown as they are and do nothing, and the .gnuplot
// files are those that the code names.

#include "triaxial/report/gnuplot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

#include "core/base/errors.hpp"
#include "tests/report/hostile_names.hpp"
#include "tests/report/run_fixture.hpp"
#include "triaxial/report/campaign/campaign_figures.hpp"

namespace grainfield::triaxial::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string definition(const GnuplotVariable& variable) {
    return variable.definition;
}

TEST(GnuplotText, IsOneConstantWhateverItHolds) {
    EXPECT_EQ(gnuplot_text(""), "''");
    EXPECT_EQ(gnuplot_text("σ = 5 %"), "'σ = 5 %'");
    EXPECT_EQ(gnuplot_text("a'b"), "'a\\047b'");
    EXPECT_EQ(gnuplot_text("'; system('x"), "'\\047; system(\\047x'");
    EXPECT_EQ(gnuplot_text("a\nb\r\tc\x7f" + std::string(1, '\0')), "'a b  c  '");
    EXPECT_EQ(gnuplot_text("a_b^{c}@d&e~f\\g"), R"('a\_b\^\{c\}\@d\&e\~f\\g')");
    EXPECT_EQ(gnuplot_text("`\"#$!%"), "'`\"#$!%'");
}

TEST(GnuplotVariable, ReadsAsItsValue) {
    EXPECT_EQ(definition({"a", 71.25}), "a = 71.25\n");
    EXPECT_EQ(definition({"a", 100.0}), "a = 100.0\n") << "not a whole number, which divides so";
    EXPECT_EQ(definition({"a", std::nan("")}), "a = NaN\n");
    EXPECT_EQ(definition({"a", 3}), "a = 3\n");
    EXPECT_EQ(definition({"a", true}), "a = 1\n");
    EXPECT_EQ(definition({"a", "it's"}), "a = 'it\\047s'\n");
    EXPECT_EQ(definition({"a", Markup("{/:Italic k}_n")}), "a = '{/:Italic k}_n'\n");
    EXPECT_EQ(definition({"a", std::vector<double>{1, 0.5}}), "array a[2] = [1.0, 0.5]\n");
    EXPECT_EQ(definition({"a", std::vector<std::string>{"x_y", ""}}),
              "array a[2] = ['x\\_y', '']\n");
    DataBlock rows(2);
    rows.row(1, 0.125);
    rows.end_part();
    EXPECT_EQ(definition({"a", rows}), "$a << EOD\n1 0.12 \n\n\nEOD\n");
}

/// What a reader of an SVG sees, all texts in a row.
std::string shown(const std::string& svg) {
    std::string text;
    const std::regex element("<text>(.*?)</text>"), tag("<[^>]*>");
    for (std::sregex_iterator at(svg.begin(), svg.end(), element), end; at != end; ++at)
        text += std::regex_replace((*at)[1].str(), tag, "") + "\n";
    for (const auto& [from, to] : {std::pair{"&lt;", "<"}, {"&amp;", "&"}})
        text = std::regex_replace(text, std::regex(from), to);
    return text;
}

TEST(HostileNames, AreDrawnAsTheyAreAndRunNothing) {
    const fixture::TestFolder folder;
    const std::string made = folder.path() / "made";
    const std::vector<std::string> names = fixture::hostile_names("touch " + made);
    constexpr GnuplotTemplate all[] = {{"names", R"(set key noautotitle
do for [k=1:|name|] { set label name[k] at 0,k }
set xlabel one
set title one
plot for [k=1:|name|] [0:1] k with lines title name[k]
)"}};
    const Gnuplot gnuplot(all);
    for (const std::string& one : names) {
        const std::string svg =
            gnuplot.svg("names", "n", one, {900, 900}, {{"name", std::vector{one}}, {"one", one}});
        std::string line = one;
        std::ranges::replace(line, '\n', ' ');
        EXPECT_EQ(fixture::occurrences(shown(svg), line + "\n"), 4U) << one << shown(svg);
        EXPECT_THAT(svg, Not(HasSubstr("<script"))) << one;
        EXPECT_FALSE(std::filesystem::exists(made)) << one;
    }
}

TEST(HostileNames, InATrendRunNothing) {
    const fixture::TestFolder folder;
    const std::string made = folder.path() / "made";
    const Gnuplot gnuplot;
    CampaignStatistics all(2);
    for (auto& one : all)
        for (CaseStatistics& s : one) {
            s.mean = 3, s.deviation = 1;
            s.mean_interval = statistics::Interval{2, 4};
        }
    std::vector<Trend> trends;
    for (const std::string& name : fixture::hostile_names("touch " + made))
        trends.push_back({name, {{1, 0}, {2, 1}}});
    for (const Trend& trend : trends) trend_figure(gnuplot, "t", 0, {trend.name}, trends, all);
    EXPECT_FALSE(std::filesystem::exists(made));

    const std::string name = "a_b^c {/:Bold d} &{e} ~f{g} 'h' \\101";
    const Figure figure = trend_figure(gnuplot, "t", 0, {name}, {{{name, trends[0].points}}}, all);
    EXPECT_EQ(fixture::occurrences(shown(figure.picture), name + "\n"), 3U)  // key and both axes
        << shown(figure.picture);
}

TEST(Gnuplot, SaysWhatIsWrongWithATemplate) {
    constexpr GnuplotTemplate all[] = {{"broken", "set xrange [0:1]\nplot no_such_thing\n"}};
    const Gnuplot gnuplot(all);
    EXPECT_THROW(gnuplot.png("missing", "x", {}, {}), std::out_of_range);
    try {
        gnuplot.png("broken", "x", {}, {});
        FAIL() << "no error";
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("figure 'x': \"broken.gnuplot\" line 2: undefined"));
    }
}

/// Names in a folder's files that a pattern finds.
std::set<std::string> names_in(const std::string& folder, const std::string& suffix,
                               const std::regex& pattern) {
    std::set<std::string> names;
    const std::filesystem::path root = std::filesystem::path(GRAINFIELD_SOURCE_DIR) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (entry.path().extension() != suffix) continue;
        const std::string text = fixture::read_file(entry.path());
        for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
            names.insert((*at)[1]);
    }
    return names;
}

std::set<std::string> templates_in(const std::string& folder) {
    std::set<std::string> files;
    const std::filesystem::path root = std::filesystem::path(GRAINFIELD_SOURCE_DIR) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
        if (entry.path().extension() == ".gnuplot") files.insert(entry.path().stem());
    return files;
}

TEST(GnuplotTemplates, AreThoseThatTheCodeNames) {
    const std::regex call(R"re((?:\bsvg|\bpng|\bwrite_results)\(\s*(?:run, )?"(\w+)")re");
    const std::regex load(R"re(load '(\w+)\.gnuplot')re");
    for (const char* folder : {"triaxial/report", "bench"}) {
        std::set<std::string> named = names_in(folder, ".cpp", call);
        EXPECT_GT(named.size(), 7U) << folder << ": the search found next to nothing";
        named.merge(names_in(folder, ".cpp", load));
        named.merge(names_in(folder, ".gnuplot", load));
        EXPECT_EQ(named, templates_in(folder)) << folder;
    }
}

TEST(GnuplotTemplates, AreAllInTheLibrary) {
    std::set<std::string> known;
    for (const auto& [name, text] : gnuplot_templates()) {
        EXPECT_TRUE(known.emplace(name).second) << name;
        EXPECT_THAT(text, Not(testing::IsEmpty())) << name;
    }
    EXPECT_EQ(known, templates_in("triaxial/report"));
}

}  // namespace
}  // namespace grainfield::triaxial::report
