#include "core/neighbour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/parallel.hpp"
#include "core/base/tasks.hpp"
#include "kernels/vector/near_points.hpp"
#include "kernels/vector/records.hpp"

namespace grainfield::core {
namespace {

constexpr double cell_size = 2.0;  // of a level's largest diameter: long runs for the vectors [-]

/// The spheres of one level, sorted into cells (counting sort: spheres of a cell are contiguous
/// and in ascending order).
struct Grid {
    Vec3 origin = Vec3::Zero();
    double inverse_cell = 0;  // of the side [1/m]
    double max_radius = 0;    // of the level [m]
    std::array<std::int64_t, 3> n{1, 1, 1};
    std::vector<std::uint32_t> first;  // of each cell in `spheres`, and one past the last
    std::vector<std::int32_t> spheres;
    // Centres relative to the origin, and radii, in the order of `spheres` [m]. Single precision:
    // the search only proposes pairs, with room for round-off; each is then checked in double.
    std::vector<float> x, y, z, radius;
    // The same as they are, for that check.
    Vec3Column centre;
    Column<double> exact_radius;

    kernels::PointColumns points() const { return {x.data(), y.data(), z.data(), radius.data()}; }

    std::int64_t coordinate(double place, int axis) const {
        // In the grid the quotient is not negative: to truncate is to round down.
        const double quotient = (place - origin[axis]) * inverse_cell;
        if (!(quotient > 0)) return 0;
        const auto last = n[static_cast<std::size_t>(axis)] - 1;
        return quotient < static_cast<double>(last) ? static_cast<std::int64_t>(quotient) : last;
    }
    std::int64_t index(std::int64_t a, std::int64_t b, std::int64_t c) const {
        return a + n[0] * (b + n[1] * c);
    }
    /// First of a cell's spheres; a may be one past the last cell of a row.
    std::size_t begin(std::int64_t a, std::int64_t b, std::int64_t c) const {
        return first[static_cast<std::size_t>(index(a, b, c))];
    }
    std::int64_t index(const Vec3& place) const {
        return index(coordinate(place.x(), 0), coordinate(place.y(), 1), coordinate(place.z(), 2));
    }
};

Grid make_grid(const std::vector<std::int32_t>& members, const Vec3Column& x,
               const Column<double>& radius, double skin, const Box& box) {
    Grid grid;
    for (std::int32_t i : members) grid.max_radius = std::max(grid.max_radius, radius[i]);
    grid.origin = box.lower;
    double cell = cell_size * (2 * grid.max_radius + skin);
    // No more cells than twice the spheres: a scene with far outliers gets larger cells.
    const double budget = std::max<double>(64.0, 2.0 * static_cast<double>(members.size()));
    for (;; cell *= 1.25) {
        const Vec3 cells = (box.size() / cell).array().floor() + 1.0;
        if (cells.prod() > budget) continue;
        for (std::size_t a = 0; a < 3; ++a) grid.n[a] = static_cast<std::int64_t>(cells[a]);
        break;
    }
    grid.inverse_cell = 1 / cell;
    grid.first.assign(static_cast<std::size_t>(grid.n[0] * grid.n[1] * grid.n[2]) + 1, 0);
    std::vector<std::uint32_t> cell_of(members.size());
    for_chunks(members.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
            cell_of[m] = static_cast<std::uint32_t>(grid.index(x[members[m]]));
    });
    for (const std::uint32_t c : cell_of) ++grid.first[c + 1];
    std::partial_sum(grid.first.begin(), grid.first.end(), grid.first.begin());
    std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
    grid.spheres.resize(members.size());
    for (std::size_t m = 0; m < members.size(); ++m) grid.spheres[next[cell_of[m]]++] = members[m];
    for (auto* column : {&grid.x, &grid.y, &grid.z, &grid.radius})
        column->resize(members.size() + kernels::most_lanes);
    grid.centre.resize(members.size());
    grid.exact_radius.resize(members.size());
    for_chunks(members.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            grid.centre.set(m, x[grid.spheres[m]]);
            grid.exact_radius[m] = radius[grid.spheres[m]];
            const Vec3 u = grid.centre[m] - grid.origin;
            grid.x[m] = static_cast<float>(u.x());
            grid.y[m] = static_cast<float>(u.y());
            grid.z[m] = static_cast<float>(u.z());
            grid.radius[m] = static_cast<float>(grid.exact_radius[m]);
        }
    });
    return grid;
}

