// Tests that ended before their peak: every row says so, and so does the campaign's page.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

/// The values of a column of a campaign's table of texts.
std::vector<std::string> column_of(const std::string& text, const std::string& name) {
    std::istringstream lines(text);
    std::vector<std::string> values;
    std::size_t wanted = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::vector<std::string> row;
        for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
        if (values.empty()) {
            while (wanted < row.size() && row[wanted] != name) ++wanted;
        }
        values.push_back(row.at(wanted));
    }
    values.erase(values.begin());
    return values;
}

class CutShort : public testing::Test {
  protected:
    Outcome campaign(const std::string& more) {
        const std::string config = place_.write(
            "c.toml", "[field]\nvariable = \"stiffness\"\n[montecarlo]\nrealizations = 2\n" + more);
        return place_.run({"montecarlo", config, "--packing", place_.write("P.txt", text_),
                           "--threads", "1", "--out", place_.path("c")});
    }
    std::string page() {
        EXPECT_EQ(place_.run({"report", place_.path("c")}).code, 0);
        return place_.read("c/report.html");
    }
    Workplace place_;
    std::string text_ = [] {
        std::string text;
        const core::ParticleStore& s = packing().spheres;
        std::ostringstream out;
        out.precision(10);
        for (std::size_t i = 0; i < s.size(); ++i)
            out << s.position.x[i] << ' ' << s.position.y[i] << ' ' << s.position.z[i] << ' '
                << s.radius[i] << '\n';
        return out.str();
    }();
};

// "peak 96.6 +- 17.8 kPa" once stood there without a word.
TEST_F(CutShort, AllOfACampaign) {
    const Outcome outcome = campaign("[triaxial]\nmax_axial_strain = 0.003\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "; 2 without a peak")) << outcome.out;
    for (const char* table : {"c/results.csv", "c/deterministic.csv"}) {
        for (const std::string& failure : column_of(place_.read(table), "failure"))
            EXPECT_EQ(failure, "strain-limit") << table;
        for (const std::string& reason : column_of(place_.read(table), "end_reason"))
            EXPECT_EQ(reason, "asked") << table;
    }
    EXPECT_TRUE(has(page(), "No peak was found in 2 of 2 runs"));
}

// So once did numbers of tests far from quasi-static.
TEST_F(CutShort, TestsTooFast) {
    const Outcome outcome = campaign("[triaxial]\nmax_axial_strain = 0.003\nstrain_rate = 0.2\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "; 2 with a warning")) << outcome.out;
    const std::string warnings = place_.read("c/warnings.csv");
    EXPECT_TRUE(has(warnings, "base,-1,\"not quasi-static: the inertial number is")) << warnings;
    EXPECT_TRUE(has(warnings, "base,1,\"not quasi-static: the inertial number is")) << warnings;
    EXPECT_TRUE(has(page(), "2 of 2 runs carry a warning"));
}

TEST_F(CutShort, OneCaseOfTwo) {
    const Outcome outcome =
        campaign("[montecarlo.sweep]\n\"triaxial.max_axial_strain\" = [0.002, 0.03]\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "; 2 without a peak")) << outcome.out;
    const auto failures = column_of(place_.read("c/results.csv"), "failure");
    ASSERT_EQ(failures.size(), 4u);
    EXPECT_EQ(failures[0], "strain-limit");
    EXPECT_EQ(failures[1], "strain-limit");
    const auto whole = 4 - std::count(failures.begin(), failures.end(), "strain-limit");
    EXPECT_TRUE(has(page(), "No peak was found in " + std::to_string(4 - whole) + " of 4 runs"));
}

TEST_F(CutShort, ASingleTest) {
    const Outcome outcome = shear(place_, place_.write("P.txt", text_));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "largest deviator stress"));
    EXPECT_TRUE(has(outcome.out, "no peak before the end"));
    const nlohmann::json summary = place_.json("run/summary.json");
    EXPECT_EQ(summary.at("peak_found"), false);
    EXPECT_EQ(summary.at("failure"), "strain-limit");
    EXPECT_EQ(summary.at("end_reason"), "asked");
    EXPECT_TRUE(has(place_.read("run/report.html"), "No peak was found"));
}

}  // namespace
}  // namespace grainfield::case_tests
