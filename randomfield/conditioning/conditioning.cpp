#include "randomfield/conditioning/conditioning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::randomfield {
namespace {

/// Largest miss of an exact score that is taken for round-off: set to the score, the field is wrong
/// by less than any measurement would show.
constexpr double round_off = 1e-6;

}  // namespace

Conditioning::Conditioning(const GridSpec& grid, LocalAverageCovariance covariance,
                           double correlation, std::vector<CellDatum> data, std::string source)
    : grid_(grid),
      of_lag_(std::move(covariance)),
      correlation_(correlation),
      data_(std::move(data)),
      source_(std::move(source)),
      where_([this] {
          std::vector<CellCount> where;
          for (const CellDatum& datum : data_) where.push_back(grid_.cell_at(datum.cell));
          return where;
      }()),
      system_([this] {
          const std::size_t n = data_.size();
          std::vector<double> system(n * n);
          for (std::size_t b = 0; b < n; ++b) {
              for (std::size_t a = 0; a < n; ++a)
                  system[a + b * n] = this->covariance(data_[a].property, where_[a], b);
              system[b + b * n] += data_[b].variance;
          }
          return system;
      }()),
      factor_(factor()) {
    // Fields are as smooth as their covariance has them, data may not be: what these make of the
    // exact values comes first, and with a margin for the fields.
    std::vector<double> scores;
    for (const CellDatum& datum : data_) scores.push_back(datum.score);
    const std::vector<double> v = weights(std::move(scores));
    const std::size_t n = data_.size();
    for (std::size_t a = 0; a < n; ++a) {
        if (data_[a].variance > 0.0) continue;
        double found = 0.0;
        for (std::size_t b = 0; b < n; ++b) found += system_[a + b * n] * v[b];
        check_known(a, found, 0.1 * round_off);
    }
}

LowerFactor Conditioning::factor() const {
    const std::size_t n = data_.size();
    if (n > LowerFactor::max_size)
        throw InputError(fmt::format("{}: values in {} cells: at most {} cells are allowed",
                                     source_, n, LowerFactor::max_size));
    const auto leading = [&](std::size_t size) {
        std::vector<double> corner;
        for (std::size_t b = 0; b < size; ++b)
            corner.insert(corner.end(), system_.begin() + static_cast<std::ptrdiff_t>(b * n),
                          system_.begin() + static_cast<std::ptrdiff_t>(b * n + size));
        auto factor = LowerFactor::of(std::move(corner), size);
        if (factor && factor->nugget() > 0.0) factor.reset();
        return factor;
    };
    if (auto factor = leading(n)) return *std::move(factor);
    // The first datum that follows from those before it.
    std::size_t good = 0, bad = n;
    while (bad - good > 1) {
        const std::size_t middle = (good + bad) / 2;
        (leading(middle) ? good : bad) = middle;
    }
    core::throw_at_line(
        source_, data_[bad - 1].line,
        fmt::format("value = {}: follows from other values to round-off (of neighbours at a very "
                    "long correlation length, or of both properties of a block at "
                    "field.cross_correlation = 1 or -1): give it an error, or leave it out",
                    data_[bad - 1].value));
}

void Conditioning::check_known(std::size_t datum, double found, double allowed) const {
    const double score = data_[datum].score;
    if (std::abs(found - score) < allowed) return;
    core::throw_at_line(
        source_, data_[datum].line,
        fmt::format("value = {}: exact, but too much at odds with other values for a field of "
                    "this correlation length to honour it in double precision (G is missed by "
                    "{:.1e}, at most {:.0e} is allowed): give it an error, or leave it out",
                    data_[datum].value, std::abs(found - score), allowed));
}

double Conditioning::covariance(Property property, const CellCount& cell, std::size_t datum) const {
    const CellCount& other = where_[datum];
    return between(property, data_[datum].property) *
           of_lag_(cell[0] - other[0], cell[1] - other[1], cell[2] - other[2]);
}

// (A K A^T + R)^-1 residual, with one step of refinement: known values come back to round-off even
// where neighbours are nearly the same.
std::vector<double> Conditioning::weights(std::vector<double> residual) const {
    const std::size_t n = data_.size();
    std::vector<double> weights = residual;
    factor_.solve_lower(weights);
    factor_.solve_upper(weights);
    for (std::size_t b = 0; b < n; ++b)
        for (std::size_t a = 0; a < n; ++a) residual[a] -= system_[a + b * n] * weights[b];
    factor_.solve_lower(residual);
    factor_.solve_upper(residual);
    for (std::size_t a = 0; a < n; ++a) weights[a] += residual[a];
    return weights;
}

template <class Visit>
void Conditioning::for_cells(const Visit& visit) const {
    const auto [nx, ny, nz] = grid_.cells;
    std::size_t index = 0;
    for (std::int32_t k = 0; k < nz; ++k)
        for (std::int32_t j = 0; j < ny; ++j)
            for (std::int32_t i = 0; i < nx; ++i) visit(CellCount{i, j, k}, index++);
}

void Conditioning::add(Property property, std::span<const double> weights,
                       std::span<double> field) const {
    for_cells([&](const CellCount& cell, std::size_t index) {
        double sum = 0.0;
        for (std::size_t m = 0; m < weights.size(); ++m)
            sum += covariance(property, cell, m) * weights[m];
        field[index] += sum;
    });
}

void Conditioning::apply(std::span<double> friction, std::span<double> stiffness,
                         std::span<const double> errors) const {
    std::vector<double> residual(data_.size());
    for (std::size_t m = 0; m < data_.size(); ++m) {
        const CellDatum& datum = data_[m];
        const auto field = datum.property == Property::friction_angle ? friction : stiffness;
        residual[m] = datum.score - field[datum.cell] - std::sqrt(datum.variance) * errors[m];
    }
    const std::vector<double> v = weights(std::move(residual));
    if (!friction.empty()) add(Property::friction_angle, v, friction);
    if (!stiffness.empty()) add(Property::normal_stiffness, v, stiffness);
    for (std::size_t m = 0; m < data_.size(); ++m) {
        const CellDatum& datum = data_[m];
        if (datum.variance > 0.0) continue;
        // Round-off of the large weights that neighbours at odds with each other have.
        double& known =
            (datum.property == Property::friction_angle ? friction : stiffness)[datum.cell];
        check_known(m, known, round_off);
        known = datum.score;
    }
}

std::vector<double> Conditioning::mean(Property property) const {
    std::vector<double> scores;
    for (const CellDatum& datum : data_) scores.push_back(datum.score);
    std::vector<double> mean(grid_.size(), 0.0);
    add(property, weights(std::move(scores)), mean);
    for (const CellDatum& datum : data_)  // as apply() does
        if (datum.property == property && datum.variance == 0.0) mean[datum.cell] = datum.score;
    return mean;
}

std::vector<double> Conditioning::variance(Property property) const {
    std::vector<double> variance(grid_.size());
    std::vector<double> k(data_.size());
    for_cells([&](const CellCount& cell, std::size_t index) {
        for (std::size_t m = 0; m < k.size(); ++m) k[m] = covariance(property, cell, m);
        factor_.solve_lower(k);  // K_cc - |L^-1 k|^2
        double known = 0.0;
        for (const double x : k) known += x * x;
        variance[index] = std::max(0.0, of_lag_.gamma() - known);
    });
    for (const CellDatum& datum : data_)
        if (datum.property == property && datum.variance == 0.0) variance[datum.cell] = 0.0;
    return variance;
}

}  // namespace grainfield::randomfield
