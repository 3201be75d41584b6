#pragma once
// What a verification adds up over the realizations. Private to the module.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// Sums over realizations of numbers counted from their exact values, and of their squares.
class Tally {
  public:
    Tally() = default;
    explicit Tally(std::vector<double> exact)
        : exact_(std::move(exact)), sum_(exact_.size(), 0.0), square_(exact_.size(), 0.0) {}

    void add(std::span<const double> values) {
        for (std::size_t i = 0; i < exact_.size(); ++i) {
            const double off = values[i] - exact_[i];
            sum_[i] += off;
            square_[i] += off * off;
        }
    }
    void merge(const Tally& other) {
        for (std::size_t i = 0; i < exact_.size(); ++i) {
            sum_[i] += other.sum_[i];
            square_[i] += other.square_[i];
        }
    }
    [[nodiscard]] double mean(std::size_t i, std::uint64_t n) const {
        return exact_[i] + sum_[i] / static_cast<double>(n);
    }
    [[nodiscard]] double square(std::size_t i) const { return square_[i]; }
    [[nodiscard]] double sum(std::size_t i) const { return sum_[i]; }
    [[nodiscard]] std::size_t size() const { return exact_.size(); }

  private:
    std::vector<double> exact_, sum_, square_;
};

/// Mean over all pairs of cells `lag` apart along an axis of the product of their G.
double mean_product(std::span<const double> g, const GridSpec& grid, std::size_t axis,
                    std::int32_t lag);

/// The sums of one field.
struct Sums {
    Tally products;       ///< of all axes and lags
    Tally cells;          ///< G of every cell
    Tally shares, mean;   ///< of the property
    double square = 0.0;  ///< mean over cells of squared distances from the row's mean
    Tally known;          ///< conditional G of every cell
    double largest_miss = 0.0;
    Tally cross;

    void merge(const Sums& other) {
        products.merge(other.products);
        cells.merge(other.cells);
        shares.merge(other.shares);
        mean.merge(other.mean);
        square += other.square;
        known.merge(other.known);
        largest_miss = std::max(largest_miss, other.largest_miss);
        cross.merge(other.cross);
    }
};

}  // namespace grainfield::randomfield
