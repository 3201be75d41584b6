// A file holds one concept: no source, script or build file passes 500 lines.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {
namespace {

constexpr std::size_t most_lines = 500;

bool is_counted(const std::string& path) {
    return is_cpp(path) || path.ends_with(".py") || path.ends_with(".sh") ||
           path.ends_with(".cmake") || path.ends_with("CMakeLists.txt") || path == "dev";
}

bool is_too_long(const SourceFile& file) {
    return is_counted(file.path) && split_lines(file.text).size() > most_lines;
}

std::string lines(std::size_t n) {
    std::string text;
    for (std::size_t k = 0; k < n; ++k) text += "x\n";
    return text;
}

TEST(FileSize, NoSourceIsTooLong) {
    std::size_t counted = 0;
    for (const SourceFile& file : text_files(GRAINFIELD_SOURCE_DIR)) {
        counted += is_counted(file.path) ? 1 : 0;
        EXPECT_FALSE(is_too_long(file))
            << file.path << " has " << split_lines(file.text).size() << " lines";
    }
    EXPECT_GT(counted, 10U) << "the walk found next to nothing";
}

TEST(FileSize, TheCheckerCounts) {
    EXPECT_FALSE(is_too_long({"core/a.cpp", lines(most_lines)}));
    EXPECT_FALSE(is_too_long({"core/a.cpp", lines(most_lines - 1) + "no newline at the end"}));
    EXPECT_TRUE(is_too_long({"core/a.cpp", lines(most_lines) + "one more"}));
    EXPECT_TRUE(is_too_long({"dev", lines(most_lines + 1)}));
    EXPECT_FALSE(is_too_long({"bench/results/a.csv", lines(most_lines + 1)}));
}

}  // namespace
}  // namespace grainfield::repository
