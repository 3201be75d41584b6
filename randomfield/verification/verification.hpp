#pragma once
// Realizations of a field held against what they should be: correlation, distribution, variance of
// every cell, the correlation of the two properties, and the data they are conditioned on.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/monitor.hpp"
#include "randomfield/block_field.hpp"

namespace grainfield::randomfield {

/// Every check as a whole holds a correct generator to be wrong with this probability; its bands
/// are the wider the more numbers it looks at (Bonferroni). Bands follow from the exact covariance
/// and the marginals alone (field_laws.hpp), and hold from the fewest realizations on [-].
inline constexpr double false_alarm = 0.01;
/// Fewest realizations that say something.
inline constexpr std::uint64_t least_realizations = 100;

/// A mean over the realizations, its exact value and the band it should lie in.
struct Estimate {
    double estimate = 0.0;
    double exact = 0.0;
    double low = 0.0, high = 0.0;
    [[nodiscard]] bool inside() const { return low <= estimate && estimate <= high; }
    /// How far from the exact value it is, in units of the band on that side [-].
    [[nodiscard]] double of_band() const;
};

/// Correlation of cells along one axis [-]; lag h = 0, 1, ... in cells. Products of G of the cells
/// over the exact gamma, so that lag 0 is the variance of all cells over gamma.
using CorrelationEstimates = std::vector<Estimate>;

/// Variances of single cells over the exact one; times the realizations they are chi-squared.
struct VarianceMap {
    std::vector<double> ratio;     ///< at GridSpec::index(); NaN where the exact variance is 0 [-]
    double low = 0.0, high = 0.0;  ///< band of all cells together at false_alarm [-]
    double single_low = 0.0, single_high = 0.0;  ///< band of 95 % of each cell [-]
    double share_outside_single = 0.0;           ///< about 0.05; neighbours go together [-]
    std::size_t outside = 0;                     ///< cells outside low ... high [-]
};

/// Values of cells in bins that each should hold the same share; fewer and larger ones where many
/// cells have the same value.
struct HistogramCheck {
    std::vector<double> edges;     ///< inner edges, one less than bins [rad or Pa]
    double first = 0, last = 0;    ///< 0.1 and 99.9 % quantiles, for pictures [rad or Pa]
    std::vector<Estimate> shares;  ///< of all values, by bin [-]
    Estimate mean;                 ///< [rad or Pa]
    /// About the predicted mean of each row, and of these about theirs [rad or Pa].
    Estimate deviation;
    bool deviation_judged = true;  ///< not under tails too heavy for so few, or without any
};

/// Fields with data against the conditional mean and variance.
struct DataCheck {
    std::size_t cells = 0;      ///< with data [-]
    std::size_t exact = 0;      ///< of these, with exact ones [-]
    double largest_miss = 0.0;  ///< of a property from its exact value, over the value [-]
    double mean_off = 0.0;      ///< largest distance of a cell's mean, in standard errors [-]
    double mean_allowed = 0.0;  ///< for all cells together at false_alarm [-]
    VarianceMap variance;       ///< against the conditional variance
};

/// All of one Gaussian field and its property.
struct FieldCheck {
    std::optional<Property> property;  ///< none: G alone, with Variable::none
    std::array<CorrelationEstimates, 3> correlation;
    VarianceMap variance;
    std::optional<HistogramCheck> histogram;
    std::optional<DataCheck> data;
};

struct Verification {
    std::uint64_t realizations = 0;
    double gamma = 0.0;
    std::vector<FieldCheck> fields;                   ///< friction angle first
    std::optional<Estimate> cross_correlation;        ///< where both are random
    std::optional<CovarianceError> covariance_error;  ///< algebraic, of grids not too large
};

/// Draws the realizations 0 ... n - 1 and checks them; data, where there are any, are left out of
/// all checks but their own. On all threads, the same on any number of them. InputError for fewer
/// than least_realizations or where the sums do not fit the memory, Interrupted where the monitor
/// says so.
Verification verify(const FieldGenerator& generator, std::uint64_t realizations);
Verification verify(const FieldGenerator& generator, std::uint64_t realizations,
                    core::Monitor& monitor);

/// Where realizations come from; safe to call from many threads.
struct FieldSource {
    std::function<BlockField(std::uint64_t realization)> plain;  ///< without data
    std::function<BlockField(std::uint64_t realization)> known;  ///< honouring the data
};

/// Holds fields from anywhere against what `expected` says they should be.
Verification verify(const FieldGenerator& expected, const FieldSource& source,
                    std::uint64_t realizations, core::Monitor& monitor);

}  // namespace grainfield::randomfield
