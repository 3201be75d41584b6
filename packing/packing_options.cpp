#include "packing/packing_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/base/errors.hpp"

namespace grainfield::packing {
namespace {

template <class T>
void require(bool allowed, const char* key, const T& value, const char* expected) {
    if (!allowed) throw InputError(fmt::format("{} = {}: {}", key, value, expected));
}

// Comparisons with nan are false: every check says what is allowed, not what is refused.
bool is_positive(double value) {
    return std::isfinite(value) && value > 0;
}

/// Whether every element may follow the one before it.
template <class MayFollow>
bool in_order(const std::vector<double>& values, MayFollow may_follow) {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!may_follow(values[i - 1], values[i])) return false;
    return true;
}

}  // namespace

void Grading::validate() const {
    constexpr auto sieves = "grading.sieve_diameter";
    constexpr auto share = "grading.passing";
    require(sieve_diameter.size() >= 2, sieves, sieve_diameter,
            "at least 2 sieve sizes are expected");
    require(is_positive(sieve_diameter.front()) && std::isfinite(sieve_diameter.back()) &&
                in_order(sieve_diameter, [](double a, double b) { return a < b; }),
            sieves, sieve_diameter,
            "overlapping sieve sizes: numbers > 0, each larger than the one before, are expected");
    require(passing.size() == sieve_diameter.size(), share, passing,
            fmt::format("{} numbers, one a sieve, are expected", sieve_diameter.size()).c_str());
    require(passing.front() == 0 && passing.back() == 100 &&
                in_order(passing, [](double a, double b) { return a <= b; }),
            share, passing, "percentages that start at 0, never fall and end at 100 are expected");
}

void PackingOptions::validate() const {
    require(porosity > 0.2 && porosity < 0.9, "packing.porosity", porosity,
            "a number in (0.2, 0.9) is expected");
    const std::array sides{block.x(), block.y(), block.z()};
    require(is_positive(sides[0]) && is_positive(sides[1]) && is_positive(sides[2]),
            "packing.block", sides, "3 numbers > 0 are expected");
    require(blocks[0] >= 1 && blocks[1] >= 1 && blocks[2] >= 1, "packing.blocks", blocks,
            "3 whole numbers >= 1 are expected");
    // In floating point: three counts of 32 bits overflow 64.
    require(double(blocks[0]) * blocks[1] * blocks[2] < 2147483648.0, "packing.blocks", blocks,
            "fewer than 2^31 blocks in all are expected");
    require(is_positive(gravity), "packing.gravity", gravity, "a number > 0 is expected");
    if (relative_density)
        require(*relative_density >= 0 && *relative_density <= 1, "packing.relative_density",
                *relative_density, "a number in [0, 1] is expected");
    if (compaction_friction) {
        require(*compaction_friction >= 0 && *compaction_friction < 0.5 * std::numbers::pi,
                "packing.compaction_friction", *compaction_friction,
                "an angle in [0, pi/2) rad is expected");
        require(!relative_density, "packing.compaction_friction", *compaction_friction,
                "each sets the density: not beside packing.relative_density");
    }
    if (spheres)
        require(*spheres >= 1, "packing.spheres", *spheres, "a whole number >= 1 is expected");
    require(max_spheres >= 1 && max_spheres <= most_spheres, "packing.max_spheres", max_spheres,
            "a whole number in [1, 500000000] is expected");
    if (isotropic_stress)
        require(is_positive(*isotropic_stress), "packing.isotropic_stress", *isotropic_stress,
                "a number > 0 is expected");
}

}  // namespace grainfield::packing
