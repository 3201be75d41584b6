// The page in a real browser: it opens from disk and something is to be seen.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/report/browser.hpp"
#include "tests/report/run_fixture.hpp"
#include "triaxial/report/report.hpp"

namespace grainfield::triaxial {
namespace {

TEST(ReportInBrowser, Renders) {
    if (!std::filesystem::exists(fixture::chromium)) GTEST_SKIP() << "chromium is not installed";
    const fixture::TestFolder folder;
    fixture::write_run(folder.path(), {.field = fixture::Field::stiffness});
    const auto page = write_report(folder.path());
    const auto picture = folder.path() / "page.png";
    fixture::browser(folder.path(), page, 4600, fmt::format("--screenshot='{}'", picture.string()));
    // A blank page of this size compresses to some 20 kB; text, figures and spheres do not.
    EXPECT_GT(std::filesystem::file_size(picture), 300'000U);
}

}  // namespace
}  // namespace grainfield::triaxial
