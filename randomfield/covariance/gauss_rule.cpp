#include "randomfield/covariance/gauss_rule.hpp"

#include <cmath>
#include <numbers>

namespace grainfield::randomfield {
namespace {

// The zeros of the Legendre polynomial by Newton's method in long double, so that the points are
// right to the last bit or the one before it.
GaussRule rule_of(std::size_t size) {
    GaussRule rule;
    rule.size = size;
    const auto n = static_cast<long double>(size);
    for (std::size_t i = 0; i < size; ++i) {
        long double x = -std::cos(std::numbers::pi_v<long double> *
                                  (static_cast<long double>(i) + 0.75L) / (n + 0.5L));
        long double slope = 1.0L;
        for (int iteration = 0; iteration < 8; ++iteration) {
            long double p = 1.0L, before = 0.0L;
            for (std::size_t k = 0; k < size; ++k) {
                const auto m = static_cast<long double>(k);
                const long double next = ((2 * m + 1) * x * p - m * before) / (m + 1);
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        rule.node[i] = static_cast<double>((1 + x) / 2);
        rule.weight[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace

const GaussRule& gauss_rule(std::size_t size) {
    static const auto rules = [] {
        std::array<GaussRule, GaussRule::max_size + 1> all;
        for (std::size_t n = 1; n < all.size(); ++n) all[n] = rule_of(n);
        return all;
    }();
    return rules.at(size);
}

}  // namespace grainfield::randomfield
