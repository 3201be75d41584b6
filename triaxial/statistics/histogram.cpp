#include "triaxial/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {
namespace {

std::size_t bins_for(std::span<const double> ascending) {
    const auto n = static_cast<double>(ascending.size());
    const double range = ascending.back() - ascending.front();
    const double middle = sample_quantile(ascending, 0.75) - sample_quantile(ascending, 0.25);
    // Freedman & Diaconis: range over 2 IQR n^(-1/3); Sturges where IQR = 0.
    const double bins =
        middle > 0 ? std::ceil(range * std::cbrt(n) / (2 * middle)) : std::ceil(std::log2(n)) + 1;
    // One far outlier would spread the others over bins without end.
    return static_cast<std::size_t>(std::clamp(bins, 1.0, n));
}

}  // namespace

std::optional<Histogram> histogram(std::span<const double> values,
                                   std::optional<std::size_t> bins) {
    require_finite(values);
    if (bins && *bins == 0) throw InputError("a histogram of 0 bins, must be at least 1");
    const std::vector<double> ascending = sorted(values);
    if (ascending.empty() || ascending.front() == ascending.back()) return {};

    const std::size_t m = bins.value_or(bins_for(ascending));
    Histogram result{std::vector<double>(m + 1), std::vector<std::size_t>(m),
                     std::vector<double>(m)};
    for (std::size_t k = 0; k <= m; ++k)
        result.edges[k] = std::lerp(ascending.front(), ascending.back(),
                                    static_cast<double>(k) / static_cast<double>(m));
    for (const double x : ascending) {
        const auto above = std::ranges::upper_bound(result.edges, x);
        const auto bin = static_cast<std::size_t>(above - result.edges.begin() - 1);
        ++result.counts[std::min(bin, m - 1)];  // the largest value lies on the last edge
    }
    const auto n = static_cast<double>(values.size());
    for (std::size_t k = 0; k < m; ++k)
        result.densities[k] =
            static_cast<double>(result.counts[k]) / (n * (result.edges[k + 1] - result.edges[k]));
    return result;
}

}  // namespace grainfield::triaxial::statistics
