// What is committed names no folder of the machine it was written on and leaves nothing for later.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Written in pieces so that this file passes its own test.
const std::string work =
    "/wo"
    "rk/";
const std::string root_home =
    "/ro"
    "ot/";
const std::string users_home =
    "/ho"
    "me/";
const std::string later =
    "TO"
    "DO";
const std::string broken =
    "FIX"
    "ME";

/// The faults of one file, each as `path:line: text`.
std::vector<std::string> faults_of_text(const SourceFile& file) {
    // An absolute path begins a word: "frame" + "/wo" + "rk/" in the middle of one is none.
    static const std::regex machine_path("(^|[^A-Za-z0-9_.)}*~-])(" + work + "|" + root_home + "|" +
                                         users_home + ")");
    static const std::regex left_over("\\b(" + later + "|" + broken + ")\\b");
    std::vector<std::string> faults;
    const std::vector<std::string> lines = split_lines(file.text);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (lines[k].size() > 10'000) continue;  // data or a figure on one line
        if (std::regex_search(lines[k], machine_path) || std::regex_search(lines[k], left_over))
            faults.push_back(file.path + ":" + std::to_string(k + 1) + ": " + lines[k]);
    }
    return faults;
}

TEST(Text, NamesNoMachineAndLeavesNothingForLater) {
    std::size_t files = 0;
    for (const SourceFile& file : text_files(GRAINFIELD_SOURCE_DIR)) {
        ++files;
        EXPECT_THAT(faults_of_text(file), IsEmpty());
    }
    EXPECT_GT(files, 10U) << "the walk found next to nothing";
}

TEST(TextChecker, FindsMachinePaths) {
    for (const std::string& folder : {work, root_home, users_home}) {
        EXPECT_THAT(faults_of_text({"a", "x\nopen(\"" + folder + "a.csv\")"}),
                    ElementsAre(HasSubstr("a:2: ")));
        EXPECT_THAT(faults_of_text({"a", folder}), ElementsAre(HasSubstr("a:1: ")));
        EXPECT_THAT(faults_of_text({"a", "friction" + folder + "s"}), IsEmpty());
    }
}

TEST(TextChecker, FindsWhatIsLeftForLater) {
    EXPECT_THAT(faults_of_text({"a", "// " + later + ": all of it"}),
                ElementsAre("a:1: // " + later + ": all of it"));
    EXPECT_THAT(faults_of_text({"a", broken}), ElementsAre("a:1: " + broken));
    EXPECT_THAT(faults_of_text({"a",
                                "MASTO"
                                "DONS roam"}),
                IsEmpty());
}

}  // namespace
}  // namespace grainfield::repository
