#pragma once
// What the numbers of a test depend on beside the soil: whether its stress was held, how much of
// the work numerical damping took, how slow it was.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/energy.hpp"
#include "triaxial/realization/curve.hpp"

namespace grainfield::triaxial {

/// A lateral stress that is off by more than this is not held: what was sheared is another test
/// [-].
inline constexpr double stress_not_held = 0.05;
/// From here on a warning says so [-].
inline constexpr double stress_held_badly = 0.01;

/// Limits of a quasi-static test (docs/method.md, section 8; bench/results/rate.md) [-].
inline constexpr double quasi_static_inertial_number = 2e-4;
inline constexpr double quasi_static_damping_share = 0.15;

/// How well the lateral stresses were held over the parts of the curve that the results come from.
struct HeldStress {
    double to_E50 = 0;   ///< RMS relative error of both, from the start to where E50 is read [-]
    double to_peak = 0;  ///< the same up to the peak [-]

    double worst() const { return to_E50 > to_peak ? to_E50 : to_peak; }
};

HeldStress held_stress(std::span<const CurvePoint> curve, const CurveResults& results);

/// Where the energy of the shear stage went, up to the peak. Of runs that keep the ledger.
struct ShearEnergy {
    double damping_share = 0;  ///< dissipated by local damping, over all that was dissipated [-]
    double kinetic_ratio = 0;  ///< kinetic, rotations included, over elastic: mean over time [-]
};

/// `rows` from `shear_began` on [s, on their clock] for `duration` [s]. Empty: fewer than two rows
/// in there, or nothing was dissipated.
std::optional<ShearEnergy> shear_energy(std::span<const core::EnergyRow> rows, double shear_began,
                                        double duration);

/// What the sentence of not_quasi_static() begins with.
inline constexpr std::string_view not_quasi_static_words = "not quasi-static";

/// Why a test is not quasi-static: a sentence with the limits of docs/method.md, section 8; empty:
/// it is. `energy` is not known in runs without a ledger.
std::string not_quasi_static(double inertial_number, const std::optional<ShearEnergy>& energy);

}  // namespace grainfield::triaxial
