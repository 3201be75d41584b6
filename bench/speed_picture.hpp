#pragma once
// The pictures of step_rate: speed by instruction set, precision and threads; growth with size.

#include <string>
#include <vector>

namespace grainfield::bench {

/// One measured case.
struct SpeedPoint {
    std::string isa, precision;
    int threads = 1;
    double spheres = 0;            ///< [-]
    double milliseconds = 0;       ///< a step, median [ms]
    double memory_per_sphere = 0;  ///< [B]
};

/// Bars of sphere-steps per second, one and two threads side by side: a PNG file's bytes.
std::string rate_picture(const std::vector<SpeedPoint>& points);

/// Time a sphere-step and memory a sphere against the number of spheres: a PNG file's bytes.
std::string size_picture(const std::vector<SpeedPoint>& points);

}  // namespace grainfield::bench
