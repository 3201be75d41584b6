#pragma once
// What is read off the stress-strain curve of a triaxial test.

#include <vector>

#include "triaxial/realization/curve_point.hpp"
#include "triaxial/realization/failure.hpp"

namespace grainfield::triaxial {

struct CurveResults {
    double peak_deviator_stress = 0;      ///< largest recorded q after the start transient [Pa]
    double axial_strain_at_peak = 0;      ///< [-]
    double smoothed_deviator_stress = 0;  ///< largest q of the smoothed curve [Pa]
    double E50 = 0;                       ///< secant modulus at half the peak, loading branch [Pa]
    double smoothed_E50 = 0;              ///< the same on the smoothed curve [Pa]
    double friction_angle = 0;            ///< asin(q/(q + 2 sigma_3)) at the peak [rad]
    Failure failure = Failure::strain_limit;
};

/// Whether E50 of the recorded and of the smoothed curve are both given: more than 2 % apart.
bool moduli_differ(double a, double b);

/// Peak, E50 and macroscopic friction angle. The peak is the largest recorded q, not smoothed,
/// after the start transient (of a curve that ends within it: its last point). E50 is read by
/// interpolation where q rises through half the peak for the last time before the peak, as the
/// smoothed curve tells. Throws SimulationError where there is no positive q to evaluate.
/// `confining_stress` [Pa].
CurveResults evaluate_curve(const std::vector<CurvePoint>& curve, double confining_stress,
                            const FailureRule& rule = {});

}  // namespace grainfield::triaxial
