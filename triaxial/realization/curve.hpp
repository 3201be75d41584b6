#pragma once
// The stress-strain curve of a triaxial test and what is read off it.

#include <cstdint>
#include <optional>
#include <vector>

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
};

struct CurveResults {
    double peak_deviator_stress = 0;  ///< [Pa]
    double axial_strain_at_peak = 0;  ///< [-]
    double E50 = 0;                   ///< secant modulus at half the peak, loading branch [Pa]
    double friction_angle = 0;        ///< asin(q/(q + 2 sigma_3)) at the peak [rad]
};

/// Peak, E50 by interpolation where q first reaches half the peak, and macroscopic friction angle.
/// The curve must have a point with q > 0. `confining_stress` [Pa].
CurveResults evaluate_curve(const std::vector<CurvePoint>& curve, double confining_stress);

/// Decides when a test may end ("auto"): q has fallen by 5 % of its peak (and by 5 % of the
/// confining stress, so that noise before q has risen ends nothing), or a further 1 % of strain
/// brought no new peak; never later than 10 %.
class PeakWatch {
  public:
    explicit PeakWatch(double confining_stress) : confining_stress_(confining_stress) {}

    /// Takes the next point; true once the peak is surely past or the strain has reached 10 %.
    bool past_peak(const CurvePoint& point);
    /// Why past_peak() was true: "q fell 5 % below its peak", ...
    const char* reason() const { return reason_; }
    double peak() const { return peak_; }  ///< so far [Pa]

    template <class Archive>
    void serialize(Archive& archive) {
        archive(confining_stress_, peak_, strain_at_peak_);
    }

  private:
    double confining_stress_;
    double peak_ = 0, strain_at_peak_ = 0;
    const char* reason_ = "";
};

}  // namespace grainfield::triaxial
