#pragma once
// For the worst of many errors.

#include <cmath>

namespace grainfield {

/// The larger of two; not a number if one of them is not, which std::max() may hide.
inline double larger(double a, double b) {
    return std::isnan(a) || a > b ? a : b;
}

}  // namespace grainfield
