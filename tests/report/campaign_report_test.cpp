// The report of a campaign: every figure and number is there, at any state of the campaign.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <regex>
#include <set>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "tests/report/browser.hpp"
#include "tests/report/run_fixture.hpp"
#include "triaxial/campaign/campaign_folder.hpp"
#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/campaign/campaign_report.hpp"

namespace grainfield::triaxial {
namespace {

using fixture::read_file;
using fixture::write_file;
using testing::HasSubstr;
using testing::Not;

constexpr const char* config = R"(
field.variable = "stiffness"
[montecarlo]
realizations = 60
[montecarlo.sweep]
"field.correlation_length" = [[1, 0.1, 1], [10, 1, 10], [100, 10, 100]]
)";

class CampaignReport : public testing::Test {
  protected:
    /// A campaign whose first `rows` realizations of each case are done: E50 lognormal with a
    /// median of 30 MPa, peaks about 120 kPa; with no scatter all are the same.
    std::filesystem::path campaign(std::int64_t rows, const std::string& text = config,
                                   double scatter = 1) const {
        const auto dir = folder_.path() / "campaign";
        write_file(folder_.path() / "c.toml", text);
        const auto cases = load_campaign(folder_.path() / "c.toml");
        CampaignFolder folder(dir, cases, std::nullopt, {});
        const core::RandomStream stream(7, core::Stream::perturbation);
        for (std::size_t c = 0; c < cases.size(); ++c)
            for (std::int64_t k = deterministic_run; k < rows; ++k) {
                Row row;
                row.case_name = cases[c].name;
                row.realization = k;
                const double u = scatter * stream.normal(c, static_cast<std::uint64_t>(k + 1));
                row.E50 = k < 0 ? 31e6 : 30e6 * std::exp(0.2 * u);
                row.peak_deviator_stress = k < 0 ? 121e3 : 120e3 + 2e3 * u;
                row.wall_seconds = 2;
                row.failed = k == 5 && c == 1;
                if (row.failed) row.reason = "sphere 7 is <lost>";
                folder.append({{row}});
            }
        folder.write_results();
        return dir;
    }

