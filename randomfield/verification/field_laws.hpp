#pragma once
// How far sums over a correct field scatter from realization to realization: what the bands of a
// verification are made of. Everything follows from the exact covariance and the marginals, nothing
// from the realizations that are judged.

#include <cstdint>
#include <functional>
#include <vector>

#include "randomfield/covariance/covariance.hpp"
#include "randomfield/marginals/marginals.hpp"

namespace grainfield::randomfield {

/// A number that each realization has, such as the mean of its cells.
struct Law {
    double mean = 0.0;
    double variance = 0.0;  ///< exact, or a little above (FieldLaws::of_cells())
    double skewness = 0.0;  ///< estimated [-]
};

/// Where the mean of n realizations lies with probability 1 - alpha, half of it on either side: by
/// the gamma distribution of the law's mean, variance and skewness (Pearson's type III), which
/// few realizations of a skewed number follow where a normal distribution would not.
struct Band {
    double low = 0.0, high = 0.0;
};
Band band_of_mean(const Law& law, std::uint64_t n, double alpha);

/// Laws of the fields of one grid. G of all cells is normal with the exact covariance.
class FieldLaws {
  public:
    FieldLaws(const GridSpec& grid, const CorrelationModel& correlation);

    /// Mean over all pairs of cells `lag` apart along an axis of the product of their G.
    [[nodiscard]] Law of_products(std::size_t axis, std::int32_t lag) const;
    /// Mean over all cells of the product of two fields with correlation rho.
    [[nodiscard]] Law of_cross_products(double rho) const;

    /// A function of x = G / sqrt(gamma) in the rows of cells; one row for all is allowed.
    using OfRow = std::function<double(std::size_t row, double x)>;
    /// Mean over all cells of a smooth function. Its variance is the sum over k of a_k^2 times the
    /// mean of the correlation's power k over all pairs of cells, a_k the coefficients of the
    /// function in Hermite polynomials (Mehler); what is left beyond k = 60 counts with power 60.
    [[nodiscard]] Law of_cells(std::size_t rows, const OfRow& function) const;
    /// The share of cells with from[row] < x <= to[row].
    [[nodiscard]] Law of_share(const std::vector<double>& from,
                               const std::vector<double>& to) const;

  private:
    struct Coefficients;
    [[nodiscard]] Law law(const std::vector<Coefficients>& rows) const;

    GridSpec grid_;
    LocalAverageCovariance covariance_;
    std::vector<std::vector<double>> powers_;  ///< [k][distance of two rows], means over x and z
};

}  // namespace grainfield::randomfield
