#include "tests/reliability/record.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace grainfield::reliability {

void record(const std::string& kind,
            const std::vector<std::pair<std::string, std::string>>& values) {
    const char* folder = std::getenv("GRAINFIELD_RELIABILITY");  // NOLINT(concurrency-mt-unsafe)
    if (folder == nullptr) return;
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    nlohmann::json line = {{"test", std::string(test->test_suite_name()) + "." + test->name()}};
    for (const auto& [key, value] : values) line[key] = value;
    std::filesystem::create_directories(folder);
    // One write a line: tests that run side by side add to the same file.
    std::ofstream stream(std::filesystem::path(folder) / (kind + ".jsonl"), std::ios::app);
    stream << line.dump() + "\n";
    EXPECT_TRUE(stream.flush().good()) << "cannot record " << kind;
}

}  // namespace grainfield::reliability
