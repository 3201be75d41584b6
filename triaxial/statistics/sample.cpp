#include "triaxial/statistics/sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace grainfield::triaxial::statistics {

void Resampling::validate() const {
    if (resamples < 100)
        throw InputError(fmt::format("resamples = {}, must be at least 100", resamples));
}

void require_finite(std::span<const double> values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw InputError(fmt::format("value {} of {} is {}, must be a finite number", i + 1,
                                         values.size(), values[i]));
}

void require_positive(std::span<const double> values) {
    require_finite(values);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] <= 0)
            throw InputError(fmt::format("value {} of {} is {}, must be above zero", i + 1,
                                         values.size(), values[i]));
}

double tail_of(double confidence) {
    if (!(confidence > 0 && confidence < 1))
        throw InputError(fmt::format("confidence = {}, must lie between 0 and 1", confidence));
    return 0.5 * (1 - confidence);
}

std::vector<double> sorted(std::span<const double> values) {
    std::vector<double> ascending(values.begin(), values.end());
    std::ranges::sort(ascending);
    return ascending;
}

double sample_quantile(std::span<const double> ascending, double p) {
    if (ascending.empty() || !(p >= 0 && p <= 1))
        throw InputError(
            fmt::format("quantile at {} of {} values: it takes a value and a p of 0 to 1", p,
                        ascending.size()));
    const double place = p * static_cast<double>(ascending.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(place), ascending.size() - 1);
    const double above = ascending[std::min(k + 1, ascending.size() - 1)];
    return ascending[k] + (place - static_cast<double>(k)) * (above - ascending[k]);
}

}  // namespace grainfield::triaxial::statistics
