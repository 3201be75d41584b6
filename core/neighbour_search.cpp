#include "core/neighbour_search.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"

namespace grainfield::core {
namespace {

/// The spheres of one level, sorted into cells (counting sort: spheres of a cell are contiguous
/// and in ascending order).
struct Grid {
    Vec3 origin = Vec3::Zero();
    double cell = 0;        // side [m]
    double max_radius = 0;  // of the level [m]
    std::array<std::int64_t, 3> n{1, 1, 1};
    std::vector<std::uint32_t> first;  // of each cell in `spheres`, and one past the last
    std::vector<std::int32_t> spheres;

    std::int64_t coordinate(double x, int axis) const {
        const auto c = static_cast<std::int64_t>(std::floor((x - origin[axis]) / cell));
        return std::clamp<std::int64_t>(c, 0, n[static_cast<std::size_t>(axis)] - 1);
    }
    std::int64_t index(std::int64_t a, std::int64_t b, std::int64_t c) const {
        return a + n[0] * (b + n[1] * c);
    }
    std::int64_t index(const Vec3& x) const {
        return index(coordinate(x.x(), 0), coordinate(x.y(), 1), coordinate(x.z(), 2));
    }
};

Grid make_grid(const std::vector<std::int32_t>& members, const Vec3Column& x,
               const Column<double>& radius, double skin) {
    Grid grid;
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::max());
    Vec3 upper = -lower;
    for (std::int32_t i : members) {
        lower = lower.cwiseMin(x[i]);
        upper = upper.cwiseMax(x[i]);
        grid.max_radius = std::max(grid.max_radius, radius[i]);
    }
    grid.origin = lower;
    grid.cell = 2 * grid.max_radius + skin;
    // No more cells than twice the spheres: a scene with far outliers gets larger cells.
    const double budget = std::max<double>(64.0, 2.0 * static_cast<double>(members.size()));
    for (;; grid.cell *= 1.25) {
        const Vec3 cells = ((upper - lower) / grid.cell).array().floor() + 1.0;
        if (cells.prod() > budget) continue;
        for (std::size_t a = 0; a < 3; ++a) grid.n[a] = static_cast<std::int64_t>(cells[a]);
        break;
    }
    grid.first.assign(static_cast<std::size_t>(grid.n[0] * grid.n[1] * grid.n[2]) + 1, 0);
    std::vector<std::size_t> cell_of(members.size());
    for (std::size_t m = 0; m < members.size(); ++m) {
        cell_of[m] = static_cast<std::size_t>(grid.index(x[members[m]]));
        ++grid.first[cell_of[m] + 1];
    }
    std::partial_sum(grid.first.begin(), grid.first.end(), grid.first.begin());
    std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
    grid.spheres.resize(members.size());
    for (std::size_t m = 0; m < members.size(); ++m) grid.spheres[next[cell_of[m]]++] = members[m];
    return grid;
}

/// Level of a radius: 0 for [r_min, 2 r_min), 1 for [2 r_min, 4 r_min), ...
std::size_t level_of(double radius, double smallest) {
    return static_cast<std::size_t>(std::max(0, std::ilogb(radius / smallest)));
}

}  // namespace

std::vector<kernels::Pair> find_pairs(const Vec3Column& x, const Column<double>& radius,
                                      double skin) {
    const std::size_t n = radius.size();
    if (n < 2) return {};
    const auto [smallest, largest] = std::minmax_element(radius.begin(), radius.end());
    std::vector<std::vector<std::int32_t>> members(level_of(*largest, *smallest) + 1);
    for (std::size_t i = 0; i < n; ++i)
        members[level_of(radius[i], *smallest)].push_back(static_cast<std::int32_t>(i));
    std::vector<Grid> grids;
    for (const auto& level : members)
        grids.push_back(level.empty() ? Grid{} : make_grid(level, x, radius, skin));

    // A pair is found from its smaller level; within a level from its smaller index.
    std::vector<std::vector<std::uint64_t>> found(chunk_count(n));
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
        auto& keys = found[chunk];
        const std::size_t end = std::min(n, (chunk + 1) * chunk_size);
        for (std::size_t i = chunk * chunk_size; i < end; ++i) {
            const Vec3 xi = x[i];
            const std::size_t own = level_of(radius[i], *smallest);
            for (std::size_t level = own; level < grids.size(); ++level) {
                const Grid& grid = grids[level];
                if (grid.spheres.empty()) continue;
                const double range = radius[i] + grid.max_radius + skin;
                std::array<std::int64_t, 3> lo{}, hi{};
                for (int a = 0; a < 3; ++a) {
                    lo[static_cast<std::size_t>(a)] = grid.coordinate(xi[a] - range, a);
                    hi[static_cast<std::size_t>(a)] = grid.coordinate(xi[a] + range, a);
                }
                for (std::int64_t c = lo[2]; c <= hi[2]; ++c)
                    for (std::int64_t b = lo[1]; b <= hi[1]; ++b) {
                        // Cells along x are contiguous in memory: one run for all of them.
                        const std::size_t begin =
                            grid.first[static_cast<std::size_t>(grid.index(lo[0], b, c))];
                        const std::size_t stop =
                            grid.first[static_cast<std::size_t>(grid.index(hi[0], b, c)) + 1];
                        for (std::size_t m = begin; m < stop; ++m) {
                            const auto j = static_cast<std::size_t>(grid.spheres[m]);
                            if (level == own && j <= i) continue;
                            const double reach = radius[i] + radius[j] + skin;
                            if ((x[j] - xi).squaredNorm() < reach * reach)
                                keys.push_back(std::uint64_t{std::min(i, j)} << 32 |
                                               std::max(i, j));
                        }
                    }
            }
        }
    });
    std::vector<std::uint64_t> keys;
    std::size_t total = 0;
    for (const auto& part : found) total += part.size();
    keys.reserve(total);
    for (const auto& part : found) keys.insert(keys.end(), part.begin(), part.end());
    tbb::parallel_sort(keys.begin(), keys.end());
    std::vector<kernels::Pair> pairs(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k)
        pairs[k] = {static_cast<std::int32_t>(keys[k] >> 32),
                    static_cast<std::int32_t>(keys[k] & 0xffffffffu)};
    return pairs;
}

}  // namespace grainfield::core
