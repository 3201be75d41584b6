// The page itself: what is committed has a section for every scene, and the page's program keeps
// the worst of what it is given. That every recorded check has its row, record() looks itself.

#include "tests/verification/page/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace grainfield::verify {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path scene_folder = GRAINFIELD_SOURCE_DIR "/tests/verification/scenes";

std::string committed_page() {
    std::ifstream stream(GRAINFIELD_SOURCE_DIR "/tests/VERIFICATION.md");
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(VerificationPage, HasEverySceneWithItsCommand) {
    if (std::getenv("GRAINFIELD_VERIFICATION") != nullptr)
        GTEST_SKIP() << "the page is being written anew";
    const std::string page = committed_page();
    int count = 0;
    for (const auto& entry : fs::directory_iterator(scene_folder)) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(fs::exists(entry.path() / "scene.toml")) << name;
        // The plain scene that others are compared with has no row of its own.
        if (name == "assembly") continue;
        ++count;
        EXPECT_THAT(page,
                    HasSubstr("\n## " + name + "\n\n`grainfield simulate tests/verification/" +
                              "scenes/" + name + "/scene.toml --out out/" + name + "`\n"))
            << "run `./dev verify`";
    }
    EXPECT_GE(count, 15);
    EXPECT_GT(rows_of_page(page).size(), 100U);
}

nlohmann::json record_of(const std::string& quantity, const std::string& kernel, double computed) {
    return {{"scene", "a"},    {"quantity", quantity}, {"closed_form", "1"}, {"source", "s"},
            {"unit", "m"},     {"why", "round-off"},   {"scale", 0.0},       {"kernel", kernel},
            {"expected", 1.0}, {"computed", computed}, {"tolerance", 0.5}};
}

class PageOfRecords : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    void write(const std::string& name, const nlohmann::json& records) const {
        std::ofstream(folder / name) << nlohmann::json{{"test", name}, {"records", records}};
    }
    const fs::path folder =
        fs::temp_directory_path() / ("grainfield_page_" + std::to_string(::getpid()));
};

TEST_F(PageOfRecords, KeepsTheWorstOfEachPrecision) {
    write("one.json",
          {record_of("x | y", "reference", 1.125), record_of("x | y", "a_mixed", 0.75)});
    write("two.json", {record_of("x | y", "avx2_double", 1.0), record_of("x | y", "b_mixed", 1.0)});
    const std::string page = page_of(folder, scene_folder);
    EXPECT_THAT(page, HasSubstr("| 1.125 m | 1.2e-01 | 5.0e-01 | 0.75 m | 2.5e-01 | 5.0e-01 |"));
    EXPECT_THAT(page, HasSubstr("1 rows, 4 checks"));
    EXPECT_THAT(page, HasSubstr("reference"));
    EXPECT_THAT(page, HasSubstr("the machine lacks them: avx512."));
    EXPECT_THAT(page, Not(HasSubstr("grainfield simulate")));
    EXPECT_EQ(rows_of_page(page), (std::set<RowName>{{"a", "x | y"}}));
}

TEST_F(PageOfRecords, RefusesAnEmptyFolder) {
    EXPECT_THROW(page_of(folder, scene_folder), std::runtime_error);
    EXPECT_THROW(page_of(folder / "none", scene_folder), std::runtime_error);
}

}  // namespace
}  // namespace grainfield::verify
