#pragma once
// A folder of its own for each test.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/base/errors.hpp"
#include "tests/message_of.hpp"

namespace grainfield::triaxial {

class ConfigTest : public ::testing::Test {
  protected:
    ConfigTest() { std::filesystem::create_directories(folder_); }
    ~ConfigTest() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, std::string_view text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        ("grainfield_config_" + std::to_string(::getpid()) + "_" +
         ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace grainfield::triaxial
