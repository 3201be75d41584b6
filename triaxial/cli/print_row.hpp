#pragma once
// Results on stdout, one named value a line.

#include <fmt/format.h>

#include <string_view>

#include "triaxial/cli/standard_streams.hpp"

namespace grainfield::triaxial {

inline void print_row(std::string_view name, std::string_view value) {
    write_result(fmt::format("{:<24}{}\n", name, value));
}

}  // namespace grainfield::triaxial
