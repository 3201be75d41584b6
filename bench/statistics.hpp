#pragma once
// Statistics of a few measured values.

#include <algorithm>
#include <vector>

namespace grainfield::bench {

/// Of an even number of values the upper one of the middle. There must be one.
inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace grainfield::bench
