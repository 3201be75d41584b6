#pragma once
// Mohr circles at peak strength and the straight-line failure envelope.

#include <map>
#include <span>
#include <string>

namespace grainfield::triaxial::report {

/// The stresses of one run at its peak.
struct MohrCircle {
    double confining_stress = 0;  ///< sigma_3 [Pa]
    double deviator_stress = 0;   ///< q = sigma_1 - sigma_3 at the peak [Pa]
    std::string name;             ///< of the run
    /// What must be equal for circles to belong to one soil: the random field and its realization,
    /// the sample. By what they are called.
    std::map<std::string, std::string> soil = {};

    double centre() const { return confining_stress + 0.5 * deviator_stress; }  ///< s [Pa]
    double radius() const { return 0.5 * deviator_stress; }                     ///< t [Pa]
};

/// tau = intercept + sigma tan(friction_angle).
struct Envelope {
    double friction_angle = 0;  ///< [rad]
    double intercept = 0;       ///< c, of tau at sigma = 0 [Pa]
    double rms_residual = 0;    ///< of t over the circles [Pa]
};

/// Why one envelope for both would be that of no soil: "random field: none here, stiffness there";
/// empty: they can be compared.
std::string soil_difference(const MohrCircle& here, const MohrCircle& there);

/// Envelope of cohesionless soil through the origin: sin(phi) = q/(q + 2 sigma_3).
Envelope envelope_through_origin(const MohrCircle& circle);

/// Least squares t = a + s sin(phi), c = a/cos(phi), over two or more circles. Throws InputError
/// where their confining stresses do not differ (by a thousandth at least) or no line
/// with |sin(phi)| < 1 fits.
Envelope fit_envelope(std::span<const MohrCircle> circles);

}  // namespace grainfield::triaxial::report
