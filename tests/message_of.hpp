#pragma once
// The message that an action fails with.

#include <gtest/gtest.h>

#include <exception>
#include <string>

namespace grainfield {

/// what() of the Error that the action throws; empty, and a failed check, where it throws none or
/// another.
template <class Error, class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    } catch (const std::exception& other) {
        ADD_FAILURE() << "another error: " << other.what();
        return {};
    }
    ADD_FAILURE() << "no error";
    return {};
}

}  // namespace grainfield
