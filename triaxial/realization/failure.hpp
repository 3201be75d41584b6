#pragma once
// When a triaxial test has failed, and what of its curve tells so.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "triaxial/realization/curve_point.hpp"

namespace grainfield::triaxial {

/// What the largest deviator stress of a curve is.
enum class Failure {
    peak,         ///< the curve has softened after it
    plateau,      ///< the curve has stayed level after it
    strain_limit  ///< neither: the largest up to the strain at which the test ended
};

/// "peak", "plateau" or "strain-limit", as in files.
std::string_view failure_name(Failure failure);
/// The failure of such a name; empty if it is none.
std::optional<Failure> failure_of_name(std::string_view name);

/// The reason of a test that ended at the strain it was asked to end at, beside failure_name().
inline constexpr std::string_view ended_as_asked = "asked";

/// Why a test ended, in words: of failure_name() or ended_as_asked. Any other text stays.
std::string end_in_words(std::string_view end_reason);

/// A failed test ends at this axial strain at the latest (ASTM D7181, ISO 17892-9): failure is the
/// largest deviator stress, or that at 15 %, whichever comes first [-].
inline constexpr double failure_strain_limit = 0.15;

/// Window of strain over which a curve is smoothed to find its peak [-].
inline constexpr double smoothing_window = 0.002;

/// What the rules need to know of a test beside its curve.
struct FailureRule {
    std::size_t spheres = 0;      ///< in the sample [-]
    double transient_strain = 0;  ///< no peak counts before this axial strain [-]
};

/// Point k: means of strain and deviator stress over the recorded points up to point k that lie
/// less than the window before it.
struct SmoothedCurve {
    std::vector<double> axial_strain;     ///< [-]
    std::vector<double> deviator_stress;  ///< [Pa]
};

/// The curve averaged over `window` [-] of strain. The strains of `curve` must grow.
SmoothedCurve smoothed_curve(std::span<const CurvePoint> curve, double window);

/// Largest deviator stress of the curve smoothed over smoothing_window, after the start transient;
/// 0 if the curve ends within it [Pa].
double smoothed_peak(std::span<const CurvePoint> curve, const FailureRule& rule);

/// What the largest deviator stress of a finished curve is. `rule.spheres` does not matter.
Failure failure_of(std::span<const CurvePoint> curve, const FailureRule& rule);

/// Whether a test that runs until it fails (`max_axial_strain = "auto"`) may end with the last
/// point of `curve`, and why: the peak is surely past, q has levelled off at constant volume, or
/// the strain has reached failure_strain_limit. Empty: it goes on. Method: docs/method.md, 6.4.
std::optional<Failure> reached_failure(std::span<const CurvePoint> curve, const FailureRule& rule);

}  // namespace grainfield::triaxial
