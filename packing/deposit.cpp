#include "packing/deposit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "packing/size_grid.hpp"

namespace grainfield::packing {
namespace {

constexpr int attempts_a_sphere = 2000;
constexpr std::uint64_t calls_a_look = 64;  // at the monitor: random numbers drawn between two
constexpr std::size_t spheres_a_report = 1000;

}  // namespace

double place_at_random(core::ParticleStore& spheres, double width, double depth, double height,
                       std::uint64_t seed, core::Monitor* monitor) {
    const core::RandomStream stream(seed, core::Stream::packing_position);
    std::vector<std::size_t> order(spheres.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return spheres.radius[a] > spheres.radius[b];
    });
    if (!order.empty() && 2 * spheres.radius[order[0]] > std::min(width, depth))
        throw InputError(
            fmt::format("packing.block: a sphere of diameter {:g} m does not fit into a block {:g} "
                        "m x {:g} m wide; "
                        "give a larger block or a finer grading",
                        2 * spheres.radius[order[0]], width, depth));
    SizeGrid placed(spheres);
    std::uint64_t counter = 0;
    std::size_t done = 0;
    for (std::size_t i : order) {
        const double r = spheres.radius[i];
        height = std::max(height, 2 * r);
        for (int attempt = 1;; ++attempt) {
            if (monitor != nullptr && counter % calls_a_look == 0 && monitor->stop_requested())
                throw Interrupted("stopped by the user");
            const auto [u, v] = stream.uniform_pair(0, counter++);
            const double w = stream.uniform(0, counter++);
            const Vec3 x(r + u * (width - 2 * r), r + v * (height - 2 * r),
                         r + w * (depth - 2 * r));
            if (!placed.overlaps(x, r)) {
                spheres.position.set(i, x);
                placed.add(i);
                break;
            }
            if (attempt % attempts_a_sphere == 0) height *= 1.1;  // room for more above
        }
        if (monitor != nullptr && ++done % spheres_a_report == 0)
            monitor->progress(static_cast<double>(done) / static_cast<double>(order.size()), -1,
                              fmt::format("{} of {} spheres", done, order.size()));
    }
    return height;
}

}  // namespace grainfield::packing
