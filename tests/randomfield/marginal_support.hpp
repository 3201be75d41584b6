#pragma once
// One example of every marginal, and some at the edges of what is allowed.

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "randomfield/marginals/marginal_options.hpp"

namespace grainfield::randomfield {

struct NamedMarginal {
    std::string name;
    MarginalOptions options;
};

inline void PrintTo(const NamedMarginal& one, std::ostream* out) {
    *out << one.name;
}

inline std::vector<NamedMarginal> example_marginals() {
    using enum MarginalKind;
    return {{"bounded", {bounded, 0.3, 0.9, 2.0, 0.0, 0.0}},
            {"lognormal", {lognormal, {}, {}, 2.0, 9e8, 0.8}},
            {"normal", {normal, {}, {}, 2.0, 0.6, 0.15}},
            {"truncated_normal", {truncated_normal, 0.3, 0.9, 2.0, 0.5, 0.3}},
            {"window_in_the_tail", {truncated_normal, 0.7, 0.9, 2.0, 0.4, 0.2}},
            {"beta", {beta, 1e8, 5e9, 2.0, 9e8, 0.6}},
            {"weibull", {weibull, {}, {}, 2.0, 9e8, 0.8}},
            {"steep_weibull", {weibull, {}, {}, 2.0, 0.6, 0.05}}};
}

inline MarginalOptions example(const std::string& name) {
    for (const NamedMarginal& one : example_marginals())
        if (one.name == name) return one.options;
    throw std::out_of_range(name);
}

}  // namespace grainfield::randomfield
