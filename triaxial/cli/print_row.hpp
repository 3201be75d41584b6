#pragma once
// Results on stdout, one named value a line.

#include <fmt/format.h>

#include <string_view>

#include "triaxial/cli/standard_streams.hpp"

namespace grainfield::triaxial {

inline void print_row(std::string_view name, std::string_view value) {
    constexpr std::size_t column = 24;
    const std::string_view gap = name.size() < column ? "" : "  ";  // longer names
    write_result(fmt::format("{:<{}}{}{}\n", name, column, gap, value));
}

}  // namespace grainfield::triaxial
