#include "tests/verification/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "tests/verification/page/page.hpp"

namespace grainfield::verify {
namespace {

namespace fs = std::filesystem;

const char* records_folder() {
    return std::getenv("GRAINFIELD_VERIFICATION");  // NOLINT(concurrency-mt-unsafe)
}

/// The rows of the test that runs now; written when it ends.
nlohmann::json& rows() {
    static nlohmann::json present = nlohmann::json::array();
    return present;
}

/// True if the committed page has the row.
bool page_has(const Case& row) {
    static const std::set<RowName> names = [] {
        std::ifstream stream(GRAINFIELD_SOURCE_DIR "/tests/VERIFICATION.md");
        return rows_of_page({std::istreambuf_iterator<char>(stream), {}});
    }();
    return names.count({row.scene, row.quantity}) > 0;
}

class Writer : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo& /*test*/) override {
        rows() = nlohmann::json::array();
    }
    void OnTestEnd(const testing::TestInfo& test) override {
        if (records_folder() == nullptr || rows().empty()) return;
        std::string name = std::string(test.test_suite_name()) + "." + test.name();
        const nlohmann::json file = {{"test", name}, {"records", rows()}};
        std::replace(name.begin(), name.end(), '/', '_');
        fs::create_directories(records_folder());
        std::ofstream stream(fs::path(records_folder()) / (name + ".json"));
        stream << file.dump(1) << "\n";
        EXPECT_TRUE(stream.flush().good()) << "cannot write the records of " << name;
    }
};

// Before main(): listeners may not be added while a test runs.
[[maybe_unused]] const bool listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new Writer);
    return true;
}();

}  // namespace

void record(const Case& row, const std::string& kernel, double expected, double computed,
            double tolerance, const char* file, int line) {
    const testing::ScopedTrace trace(file, line, row.scene + ": " + row.quantity + ", " + kernel);
    EXPECT_NEAR(computed, expected, tolerance);
    if (records_folder() == nullptr) {
        EXPECT_TRUE(page_has(row)) << "tests/VERIFICATION.md lacks this row: run `./dev verify`";
        return;
    }
    rows().push_back({{"scene", row.scene},
                      {"quantity", row.quantity},
                      {"closed_form", row.closed_form},
                      {"source", row.source},
                      {"unit", row.unit},
                      {"why", row.tolerance},
                      {"scale", row.scale},
                      {"kernel", kernel},
                      {"expected", expected},
                      {"computed", computed},
                      {"tolerance", tolerance}});
}

}  // namespace grainfield::verify
