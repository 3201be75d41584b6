// The marginals of a grid's rows: a trend of the mean with height (marginals.hpp, RowMarginals).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "randomfield/marginals/marginals.hpp"
#include "randomfield/marginals/property_limits.hpp"

namespace grainfield::randomfield {
namespace {

/// The options of a row, which has no trend of its own.
MarginalOptions of_row(const MarginalOptions& options, const GridSpec& grid, std::int32_t j) {
    MarginalOptions row = options;
    row.mean_gradient = 0.0;
    if (options.mean_gradient == 0.0) return row;
    const double y = (j + 0.5) * grid.cell_size[1];
    const double growth = options.mean_gradient * (y - 0.5 * grid.cells[1] * grid.cell_size[1]);
    if (options.kind == MarginalKind::bounded) {
        row.minimum = options.minimum.value() + growth;
        row.maximum = options.maximum.value() + growth;
    } else {
        row.mean += growth;
    }
    return row;
}

std::int32_t rows_of(const MarginalOptions& options, const GridSpec& grid) {
    return options.mean_gradient == 0.0 ? 1 : grid.cells[1];
}

}  // namespace

void validate(const MarginalOptions& options, Property property, const std::string& key,
              const GridSpec& grid) {
    validate(options, property, key);
    // A trend is at its worst at an end, but for the beta distribution also where the mean is near
    // a bound that a middle row is nearer to; rows are few.
    for (std::int32_t j = 0; j < rows_of(options, grid); ++j) {
        try {
            validate(of_row(options, grid, j), property, key);
        } catch (const InputError& error) {
            throw InputError(
                fmt::format("{}.mean_gradient = {}: in the cells at a height of {:.4g} m: {}", key,
                            options.mean_gradient, (j + 0.5) * grid.cell_size[1], error.what()));
        }
    }
}

RowMarginals::RowMarginals(const MarginalOptions& options, Property property, const GridSpec& grid,
                           double gamma)
    : property_(property), grid_(grid), gamma_(gamma) {
    validate(options, property, std::string(limits_of(property).key), grid);
    for (std::int32_t j = 0; j < rows_of(options, grid); ++j)
        rows_.emplace_back(of_row(options, grid, j), gamma);
    if (!options.preserve_mean) return;
    // The factor is known only now.
    const PropertyLimits limits = limits_of(property);
    for (const Marginal& row : rows_)
        for (const double g : {-most_deviations, most_deviations})
            if (!limits.contains(row(g)))
                throw InputError(fmt::format(
                    "{}.preserve_mean = true: scaled to a point's mean, values reach {:.4g} {}, "
                    "allowed is {}",
                    limits.key, row(g), limits.unit, limits.text));
}

std::vector<double> RowMarginals::values(std::span<const double> g) const {
    std::vector<double> values(g.size());
    if (rows_.size() == 1) {
        rows_.front().apply(g, values);
    } else {
        const auto [nx, ny, nz] = grid_.cells;
        for (std::int32_t k = 0; k < nz; ++k) {
            for (std::int32_t j = 0; j < ny; ++j) {
                const std::size_t first = grid_.index(0, j, k);
                row(j).apply(g.subspan(first, static_cast<std::size_t>(nx)),
                             std::span(values).subspan(first, static_cast<std::size_t>(nx)));
            }
        }
    }
    const PropertyLimits limits = limits_of(property_);
    for (std::size_t c = 0; c < values.size(); ++c)
        if (!limits.contains(values[c]))
            throw InputError(fmt::format(
                "{}.cov, {}.marginal: a realization has a {} of {} {} in cell {}, allowed is {}: "
                "choose a smaller cov, or the marginal \"truncated-normal\" or \"beta\"",
                limits.key, limits.key, limits.name, values[c], limits.unit, c, limits.text));
    return values;
}

Moments RowMarginals::moments() const {
    double mean = 0.0, square = 0.0;
    std::vector<Moments> all;
    for (const Marginal& one : rows_) {
        all.push_back(one.moments());
        mean += all.back().mean;
    }
    const auto rows = static_cast<double>(rows_.size());
    mean /= rows;
    for (const Moments& one : all)
        square += one.deviation * one.deviation + (one.mean - mean) * (one.mean - mean);
    return {mean, std::sqrt(square / rows)};
}

double RowMarginals::cell_cdf(double value) const {
    double share = 0.0;
    for (const Marginal& one : rows_) share += one.cell_cdf(value);
    return share / static_cast<double>(rows_.size());
}

double RowMarginals::share_below(double value) const {
    double share = 0.0;
    for (const Marginal& one : rows_)
        share += normal_cdf(one.first_not_below(value) / std::sqrt(gamma_));
    return share / static_cast<double>(rows_.size());
}

double RowMarginals::cell_quantile(double p) const {
    // One row: the quantile itself. More: between the lowest and the highest row's.
    const double g = std::sqrt(gamma_) * core::normal_quantile(p);
    double low = rows_.front()(g), high = low;
    for (const Marginal& one : rows_) {
        low = std::min(low, one(g));
        high = std::max(high, one(g));
    }
    for (double middle = 0.5 * (low + high); low < middle && middle < high;
         middle = 0.5 * (low + high))
        (cell_cdf(middle) < p ? low : high) = middle;
    return high;
}

double RowMarginals::point_mean() const {
    double mean = 0.0;
    for (const Marginal& one : rows_) mean += one.point_moments().mean;
    return mean / static_cast<double>(rows_.size());
}

}  // namespace grainfield::randomfield
