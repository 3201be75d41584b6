// `report` on a stranger's folders: whatever stands where a name can stand is shown as it is and
// does nothing, neither in gnuplot nor in the browser.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/program/program.hpp"
#include "tests/report/hostile_names.hpp"
#include "tests/report/run_fixture.hpp"
#include "triaxial/campaign/row.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::program_tests {
namespace {

using triaxial::toml_string;

std::vector<std::string> names_for(const Workplace& place) {
    std::vector<std::string> names =
        triaxial::fixture::hostile_names("touch " + place.path("made"));
    names.emplace_back("<img src=x onerror=alert(1)>");
    names.emplace_back("</pre></title></style><script>alert(2)</script>");
    names.emplace_back("\" onload=\"alert(3)");
    names.emplace_back("]]><![CDATA[");
    return names;
}

void expect_harmless(const Workplace& place, const std::string& page) {
    EXPECT_FALSE(place.has("made")) << "a command was run";
    ASSERT_TRUE(page.ends_with("</html>\n"));
    for (const char* tag : {"<script", "<img src=x", "<![CDATA["})
        EXPECT_TRUE(page.find(tag) == std::string::npos) << tag;
    // Quotes end nothing outside of a tag.
    for (auto at = page.find("\" onload="); at != std::string::npos;
         at = page.find("\" onload=", at + 1))
        EXPECT_TRUE(page.rfind('>', at) > page.rfind('<', at)) << "in a tag";
}

TEST(HostileReport, OfACampaignRunsNothing) {
    const Workplace place;
    const std::vector<std::string> names = names_for(place);
    std::filesystem::create_directory(place.path("campaign"));
    nlohmann::ordered_json cases;
    std::vector<triaxial::Row> rows, deterministic;
    std::string failures = "case,realization,reason,state\n";
    // Two cases for each name, which is that of a case, of the key in which the two differ, of a
    // value of theirs and of their kernels. Rows of a table end with the line.
    for (std::size_t k = 0; k < 2 * names.size(); ++k) {
        const std::string& name = names[k / 2];
        std::string config = "field.variable = " + toml_string(name) + "\n";
        for (std::size_t key = 0; key < names.size(); ++key)
            config += fmt::format("{} = {}\n", toml_string(names[key]), key == k / 2 ? k % 2 : 0);
        std::string row_name = (k % 2 == 0 ? "" : "b ") + name;
        std::ranges::replace(row_name, '\n', ' ');
        cases[row_name] = {{"config", config}, {"kernels", name}};
        failures += fmt::format("{},0,\"{}\",{}\n", row_name, name, name);
        for (int run = 0; run < 2; ++run) {
            triaxial::Row row;
            row.case_name = row_name;
            row.realization = run;
            row.E50 = 3e7 + 1e6 * run + 1e5 * static_cast<double>(k);
            row.peak_deviator_stress = 1e5 + 1e3 * run;
            row.state_hash = "<script>alert(4)</script>";
            rows.push_back(row);
        }
        deterministic.push_back(rows.back());
    }
    cases["never run: " + names[4]] = {{"config", ""}, {"kernels", names[4]}};
    const nlohmann::ordered_json campaign{
        {"version", names.back()}, {"machines", names}, {"cases", cases}};
    place.write("campaign/campaign.json", campaign.dump(2));
    place.write("campaign/results.csv", triaxial::rows_csv(rows));
    place.write("campaign/deterministic.csv", triaxial::rows_csv(deterministic));
    place.write("campaign/failures.csv", failures);
    const Outcome report = place.run({"report", place.path("campaign")});
    ASSERT_EQ(report.code, 0) << report.err;
    const std::string page = place.read("campaign/report.html");
    EXPECT_TRUE(page.find("Over the cases") != std::string::npos) << "no figure has a name in it";
    expect_harmless(place, page);
}

TEST(HostileReport, OfRunsRunsNothing) {
    const Workplace place;
    const std::vector<std::string> names = names_for(place);
    // A name of a folder holds no slash.
    const auto folder = [&](std::string name) {
        std::ranges::replace(name, '/', '!');
        return place.path(name);
    };
    for (std::size_t k = 0; k + 1 < names.size(); k += 2) {
        SCOPED_TRACE(names[k]);
        const std::string run = folder("r" + names[k]), other = folder("o" + names[k + 1]);
        nlohmann::ordered_json summary = triaxial::fixture::write_run(run, {});
        triaxial::fixture::write_run(other, {.confining_stress = 200e3});
        for (const char* key :
             {"case", "end_reason", "precision", "isa", "version", "state_hash", "threads"})
            summary[key] = names[k];
        summary[names[k]] = names[k + 1];
        summary["wall_seconds"][names[k + 1]] = 1.0;
        summary["list"] = {names[k], names[k + 1]};
        std::ofstream(run + "/summary.json") << summary.dump();
        std::ofstream(run + "/config.toml") << toml_string(names[k]) << " = "
                                            << toml_string(names[k + 1]) << "  # </pre><script>\n";
        const Outcome report = place.run({"report", run, other});
        ASSERT_EQ(report.code, 0) << report.err;
        std::ifstream in(run + "/report.html");
        const std::string page{std::istreambuf_iterator<char>(in), {}};
        expect_harmless(place, page);
    }
}

}  // namespace
}  // namespace grainfield::program_tests
