#include "triaxial/report/axis_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfield::triaxial::report {

double round_step(double span, int intervals) {
    constexpr double slack = 1 - 1e-9;  // a span of 3 x 0.1 is three steps of 0.1
    const double step = slack * span / intervals;
    const double decade = std::pow(10, std::floor(std::log10(step)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (step <= digit * decade) return digit * decade;
    return 10 * decade;
}

std::size_t widest_label(double low, double high, double step) {
    std::size_t widest = 0;
    for (double k = std::ceil(low / step); k <= std::floor(high / step); ++k)
        widest = std::max(widest, fmt::format("{:.6g}", k * step).size());
    return widest;
}

}  // namespace grainfield::triaxial::report
