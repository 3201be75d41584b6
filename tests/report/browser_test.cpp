// The page in a real browser: it opens from disk and something is to be seen.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/report/run_fixture.hpp"
#include "triaxial/report/report.hpp"

namespace grainfield::triaxial {
namespace {

TEST(ReportInBrowser, Renders) {
    const std::filesystem::path chromium = "/usr/bin/chromium";
    if (!std::filesystem::exists(chromium)) GTEST_SKIP() << chromium << " is not installed";
    const testing::TestFolder folder;
    testing::write_run(folder.path(), {.field = testing::Field::stiffness});
    const auto page = write_report(folder.path());
    const auto picture = folder.path() / "page.png";
    const std::string command = fmt::format(
        "timeout 120 {} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync "
        "--hide-scrollbars --user-data-dir='{}' --window-size=1100,4600 --screenshot='{}' "
        "'file://{}' >'{}' 2>&1",
        chromium.string(), (folder.path() / "profile").string(), picture.string(), page.string(),
        (folder.path() / "chromium.log").string());
    ASSERT_EQ(std::system(command.c_str()), 0)
        << testing::read_file(folder.path() / "chromium.log");
    // A blank page of this size compresses to some 20 kB; text, figures and spheres do not.
    EXPECT_GT(std::filesystem::file_size(picture), 300'000U);
}

}  // namespace
}  // namespace grainfield::triaxial
