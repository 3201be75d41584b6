#pragma once
// A histogram of a sample.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace grainfield::triaxial::statistics {

/// Bins of equal width from the smallest value to the largest. A value on an inner edge belongs to
/// the bin above it.
struct Histogram {
    std::vector<double> edges;        ///< one more than bins, ascending [as the values]
    std::vector<std::size_t> counts;  ///< of each bin [-]
    std::vector<double> densities;    ///< count/(n width), integral 1 [1/unit of the values]
};

/// Histogram of as many bins as given, or of bins 2 IQR n^(-1/3) wide (Freedman & Diaconis 1981),
/// but no more than values. Where the middle half of the values is one, ceil(log2(n)) + 1 bins
/// (Sturges 1926). Empty while no two values differ. Throws InputError for values that are not
/// finite and for no bins.
std::optional<Histogram> histogram(std::span<const double> values,
                                   std::optional<std::size_t> bins = {});

}  // namespace grainfield::triaxial::statistics
