#include "triaxial/statistics/convergence.hpp"

#include <cmath>

#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial::statistics {

Convergence convergence(std::span<const double> values, double confidence) {
    require_finite(values);
    tail_of(confidence);
    Convergence all;
    double mean = 0;
    double squares = 0;  // sum of (x - mean)^2 so far
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto n = static_cast<double>(i + 1);
        const double step = values[i] - mean;
        mean += step / n;
        squares += step * (values[i] - mean);
        if (i == 0) continue;
        const double deviation = std::sqrt(squares / (n - 1));
        all.count.push_back(i + 1);
        all.mean.push_back(mean);
        all.mean_interval.push_back(interval_of_mean(n, mean, deviation, confidence));
        all.deviation.push_back(deviation);
        all.deviation_interval.push_back(
            chi_square_interval_of_deviation(n, deviation, confidence));
    }
    return all;
}

}  // namespace grainfield::triaxial::statistics
