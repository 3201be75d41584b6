#pragma once
// Stresses over the depth of a settled sample (Fig. 3b of Tran et al.) and how well they follow the
// theory.

#include <vector>

#include "core/simulation.hpp"

namespace grainfield::packing {

struct StressProfile {
    std::vector<double> depth;         ///< of the middle of each layer, top layer first [m]
    std::vector<double> vertical;      ///< sigma_yy, mean over the layer [Pa]
    std::vector<double> horizontal_x;  ///< sigma_xx [Pa]
    std::vector<double> horizontal_z;  ///< sigma_zz [Pa]
    double unit_weight = 0;            ///< gamma_bulk: weight over volume of the sample [N/m3]
    double slope_ratio = 0;            ///< slope of the fit vertical = a depth + b, over gamma [-]
    double r2 = 0;                     ///< of that fit [-]
    double K0 = 0;                     ///< slope of horizontal against vertical stress [-]
};

/// Mean stresses in horizontal layers of equal height between the floor (y = 0) and `top`: every
/// contact's branch vector counts with the part of it that lies in the layer, so that the vertical
/// stress is the mean over the layer of the force through horizontal planes. `base` is the area of
/// the sample [m2], gravity g > 0 [m/s2]. Forces must be current.
StressProfile measure_stress_profile(const core::Simulation& simulation, double top, double base,
                                     double gravity, int layers);

}  // namespace grainfield::packing