    fixture::TestFolder folder_;
};

TEST_F(CampaignReport, HasEveryFigureAndTable) {
    const std::string page = read_file(write_campaign_report(campaign(60)));
    // Trends over the correlation length, and of each case the convergence, histogram and P-P
    // plot: of two quantities each.
    constexpr std::size_t figures = 2 * (1 + 3 * 3);
    EXPECT_EQ(fixture::occurrences(page, "<svg"), figures);
    for (std::size_t k = 1; k <= figures; ++k)
        EXPECT_THAT(page, HasSubstr(fmt::format("<b>Figure {}.</b>", k)));
    std::set<std::string> ids;
    const std::regex id(" id=['\"]([^'\"]+)['\"]");
    for (std::sregex_iterator at(page.begin(), page.end(), id), end; at != end; ++at)
        EXPECT_TRUE(ids.insert((*at)[1]).second) << (*at)[1];
    EXPECT_EQ(fixture::occurrences(page, "<table class=\"columns\">"), 4u);
    EXPECT_THAT(page, HasSubstr("179 realizations over 3 cases are done, 1 failed"));
    EXPECT_THAT(page, HasSubstr("sphere 7 is &lt;lost&gt;"));
    EXPECT_THAT(page, HasSubstr("Correlation length"));
    // Nothing from outside.
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "<script", "<link"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

/// Replaces every `from` of a text, or the first `most`.
std::string replaced(std::string text, const std::string& from, const std::string& to,
                     std::size_t most = std::string::npos) {
    for (std::size_t at = 0; most > 0 && (at = text.find(from, at)) != std::string::npos; --most) {
        text.replace(at, from.size(), to);
        at += to.size();
    }
    return text;
}

// The rows of these campaigns took 2 s and say nothing of their state and end.
constexpr const char* says_nothing = ",2,,,,";

TEST_F(CampaignReport, CountsRunsWithoutAPeak) {
    const auto dir = campaign(4);
    EXPECT_THAT(read_file(write_campaign_report(dir)), Not(HasSubstr("No peak was found")));
    const std::string table = read_file(dir / "results.csv");
    write_file(dir / "results.csv", replaced(table, says_nothing, ",2,,strain-limit,asked,", 3));
    const std::string page = read_file(write_campaign_report(dir));
    EXPECT_THAT(page, HasSubstr("No peak was found in 3 of 12 runs"));
    EXPECT_THAT(page, HasSubstr("<th scope=\"col\">no peak</th>"));
}

/// Tables of earlier versions do not say how a test ended.
TEST_F(CampaignReport, ReadsTablesOfEarlierVersions) {
    const auto dir = campaign(4);
    const std::string page = read_file(write_campaign_report(dir));
    for (const char* name : {"results.csv", "deterministic.csv"}) {
        const std::string table = read_file(dir / name);
        const std::string earlier =
            replaced(replaced(table, ",failure,end_reason", ""), says_nothing, ",2,,");
        EXPECT_LT(earlier.size() + 2 * 3, table.size());
        write_file(dir / name, earlier);
    }
    EXPECT_EQ(read_file(write_campaign_report(dir)), page);
}

TEST_F(CampaignReport, StatisticsAreThoseOfTheRows) {
    const auto dir = campaign(60);
    write_campaign_report(dir);
    // E50 of the first case, from the table of results.
    double sum = 0, squares = 0;
    int n = 0;
    std::istringstream lines(read_file(dir / "results.csv"));
    const std::string name = "correlation_length=100x10x100";
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> f;
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
        if (f[0] != name || f[3] != "done") continue;
        const double E50 = std::stod(f[5]) / 1e6;
        ++n;
        sum += E50;
        squares += E50 * E50;
    }
    ASSERT_EQ(n, 60);
    const double mean = sum / n, deviation = std::sqrt((squares - n * mean * mean) / (n - 1));
    const std::string table = read_file(dir / "statistics.csv");
    const std::string begin = name + ",e50,MPa,60,0,31,";
    const auto at = table.find(begin);
    ASSERT_NE(at, std::string::npos) << table;
    std::istringstream rest(table.substr(at + begin.size()));
    std::vector<double> numbers;
    for (std::string field; numbers.size() < 6 && std::getline(rest, field, ',');)
        numbers.push_back(std::stod(field));
    EXPECT_NEAR(numbers[0], mean, 1e-12 * mean);
    EXPECT_LT(numbers[1], mean);
    EXPECT_GT(numbers[2], mean);
    EXPECT_NEAR(numbers[3], deviation, 1e-9 * deviation);
    EXPECT_LT(numbers[4], deviation);
    EXPECT_GT(numbers[5], deviation);
}

TEST_F(CampaignReport, OfACampaignThatHasJustBegunIsWhole) {
    for (const std::int64_t rows : {0, 1, 2, 5, 9}) {
        const std::string page = read_file(write_campaign_report(campaign(rows)));
        EXPECT_THAT(page, HasSubstr("Case correlation_length=10x1x10")) << rows;
        EXPECT_EQ(fixture::occurrences(page, "<svg"), rows < 2   ? 0u
                                                      : rows < 3 ? 2u
                                                      : rows < 8 ? 2u + 6u
                                                                 : 2u + 18u)
            << rows;
        // What has too few runs says so once.
        EXPECT_EQ(fixture::occurrences(page, "drawn from 3 runs on"), rows < 3 ? 3u : 0u) << rows;
        EXPECT_EQ(fixture::occurrences(page, "drawn from 8 runs on"),
                  rows < 3 || rows > 7 ? 0u : 3u)
            << rows;
        EXPECT_EQ(fixture::occurrences(page, "no case has them"), rows < 8 ? 1u : 0u) << rows;
        EXPECT_EQ(fixture::occurrences(page, "Fits by maximum likelihood"), rows < 8 ? 0u : 1u);
        EXPECT_EQ(fixture::occurrences(page, "are left out"), rows < 2 ? 1u : 0u) << rows;
        // No section stands empty.
        EXPECT_FALSE(std::regex_search(page, std::regex("</h2>\\s*<h2>"))) << rows;
    }
}

TEST_F(CampaignReport, SmallPValuesHaveNoMoreDigitsThanTheySay) {
    // Peaks that are normal with a COV of 0.3 are not lognormal.
    const std::string page = read_file(write_campaign_report(campaign(60, config, 18)));
    EXPECT_THAT(page, HasSubstr("<td>&lt;\u00a00.001</td>"));
    EXPECT_FALSE(std::regex_search(page, std::regex("<td>(0\\.000|[0-9.]+e-)")));
}

TEST_F(CampaignReport, CasesStandInTheOrderOfTheirNumbers) {
    const std::string page = read_file(write_campaign_report(campaign(1)));
    std::size_t last = 0;
    for (const char* length : {"1x0.1x1", "10x1x10", "100x10x100"}) {
        const std::size_t at =
            page.find(fmt::format("<h2>Case correlation_length={}</h2>", length));
        ASSERT_NE(at, std::string::npos) << length;
        EXPECT_GT(at, last) << length;
        last = at;
    }
    EXPECT_THAT(page, HasSubstr("3 realizations over 3 cases are done"));
}

TEST_F(CampaignReport, OfOneCaseWhoseRunsAreAllTheSame) {
    const char* text = "field.variable = 'stiffness'\nmontecarlo.realizations = 12\n";
    const std::string page = read_file(write_campaign_report(campaign(12, text, 0)));
    EXPECT_THAT(page, HasSubstr("12 realizations over 1 case are done, 0 failed"));
    EXPECT_THAT(page, HasSubstr("Keys that vary: none."));
    EXPECT_THAT(page, HasSubstr("All runs gave the same modulus"));
    EXPECT_THAT(page, HasSubstr("All runs gave the same peak deviator stress"));
    EXPECT_EQ(fixture::occurrences(page, "<svg"), 0u);
}

TEST_F(CampaignReport, TrendsGroupTheCasesThatAgreeInAllElse) {
    const auto dir = campaign(3, std::string(config) + "'field.stiffness.cov' = [0.4, 0.8]\n");
    const report::CampaignData data = report::read_campaign_data(dir);
    EXPECT_THAT(data.varying,
                testing::ElementsAre("field.correlation_length", "field.stiffness.cov"));
    const auto trends = report::trends_over(data, "field.correlation_length");
    ASSERT_EQ(trends.size(), 2u);
    EXPECT_EQ(trends[0].name, "COV of kₙ = 0.4");
    ASSERT_EQ(trends[0].points.size(), 3u);
    EXPECT_EQ(trends[0].points[0].x, 0.1);
    EXPECT_EQ(trends[0].points[2].x, 10);
    const auto over_cov = report::trends_over(data, "field.stiffness.cov");
    ASSERT_EQ(over_cov.size(), 3u);
    EXPECT_EQ(over_cov[0].name, "θ = 1, 0.1, 1 m");
    EXPECT_EQ(over_cov[2].name, "θ = 100, 10, 100 m");
}

TEST_F(CampaignReport, TrendsTakeNumbersAndTheSecondOfThree) {
    report::CampaignData data;
    data.varying = {"field.correlation_length", "particle.friction_angle"};
    const std::vector<std::pair<const char*, std::size_t>> cases{
        {"2.5", 2},      {"[9, 0.5, 9]", 2}, {"[9, 1]", 2}, {"[9, 'b', 9]", 2},
        {"[1, 2, 3", 2}, {"\"text\"", 2},    {"7", 1},      {"]", 2}};
    for (const auto& [value, rows] : cases) {
        report::CaseData& one = data.cases.emplace_back();
        one.values["field.correlation_length"] = value;
        one.rows.resize(rows);
    }
    data.cases.emplace_back().rows.resize(2);  // an older one, without the key
    const auto trends = report::trends_over(data, "field.correlation_length");
    ASSERT_EQ(trends.size(), 1u);
    EXPECT_EQ(trends[0].name, "φ = not set");
    ASSERT_EQ(trends[0].points.size(), 2u);
    EXPECT_EQ(trends[0].points[0].x, 0.5);
    EXPECT_EQ(trends[0].points[1].x, 2.5);
    EXPECT_TRUE(report::trends_over(data, "particle.friction_angle").empty());
}

TEST_F(CampaignReport, TrendsHaveTheUnitsOfTheirAxes) {
    const auto dir = campaign(3,
                              "[montecarlo]\nrealizations = 3\ndeterministic = false\n"
                              "[montecarlo.sweep]\n'triaxial.confining_stress' = [1e4, 1e6]\n"
                              "'particle.friction_angle' = [0.4, 0.6]\n");
    const report::CampaignData data = report::read_campaign_data(dir);
    const auto trends = report::trends_over(data, "triaxial.confining_stress");
    ASSERT_EQ(trends.size(), 2u);
    EXPECT_EQ(trends[0].points[0].x, 10) << "kPa";
    const std::string page = read_file(write_campaign_report(dir));
    EXPECT_THAT(page, HasSubstr("Confining stress"));
    EXPECT_THAT(page, HasSubstr("Friction angle"));
    const auto lines = report::trends_over(data, "particle.friction_angle");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].name, "σ₃ = 10 kPa");
    EXPECT_EQ(lines[1].name, "σ₃ = 1000 kPa");
}

