#pragma once
// Gauss-Legendre rules on [0, 1].

#include <array>
#include <cstddef>

namespace grainfield::randomfield {

struct GaussRule {
    static constexpr std::size_t max_size = 20;
    std::size_t size = 0;
    std::array<double, max_size> node{};    ///< ascending, in (0, 1) [-]
    std::array<double, max_size> weight{};  ///< their sum is 1 [-]
};

/// The rule with 1 ... GaussRule::max_size points, exact for polynomials up to degree 2 size - 1.
const GaussRule& gauss_rule(std::size_t size);

}  // namespace grainfield::randomfield
