#pragma once
// Exact Gaussian conditioning of the cells' local averages on values known in some cells.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "randomfield/conditioning/field_data.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/generators/lower_factor.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// With G the unconditional fields of both properties in one vector, K their covariance, A the rows
/// of the cells with data, d the data, R the variances of their errors, e a draw of these errors:
///   G_c = G + K A^T (A K A^T + R)^-1 (d - A G - e)
/// (kriging of the residuals; Chiles & Delfiner, Geostatistics, 2nd ed., section 7.3). Where G has
/// covariance K, then G_c has the mean and the covariance of the joint normal distribution given
/// the data exactly. K is C for one property and rho C between the two, C that of local averages.
class Conditioning {
  public:
    /// covariance: C by lag in cells; correlation: rho in [-1, 1]; source: the file of the data,
    /// for messages. InputError with file and line where the data say the same twice (A K A^T + R
    /// is singular), or are so much at odds that double precision cannot honour the exact ones.
    Conditioning(const GridSpec& grid, LocalAverageCovariance covariance, double correlation,
                 std::vector<CellDatum> data, std::string source = "field.data");

    /// Replaces the fields of friction angle and stiffness, of one number a cell each, or empty
    /// where that property is not random (and has no data). errors: a standard normal a datum.
    /// Safe from many threads. InputError with file and line where an exact value is lost to
    /// round-off.
    void apply(std::span<double> friction, std::span<double> stiffness,
               std::span<const double> errors) const;

    [[nodiscard]] const std::vector<CellDatum>& data() const { return data_; }
    /// Mean of a property's G in every cell given the data [-].
    [[nodiscard]] std::vector<double> mean(Property property) const;
    /// Variance of a property's G in every cell given the data [-].
    [[nodiscard]] std::vector<double> variance(Property property) const;

  private:
    LowerFactor factor() const;
    void check_known(std::size_t datum, double found, double allowed) const;
    double between(Property a, Property b) const { return a == b ? 1.0 : correlation_; }
    /// Covariance of a property in a cell with a datum.
    double covariance(Property property, const CellCount& cell, std::size_t datum) const;
    std::vector<double> weights(std::vector<double> residual) const;
    void add(Property property, std::span<const double> weights, std::span<double> field) const;
    template <class Visit>
    void for_cells(const Visit& visit) const;

    GridSpec grid_;
    LocalAverageCovariance of_lag_;
    double correlation_;
    std::vector<CellDatum> data_;
    std::string source_;
    std::vector<CellCount> where_;  ///< cells of the data
    std::vector<double> system_;    ///< A K A^T + R, column by column
    LowerFactor factor_;            ///< of it
};

}  // namespace grainfield::randomfield
