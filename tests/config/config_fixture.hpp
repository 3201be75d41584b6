#pragma once
// A folder of its own for each test, and the message an action fails with.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/errors.hpp"

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

/// what() of the Error that the action throws; "no error" (and a failure) where it throws none.
template <class Error, class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "no error was thrown";
    return "no error";
}

}  // namespace grainfield::triaxial
