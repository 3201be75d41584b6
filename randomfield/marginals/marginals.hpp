#pragma once
// From the Gaussian field to the soil: the marginal distribution of a property, Eqs. (7)-(9) of
// Tran et al. and four more.

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "randomfield/grid.hpp"
#include "randomfield/marginals/marginal_families.hpp"

namespace grainfield::randomfield {

/// Mean and standard deviation [rad or Pa].
struct Moments {
    double mean = 0.0;
    double deviation = 0.0;
};

/// The distribution of one property over cells whose G has a variance of gamma, at one height.
///
/// Tran et al. put local averages G (variance gamma < 1) into their Eqs. (7) and (8) as they are,
/// and so do all distributions here: cells vary less than points, and their mean is another than a
/// point's unless the distribution is symmetric. preserve_mean scales all values (bounds included)
/// by one factor that undoes the latter.
class Marginal {
  public:
    /// Options as validate() accepts them; gamma in (0, 1], 1 for points [-].
    Marginal(const MarginalOptions& options, double gamma);

    /// The property where the field is g [rad or Pa].
    [[nodiscard]] double operator()(double g) const;
    /// values[i] = (*this)(g[i]); equally long.
    void apply(std::span<const double> g, std::span<double> values) const;
    /// The g that gives a value inside range(); NaN or infinite outside [-].
    [[nodiscard]] double score(double value) const;
    /// The g from which on values are not below this one; 40 where there is none [-].
    [[nodiscard]] double first_not_below(double value) const;
    /// d value / d g, by central differences, good to 1e-7 [rad or Pa].
    [[nodiscard]] double slope(double g) const;
    /// All values lie in this interval [rad or Pa].
    [[nodiscard]] Interval range() const;

    /// Of a cell. By quadrature over G (Gauss-Kronrod, 1e-10 of the deviation), lognormal and
    /// normal in closed form.
    [[nodiscard]] Moments moments() const;
    /// Of a point, before preserve_mean: the moments that the options ask for (truncated normal:
    /// after the cut).
    [[nodiscard]] Moments point_moments() const;
    /// Share of the cells below a value [-].
    [[nodiscard]] double cell_cdf(double value) const;
    /// Mean where G is normal with these moments [rad or Pa].
    [[nodiscard]] double mean_given(double mean, double variance) const;

  private:
    std::variant<Bounded, Lognormal, Normal, TruncatedNormal, Beta, Weibull> family_;
    double gamma_;
    double factor_ = 1.0;  ///< other than 1 under preserve_mean only [-]
};

/// Distributions must hold values that the property can have up to so many standard deviations.
inline constexpr double most_deviations = 6.0;

/// InputError where the options make no distribution, or one that the property cannot have:
/// friction angles below 0 or from pi/2 on, stiffnesses not above 0. Bounded distributions must
/// stay inside, others up to six standard deviations, beyond which a point lies with a probability
/// of 1e-9. The message names `key` ("field.friction") with what follows it, value and allowed.
void validate(const MarginalOptions& options, Property property, const std::string& key);

/// The same for every row of cells of a grid, whose means follow the trend.
void validate(const MarginalOptions& options, Property property, const std::string& key,
              const GridSpec& grid);

/// One property over the cells of a grid: the marginal of every row of cells, by its height.
class RowMarginals {
  public:
    /// The mean of the cells (i, j, k) is that at the height y of their middle:
    /// mean + mean_gradient (y - H/2), y up from the bottom of the sample and H its height.
    /// InputError as validate().
    RowMarginals(const MarginalOptions& options, Property property, const GridSpec& grid,
                 double gamma);

    [[nodiscard]] Property property() const { return property_; }
    [[nodiscard]] const GridSpec& grid() const { return grid_; }
    /// Rows of cells with marginals of their own: 1 without a trend.
    [[nodiscard]] std::size_t distinct_rows() const { return rows_.size(); }
    /// The marginal of the cells (i, j, k), whatever i and k.
    [[nodiscard]] const Marginal& row(std::int32_t j) const {
        return rows_[rows_.size() == 1 ? 0 : static_cast<std::size_t>(j)];
    }
    /// The property of every cell, from G of every cell, both at GridSpec::index() [rad or Pa].
    /// InputError where a value is none that the property can have, see validate().
    [[nodiscard]] std::vector<double> values(std::span<const double> g) const;

    /// Of a cell taken at random from all rows [rad or Pa].
    [[nodiscard]] Moments moments() const;
    [[nodiscard]] double cell_cdf(double value) const;  ///< share below a value [-]
    /// Share of the cells with a lower value, also where many have the same (a bound, to rounding).
    [[nodiscard]] double share_below(double value) const;
    /// The value that a share p of the cells lies below, 1e-15 < p < 1 - 1e-15 [rad or Pa].
    [[nodiscard]] double cell_quantile(double p) const;
    /// Mean over the rows of a point's mean [rad or Pa].
    [[nodiscard]] double point_mean() const;
    /// moments().mean / point_mean() [-].
    [[nodiscard]] double mean_ratio() const { return moments().mean / point_mean(); }

  private:
    Property property_;
    GridSpec grid_;
    double gamma_;
    std::vector<Marginal> rows_;  ///< one for all rows without a trend
};

}  // namespace grainfield::randomfield
