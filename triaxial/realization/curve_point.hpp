#pragma once
// A point of a stress-strain curve.

#include <cstdint>

namespace grainfield::triaxial {

/// One recorded point. Stresses are means over the steps since the point before; compression and
/// contraction are positive.
struct CurvePoint {
    double axial_strain = 0;            ///< (h0 - h)/h0 since shear began [-]
    double deviator_stress = 0;         ///< q = sigma_1 - sigma_3 [Pa]
    double axial_stress = 0;            ///< sigma_1: top and bottom wall averaged [Pa]
    double lateral_stress_x = 0;        ///< the two x walls averaged [Pa]
    double lateral_stress_z = 0;        ///< the two z walls averaged [Pa]
    double volumetric_strain = 0;       ///< (V0 - V)/V0 [-]
    double unbalanced_force_ratio = 0;  ///< at the point [-]
    double time = 0;                    ///< since shear began [s]
    std::int64_t contacts = 0;          ///< touching, at the point [-]
    /// Mean over the same steps of the squared relative errors of both lateral stresses [-].
    double lateral_square_error = 0;
};

}  // namespace grainfield::triaxial
