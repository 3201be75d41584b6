// The page and the tables of repeats: the statistics are right, every curve is drawn.

#include "triaxial/report/repeats/repeats_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/errors.hpp"
#include "tests/report/run_fixture.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/report/repeats/repeats_data.hpp"

namespace grainfield::triaxial {
namespace {

using fixture::read_file;
using fixture::write_file;
using testing::HasSubstr;
using testing::Not;

class RepeatsReport : public testing::Test {
  protected:
    /// A series with these largest deviator stresses [kPa]; E50 is the same in all.
    std::filesystem::path series(const std::vector<double>& peaks, const char* failure = "peak") {
        for (std::size_t k = 0; k < peaks.size(); ++k) {
            const auto dir = repeat_folder(folder_.path(), k);
            auto summary = fixture::write_run(dir, {.blocks = {1, 1, 1}, .spheres_per_block = 5});
            summary["peak_deviator_stress_Pa"] = 1e3 * peaks[k];
            summary["E50_Pa"] = 3e7;
            summary["axial_strain_at_peak"] = 0.01 + 0.001 * static_cast<double>(k);
            summary["failure"] = failure;
            summary["state_hash"] = fmt::format("{:016x}", k);
            write_file(dir / "summary.json", summary.dump());
        }
        const auto data = report::read_repeats(folder_.path(), peaks.size());
        write_file(folder_.path() / "repeats.json", report::repeats_json(data).dump());
        return folder_.path();
    }

    fixture::TestFolder folder_;
};

TEST_F(RepeatsReport, StatisticsAreThoseOfTextbooks) {
    const auto data = report::read_repeats(series({100, 104, 102}));
    const auto json = report::repeats_json(data);
    EXPECT_EQ(json["repeats"], 3);
    EXPECT_EQ(json["without_peak"], 0);
    const auto& peak = json["peak_deviator_stress_Pa"];
    // Quantiles of Student's t with 2 degrees of freedom at 0.975, of chi-square: that of 2
    // degrees of freedom is -2 ln(1 - p).
    const double t = 4.302652729911275, half = t * 2e3 / std::sqrt(3.0);
    const double low = 2e3 * std::sqrt(2 / (-2 * std::log(0.025)));
    const double high = 2e3 * std::sqrt(2 / (-2 * std::log(0.975)));
    const auto expect_number = [&](const char* key, double value) {
        EXPECT_NEAR(peak.at(key).get<double>(), value, 1e-9 * std::abs(value)) << key;
    };
    expect_number("mean", 102e3);
    expect_number("mean_low", 102e3 - half);
    expect_number("mean_high", 102e3 + half);
    expect_number("deviation", 2e3);
    expect_number("deviation_low", low);
    expect_number("deviation_high", high);
    expect_number("cov", 2.0 / 102);
    expect_number("cov_low", low / 102e3);
    expect_number("cov_high", high / 102e3);
    const auto& modulus = json["E50_Pa"];
    EXPECT_EQ(modulus["mean"], 3e7);
    EXPECT_EQ(modulus["deviation"], 0);
    EXPECT_NEAR(json["axial_strain_at_peak"]["deviation"].get<double>(), 0.001, 1e-12);
}

TEST_F(RepeatsReport, HasARowForEveryRepeat) {
    EXPECT_EQ(report::repeats_csv(report::read_repeats(series({100, 104}))),
              "repeat,peak_deviator_stress_Pa,E50_Pa,friction_angle_rad,axial_strain_at_peak,"
              "failure,end_reason,steps,state_hash\n"
              "0,100000,30000000,0.5,0.01,peak,peak,6321,0000000000000000\n"
              "1,104000,30000000,0.5,0.011,peak,peak,6321,0000000000000001\n");
}

TEST_F(RepeatsReport, HoldsTheTableAndTheFigure) {
    const std::string page = read_file(write_repeats_report(series({100, 104, 102})));
    EXPECT_EQ(fixture::occurrences(page, "<svg"), 1U);
    EXPECT_EQ(fixture::occurrences(page, "<figcaption>"), 1U);
    // Two groups of lines, repeat 0 and the others, and the marks.
    EXPECT_THAT(page, HasSubstr("repeats 1 to 2"));
    EXPECT_THAT(page, HasSubstr("largest of each"));
    EXPECT_THAT(page, HasSubstr("<td>102.0</td><td>97.03 … 107.0</td><td>2.00</td>"
                                "<td>1.04 … 12.6</td><td>1.96</td><td>1.02 … 12.3</td>"));
    EXPECT_THAT(page, HasSubstr("<td>104.0</td><td>1.100</td><td>30.00</td><td>28.65</td>"));
    EXPECT_THAT(page, Not(HasSubstr("No peak was found")));
}

TEST_F(RepeatsReport, CountsRepeatsWithoutAPeak) {
    const std::string page = read_file(write_repeats_report(series({100, 104}, "strain-limit")));
    EXPECT_THAT(page, HasSubstr("No peak was found in 2 of 2 repeats"));
}

TEST_F(RepeatsReport, StaysSmallWithManyRepeats) {
    const std::string page =
        read_file(write_repeats_report(series(std::vector<double>(60, 100.0))));
    EXPECT_LT(page.size(), 2'000'000U);
}

TEST_F(RepeatsReport, NamesTheFileThatIsMissingOrWrong) {
    const auto dir = series({100, 104});
    const auto message = [&] {
        try {
            write_repeats_report(dir);
        } catch (const FileError& error) {
            return std::string(error.what());
        }
        return std::string("nothing was thrown");
    };
    std::filesystem::remove(dir / "repeat1" / "curve.csv");
    EXPECT_THAT(message(), HasSubstr("repeat1/curve.csv"));
    write_file(dir / "repeats.json", R"({"repeats": 1})");
    EXPECT_THAT(message(), HasSubstr("key 'repeats' must be a whole number >= 2, is 1"));
}

}  // namespace
}  // namespace grainfield::triaxial
