#include "packing/grading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace grainfield::packing {
namespace {

constexpr std::uint64_t most_draws = 64;
constexpr std::int32_t neighbourhood = 16;     // of the bisected count that is searched [-]
constexpr std::int32_t grains_a_look = 65536;  // at the monitor, between two
constexpr double close_enough = 3.0;           // deviation of the curve at any sieve [% of mass]

double volume(const std::vector<double>& diameters) {
    double cubes = 0;
    for (double d : diameters) cubes += d * d * d;
    return std::numbers::pi / 6 * cubes;
}

}  // namespace

NumberDistribution::NumberDistribution(const Grading& grading) {
    for (std::size_t k = 0; k + 1 < grading.sieve_diameter.size(); ++k) {
        const double d0 = grading.sieve_diameter[k], d1 = grading.sieve_diameter[k + 1];
        const double share = (grading.passing[k + 1] - grading.passing[k]) / 100.0;
        if (share <= 0) continue;
        const double slope = share / (d1 - d0);
        // Number of grains a unit of mass: the integral of f/D^3 over the segment.
        const double u0 = inverse_mean_cube_;
        inverse_mean_cube_ += 0.5 * slope * (1 / (d0 * d0) - 1 / (d1 * d1));
        segments_.push_back({d0, d1, slope, u0, inverse_mean_cube_, grading.passing[k] / 100.0});
    }
    for (Segment& s : segments_) {
        s.u0 /= inverse_mean_cube_;
        s.u1 /= inverse_mean_cube_;
    }
}

double NumberDistribution::quantile(double u) const {
    auto s = segments_.begin();
    while (s + 1 != segments_.end() && u > s->u1) ++s;
    const double inverse_square =
        1 / (s->d0 * s->d0) - 2 * (u - s->u0) * inverse_mean_cube_ / s->slope;
    return std::clamp(1 / std::sqrt(std::max(inverse_square, 1 / (s->d1 * s->d1))), s->d0, s->d1);
}

double NumberDistribution::mass_share(double u) const {
    auto s = segments_.begin();
    while (s + 1 != segments_.end() && u > s->u1) ++s;
    return s->mass0 + s->slope * (quantile(u) - s->d0);
}

double NumberDistribution::mean_cube(double u0, double u1) const {
    return (mass_share(u1) - mass_share(u0)) / ((u1 - u0) * inverse_mean_cube_);
}

NumberDistribution::Piece NumberDistribution::most_numerous() const {
    const auto most =
        std::max_element(segments_.begin(), segments_.end(),
                         [](const auto& a, const auto& b) { return a.u1 - a.u0 < b.u1 - b.u0; });
    return {most->d0, most->d1, most->u1 - most->u0};
}

double expected_spheres(const Grading& grading, double target_volume) {
    const double mean_cube = NumberDistribution(grading).mean_cube(0.0, 1.0);
    return target_volume / (std::numbers::pi / 6 * mean_cube);
}

GradingDraw draw_diameters(const Grading& grading, double target_volume, std::uint64_t seed,
                           std::optional<std::int32_t> count, core::Monitor* monitor) {
    const NumberDistribution distribution(grading);
    const core::RandomStream stream(seed, core::Stream::packing_grading);
    // Strata are numbered from the largest grains down, so that the largest ones, which decide the
    // volume, change little with n.
    const auto draw = [&](std::uint64_t attempt, std::int32_t n) {
        std::vector<double> diameters;
        for (std::int32_t k = 0; k < n; ++k) {
            if (monitor != nullptr && k % grains_a_look == 0 && monitor->stop_requested())
                throw Interrupted("stopped by the user");
            const double u = 1 - (k + stream.uniform(attempt, static_cast<std::uint64_t>(k))) / n;
            diameters.push_back(distribution.quantile(u));
        }
        std::sort(diameters.begin(), diameters.end());
        return diameters;
    };
    const auto worst_deviation = [&](const std::vector<double>& diameters) {
        const std::vector<double> achieved = achieved_passing(diameters, grading.sieve_diameter);
        double worst = 0;
        for (std::size_t k = 0; k < achieved.size(); ++k)
            worst = std::max(worst, std::abs(achieved[k] - grading.passing[k]));
        return worst;
    };
    // The volume of n stratified grains grows with n but for small jumps of the largest: bisect,
    // then look around.
    const double expected = expected_spheres(grading, target_volume);
    if (count ? *count > most_spheres : !(expected <= most_spheres))
        throw InputError(
            fmt::format("grading.sieve_diameter = {}: about {:.3g} spheres are too "
                        "many to be numbered",
                        grading.sieve_diameter, count ? *count : expected));
    const auto count_for_volume = [&](std::uint64_t attempt) {
        std::int32_t low = 1, high = static_cast<std::int32_t>(std::ceil(2.5 * expected)) + 4;
        while (high - low > 1) {
            const std::int32_t middle = low + (high - low) / 2;
            (volume(draw(attempt, middle)) < target_volume ? low : high) = middle;
        }
        double best = HUGE_VAL;
        std::int32_t n = 1;
        for (std::int32_t k = std::max(1, low - neighbourhood); k <= high + neighbourhood; ++k) {
            const double miss = std::abs(volume(draw(attempt, k)) - target_volume);
            if (miss >= best) continue;
            best = miss;
            n = k;
        }
        return n;
    };
    // One grain of the coarsest fraction can hold a quarter of the mass: of several draws the first
    // whose curve is close everywhere is taken, else the closest.
    GradingDraw result;
    double best = HUGE_VAL;
    for (std::uint64_t attempt = 0; attempt < most_draws && best > close_enough; ++attempt) {
        std::vector<double> drawn = draw(attempt, count ? *count : count_for_volume(attempt));
        const double deviation = worst_deviation(drawn);
        if (deviation >= best) continue;
        best = deviation;
        result.diameter = std::move(drawn);
    }
    result.scale = std::cbrt(target_volume / volume(result.diameter));
    for (double& d : result.diameter) d *= result.scale;
    return result;
}

double mass_share_of_largest(const std::vector<double>& diameters, std::size_t count) {
    const std::size_t first = diameters.size() - std::min(count, diameters.size());
    const std::vector<double> largest(diameters.begin() + static_cast<std::ptrdiff_t>(first),
                                      diameters.end());
    return volume(largest) / volume(diameters);
}

std::vector<double> achieved_passing(const std::vector<double>& diameters,
                                     const std::vector<double>& sieves) {
    double total = 0;
    std::vector<double> passing(sieves.size(), 0.0);
    for (double d : diameters) {
        total += d * d * d;
        for (std::size_t k = 0; k < sieves.size(); ++k)
            if (d <= sieves[k]) passing[k] += d * d * d;
    }
    for (double& p : passing) p *= 100 / total;
    return passing;
}

}  // namespace grainfield::packing
