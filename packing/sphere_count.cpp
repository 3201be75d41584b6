#include "packing/sphere_count.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/memory_limit.hpp"
#include "packing/grading.hpp"

namespace grainfield::packing {
namespace {

constexpr double bytes_a_sphere = 390;  // store, records and lists in mixed precision [B]

double solid_volume(const PackingOptions& options) {
    return (1 - options.porosity) * options.block.prod();
}

double blocks_in_all(const PackingOptions& options) {
    return double(options.blocks[0]) * options.blocks[1] * options.blocks[2];
}

/// Passing at a diameter within the sieves, linear between them [% by mass].
double passing_at(const Grading& grading, double diameter) {
    const auto& sieves = grading.sieve_diameter;
    const auto above = std::upper_bound(sieves.begin(), sieves.end(), diameter);
    if (above == sieves.begin()) return 0;
    if (above == sieves.end()) return 100;
    const auto k = static_cast<std::size_t>(above - sieves.begin());
    const double share = (diameter - sieves[k - 1]) / (sieves[k] - sieves[k - 1]);
    return grading.passing[k - 1] + share * (grading.passing[k] - grading.passing[k - 1]);
}

/// What would bring the count of a block down; a number that is rounded up to two digits.
std::string finest_that_does(const PackingOptions& options, const Grading& grading) {
    // The coarsest grains: sieves above that all pass have none between them.
    const auto all = std::find(grading.passing.begin(), grading.passing.end(), 100);
    const double last =
        grading.sieve_diameter[std::min(grading.sieve_diameter.size() - 1,
                                        static_cast<std::size_t>(all - grading.passing.begin()))];
    const auto few = [&](double finest) {
        return expected_spheres(without_finer(grading, finest), solid_volume(options)) <=
               options.max_spheres;
    };
    double low = grading.sieve_diameter.front(), high = 0.999 * last;
    if (!few(high)) return "";
    for (int halving = 0; halving < 100 && high > 1.001 * low; ++halving) {
        const double middle = std::sqrt(low * high);
        (few(middle) ? high : low) = middle;
    }
    const double digit = std::pow(10, std::floor(std::log10(high)) - 1);
    const double rounded = digit * std::ceil(high / digit);
    return rounded < last ? fmt::format("a finest sieve of {:.2g} m, ", rounded) : "";
}

}  // namespace

double spheres_a_block(const PackingOptions& options, const Grading& grading) {
    return options.spheres ? *options.spheres : expected_spheres(grading, solid_volume(options));
}

std::string sphere_count_text(const PackingOptions& options, const Grading& grading) {
    const double block = spheres_a_block(options, grading);
    return fmt::format("{}{:.0f} spheres in a block, {:.0f} in the sample",
                       options.spheres ? "" : "about ", std::max(1.0, block),
                       std::max(1.0, block) * blocks_in_all(options));
}

Grading without_finer(const Grading& grading, double diameter) {
    const double below = passing_at(grading, diameter);
    Grading coarser{{diameter}, {0}};
    for (std::size_t k = 0; k < grading.sieve_diameter.size(); ++k) {
        if (grading.sieve_diameter[k] <= diameter) continue;
        coarser.sieve_diameter.push_back(grading.sieve_diameter[k]);
        coarser.passing.push_back(100 * (grading.passing[k] - below) / (100 - below));
    }
    return coarser;
}

void require_countable(const PackingOptions& options, const Grading& grading) {
    const double block = spheres_a_block(options, grading);
    if (options.spheres && *options.spheres > options.max_spheres)
        throw InputError(fmt::format(
            "packing.spheres = {}: packing.max_spheres = {} are allowed in a block; give fewer, or "
            "a larger packing.max_spheres",
            *options.spheres, options.max_spheres));
    // Not a number, where sieves are of no size that numbers hold, is too many as well.
    if (!(block <= options.max_spheres)) {
        const NumberDistribution::Piece most = NumberDistribution(grading).most_numerous();
        throw InputError(fmt::format(
            "grading.sieve_diameter = {}: {} spheres are expected in a block, packing.max_spheres "
            "= {} are allowed; {}give {}a smaller packing.block or a larger packing.max_spheres",
            grading.sieve_diameter,
            std::isfinite(block) ? fmt::format("about {:.3g}", block) : "more than 1e300",
            options.max_spheres,
            std::isfinite(most.share)
                ? fmt::format("{:.3g} % of them are between the sieves of {:g} and {:g} m; ",
                              100 * most.share, most.fine, most.coarse)
                : "",
            finest_that_does(options, grading)));
    }
    const double blocks = blocks_in_all(options);
    const double allowed =
        std::min(double(most_spheres), core::memory_of_process() / bytes_a_sphere);
    if (block * blocks <= allowed) return;
    throw InputError(fmt::format(
        "packing.blocks = [{}, {}, {}]: about {:.3g} spheres in each of {:.3g} blocks are {:.3g} "
        "spheres: at most {:.3g} are allowed here ({} bytes of memory each); give fewer blocks, a "
        "smaller packing.block or a grading without its finest part",
        options.blocks[0], options.blocks[1], options.blocks[2], block, blocks, block * blocks,
        allowed, bytes_a_sphere));
}

}  // namespace grainfield::packing