/// Sorts pairs with i < j, found in any order but always the same, by (i, j).
std::vector<kernels::Pair> sorted_pairs(const std::vector<std::vector<kernels::Pair>>& found,
                                        std::size_t n) {
    std::vector<std::uint32_t> first(n + 1, 0);
    for (const auto& part : found)
        for (const kernels::Pair& p : part) ++first[static_cast<std::size_t>(p.i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<kernels::Pair> pairs(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const auto& part : found)
        for (const kernels::Pair& p : part) pairs[next[static_cast<std::size_t>(p.i)]++] = p;
    for_chunks(n, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            std::sort(pairs.begin() + first[i], pairs.begin() + first[i + 1]);
    });
    return pairs;
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
    Box box{x[0], x[0]};
    for (std::size_t i = 0; i < n; ++i) {
        box.lower = box.lower.cwiseMin(x[i]);
        box.upper = box.upper.cwiseMax(x[i]);
    }
    std::vector<Grid> grids;
    for (const auto& level : members)
        grids.push_back(level.empty() ? Grid{} : make_grid(level, x, radius, skin, box));
    // Round-off of three coordinates and two radii in single precision, twice over.
    const double fuzz =
        16.0 * std::numeric_limits<float>::epsilon() * (box.size().maxCoeff() + *largest);
    const auto margin = static_cast<float>(skin + fuzz);

    // A pair is found from its smaller level; within a level from the earlier in the grid.
    struct Piece {
        std::size_t level, begin, end;  // of the level's grid
    };
    std::vector<Piece> pieces;
    for (std::size_t level = 0; level < grids.size(); ++level)
        for (std::size_t m = 0; m < grids[level].spheres.size(); m += chunk_size)
            pieces.push_back({level, m, std::min(grids[level].spheres.size(), m + chunk_size)});
    std::vector<std::vector<kernels::Pair>> found(pieces.size());
    for_tasks(pieces.size(), [&](std::size_t p) {
        auto& pairs = found[p];
        std::vector<std::int32_t> near;
        const auto [own, piece_begin, piece_end] = pieces[p];
        for (std::size_t m = piece_begin; m < piece_end; ++m) {
            const std::int32_t i = grids[own].spheres[m];
            const Vec3 xi = grids[own].centre[m];
            const double ri = grids[own].exact_radius[m];
            const auto take = [&](const Grid& grid, std::size_t begin, std::size_t end) {
                const Eigen::Vector3f here = (xi - grid.origin).cast<float>();
                if (near.size() < end - begin + kernels::most_lanes)
                    near.resize(end - begin + kernels::most_lanes);
                const std::size_t count =
                    kernels::find_near(grid.points(), begin, end, here.x(), here.y(), here.z(),
                                       static_cast<float>(ri), margin, near.data());
                for (std::size_t k = 0; k < count; ++k) {
                    const auto other = static_cast<std::size_t>(near[k]);
                    const double reach = ri + grid.exact_radius[other] + skin;
                    if (!((grid.centre[other] - xi).squaredNorm() < reach * reach)) continue;
                    const std::int32_t j = grid.spheres[other];
                    pairs.push_back({std::min(i, j), std::max(i, j)});
                }
            };
            for (std::size_t level = own; level < grids.size(); ++level) {
                const Grid& grid = grids[level];
                if (grid.spheres.empty()) continue;
                const double range = ri + grid.max_radius + skin;
                std::array<std::int64_t, 3> at{}, lo{}, hi{};
                for (int a = 0; a < 3; ++a) {
                    const auto axis = static_cast<std::size_t>(a);
                    at[axis] = grid.coordinate(xi[a], a);
                    lo[axis] = grid.coordinate(xi[a] - range, a);
                    hi[axis] = grid.coordinate(xi[a] + range, a);
                }
                for (std::int64_t c = level == own ? at[2] : lo[2]; c <= hi[2]; ++c) {
                    const bool own_layer = level == own && c == at[2];
                    for (std::int64_t b = own_layer ? at[1] : lo[1]; b <= hi[1]; ++b) {
                        // Cells along x are contiguous in memory: one run for all of them.
                        const bool own_row = own_layer && b == at[1];
                        take(grid, own_row ? m + 1 : grid.begin(lo[0], b, c),
                             grid.begin(hi[0] + 1, b, c));
                    }
                }
            }
        }
    });
    return sorted_pairs(found, n);
}

}  // namespace grainfield::core
