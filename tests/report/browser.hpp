#pragma once
// A page in a real browser, Debian's chromium, without a screen.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/report/run_fixture.hpp"

namespace grainfield::triaxial::fixture {

inline constexpr const char* chromium = "/usr/bin/chromium";

/// What it says of a page, called with these options; its files go to `folder`.
inline std::string browser(const std::filesystem::path& folder, const std::filesystem::path& page,
                           int height, const std::string& options) {
    const auto log = folder / "chromium.log";
    const std::string command = fmt::format(
        "timeout 120 {} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync "
        "--hide-scrollbars --enable-logging=stderr --user-data-dir='{}' --window-size=1100,{} {} "
        "'file://{}' >'{}' 2>&1",
        chromium, (folder / "profile").string(), height, options, page.string(), log.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << read_file(log);
    return read_file(log);
}

}  // namespace grainfield::triaxial::fixture
