#include "randomfield/conditioning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"

namespace grainfield::randomfield {
namespace {

CellCount cell_at(const GridSpec& grid, std::size_t index) {
    const auto i = static_cast<std::int64_t>(index);
    const auto [nx, ny, nz] = grid.cells;
    return {static_cast<std::int32_t>(i % nx), static_cast<std::int32_t>(i / nx % ny),
            static_cast<std::int32_t>(i / nx / ny)};
}

LowerFactor factor_of(const std::vector<double>& system, std::size_t size) {
    if (size > LowerFactor::max_size)
        throw InputError(fmt::format("field.data: values in {} cells: at most {} cells are allowed",
                                     size, LowerFactor::max_size));
    auto factor = LowerFactor::of(system, size);
    if (!factor || factor->nugget() > 0.0)
        throw InputError(
            "field.data: some exact values follow from others to round-off (neighbours at a very "
            "long correlation length, or both properties of a block at field.cross_correlation = "
            "1 or -1): give values an error, or leave some out");
    return *std::move(factor);
}

}  // namespace

Conditioning::Conditioning(const GridSpec& grid, LocalAverageCovariance covariance,
                           double correlation, std::vector<CellDatum> data)
    : grid_(grid),
      of_lag_(std::move(covariance)),
      correlation_(correlation),
      data_(std::move(data)),
      where_([this] {
          std::vector<CellCount> where;
          for (const CellDatum& datum : data_) where.push_back(cell_at(grid_, datum.cell));
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
      factor_(factor_of(system_, data_.size())) {}

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
    for (const CellDatum& datum : data_) {
        if (datum.variance > 0.0) continue;
        // Round-off of the large weights that neighbours at odds with each other have.
        double& known =
            (datum.property == Property::friction_angle ? friction : stiffness)[datum.cell];
        if (!(std::abs(known - datum.score) < 1e-6))
            throw SimulationError(
                "field.data: the exact values are too much at odds with the correlation length to "
                "be honoured in double precision: give them an error");
        known = datum.score;
    }
}

std::vector<double> Conditioning::mean(Property property) const {
    std::vector<double> scores;
    for (const CellDatum& datum : data_) scores.push_back(datum.score);
    std::vector<double> mean(grid_.size(), 0.0);
    add(property, weights(std::move(scores)), mean);
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
    return variance;
}

}  // namespace grainfield::randomfield
