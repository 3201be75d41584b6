#include "randomfield/generators/detail_stencil.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/generators/lower_factor.hpp"

namespace grainfield::randomfield {
namespace {

constexpr std::int32_t kSteps = 2;          // how far the cells of a stencil are, in steps
constexpr std::int32_t kLags = 2 * kSteps;  // and so how far from each other

InputError cannot_be_computed(const Vec3& theta) {
    return InputError(
        fmt::format("field.correlation_length = [{}, {}, {}] m: the subdivision of this grid "
                    "cannot be computed in double precision; use field.method = \"cholesky\" or "
                    "\"circulant\"",
                    theta[0], theta[1], theta[2]));
}

}  // namespace

Surroundings surroundings_of(std::int32_t index, std::int32_t cells) {
    return {std::min(index, kSteps), std::min(cells - 1 - index, kSteps), index % 2 != 0};
}

DetailCovariance::DetailCovariance(const Vec3& cell_size, const CellCount& cells, std::size_t axis,
                                   const CorrelationModel& correlation)
    : axis_(axis), correlation_(correlation) {
    Vec3 half_size = cell_size;
    half_size[static_cast<int>(axis)] *= 0.5;
    std::array<std::int32_t, 3> half_lags{};
    std::size_t count = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        reach_[d] = std::min(kLags, cells[d] - 1);
        half_lags[d] = d == axis ? 2 * reach_[d] + 2 : reach_[d] + 1;
        count *= static_cast<std::size_t>(2 * reach_[d] + 1);
    }
    const LocalAverageCovariance halves(half_size, correlation, half_lags);
    lags_.reserve(count);
    CellCount lag{};
    for (lag[2] = -reach_[2]; lag[2] <= reach_[2]; ++lag[2]) {
        for (lag[1] = -reach_[1]; lag[1] <= reach_[1]; ++lag[1]) {
            for (lag[0] = -reach_[0]; lag[0] <= reach_[0]; ++lag[0]) {
                // Half a of one cell with half b of another, b - a in {-1, 0, 1} half cells on.
                const auto half = [&](std::int32_t shift) {
                    CellCount at = lag;
                    at[axis] = 2 * at[axis] + shift;
                    return halves(at[0], at[1], at[2]);
                };
                const double same = half(0), next = half(1), before = half(-1);
                // P = (A + B)/2, E = (A - B)/2, A the half in front.
                lags_.push_back({0.5 * same + 0.25 * (next + before), 0.25 * (before - next),
                                 0.5 * same - 0.25 * (next + before)});
            }
        }
    }
}

const DetailCovariance::Lag& DetailCovariance::at(const CellCount& from,
                                                  const CellCount& to) const {
    std::size_t index = 0;
    for (std::size_t d = 3; d-- > 0;) {
        index = index * static_cast<std::size_t>(2 * reach_[d] + 1) +
                static_cast<std::size_t>(to[d] - from[d] + reach_[d]);
    }
    return lags_[index];
}

DetailStencil DetailCovariance::stencil(const std::array<Surroundings, 3>& around) const {
    constexpr CellCount origin{0, 0, 0};
    DetailStencil stencil;
    // Where the cell's surroundings are their own mirror image along the axis, so is the stencil:
    // cells beside it have no weight, and stay out.
    const bool mirrored = around[axis_].below == around[axis_].above;
    for (std::int32_t k = -around[2].below; k <= around[2].above; ++k) {
        for (std::int32_t j = -around[1].below; j <= around[1].above; ++j) {
            for (std::int32_t i = -around[0].below; i <= around[0].above; ++i) {
                const CellCount offset{i, j, k};
                if (std::abs(i) + std::abs(j) + std::abs(k) > kSteps) continue;
                if (mirrored && offset[axis_] == 0) continue;
                stencil.cells.push_back({offset, 0.0});
            }
        }
    }
    for (std::size_t d = 0; d < 3; ++d) {
        if (!around[d].odd) continue;
        CellCount offset{};
        offset[d] = -1;
        stencil.details.push_back({offset, 0.0});
        if (around[d].above == 0) continue;
        offset[d] = 1;
        stencil.details.push_back({offset, 0.0});
    }

    // Best linear estimate: weights R^-1 s, R the covariance of what is known, s that of E with it.
    const std::size_t np = stencil.cells.size();
    const std::size_t n = np + stencil.details.size();
    const auto term = [&](std::size_t a) -> DetailTerm& {
        return a < np ? stencil.cells[a] : stencil.details[a - np];
    };
    std::vector<double> known(n * n), weights(n);
    for (std::size_t a = 0; a < n; ++a) {
        const CellCount& from = term(a).offset;
        for (std::size_t b = a; b < n; ++b) {
            const Lag& lag = at(from, term(b).offset);
            known[a + b * n] = known[b + a * n] = b < np   ? lag.cell_cell
                                                  : a < np ? lag.cell_detail
                                                           : lag.detail_detail;
        }
        weights[a] = a < np ? at(from, origin).cell_detail : at(from, origin).detail_detail;
    }
    const std::vector<double> with_detail = weights;
    const double scale = at(origin, origin).cell_cell;
    double rest = at(origin, origin).detail_detail;
    if (n > 0) {
        const auto factor = LowerFactor::of(std::move(known), n, scale);
        if (!factor) throw cannot_be_computed(correlation_.length);
        factor->solve_lower(weights);
        factor->solve_upper(weights);
        for (std::size_t a = 0; a < n; ++a) {
            term(a).weight = weights[a];
            rest -= weights[a] * with_detail[a];
        }
    }
    // Below zero only by round-off, where everything around determines the detail.
    if (!(rest > -1e-9 * scale)) throw cannot_be_computed(correlation_.length);
    stencil.noise = std::sqrt(std::max(rest, 0.0));
    return stencil;
}

}  // namespace grainfield::randomfield