TEST_F(CampaignReport, DrawsCasesThatDifferInATextKey) {
    const auto dir = campaign(3, std::string(config) +
                                     "[[montecarlo.case]]\nname = 'A'\nset.field.variable = "
                                     "'friction'\n[[montecarlo.case]]\nname = 'B'\n");
    const std::string page = read_file(write_campaign_report(dir));
    EXPECT_THAT(page, HasSubstr("variable = friction"));
    EXPECT_THAT(page, HasSubstr("variable = stiffness"));
}

TEST_F(CampaignReport, DamagedTablesAreNamed) {
    const auto dir = campaign(3);
    std::string text = read_file(dir / "results.csv");
    text.replace(text.find(",done,") + 6, 3, "abc");
    write_file(dir / "results.csv", text);
    try {
        write_campaign_report(dir);
        FAIL() << "no error";
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("results.csv:2: a number is expected"));
    }
    EXPECT_FALSE(std::filesystem::exists(dir / "report.html"));
}

TEST_F(CampaignReport, RendersInABrowserWithoutErrors) {
    if (!std::filesystem::exists(fixture::chromium)) GTEST_SKIP() << "chromium is not installed";
    const auto page = write_campaign_report(campaign(60));
    const auto picture = folder_.path() / "page.png";
    const std::string log = fixture::browser(folder_.path(), page, 7000,
                                             fmt::format("--screenshot='{}'", picture.string()));
    EXPECT_EQ(log.find("CONSOLE"), std::string::npos) << log;
    // A blank page of this size compresses to some 30 kB.
    EXPECT_GT(std::filesystem::file_size(picture), 400'000U);
    // Every figure is in the browser's own tree, too.
    const std::string tree = fixture::browser(folder_.path(), page, 7000, "--dump-dom");
    EXPECT_EQ(fixture::occurrences(tree, "<svg"), 20u);
    EXPECT_EQ(fixture::occurrences(tree, "<figcaption>"), 20u);
}

}  // namespace
}  // namespace grainfield::triaxial
