#include "triaxial/realization/curve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/base/errors.hpp"

namespace grainfield::triaxial {
namespace {

// E50 is smoothed over no more than this share of its strain: the curve bends most at its start.
constexpr double e50_window_share = 0.2;  // [-]

/// Strain at which the straight line between two points reaches q.
double crossing(double strain0, double q0, double strain1, double q1, double q) {
    return strain0 + (q - q0) / (q1 - q0) * (strain1 - strain0);
}

/// Strains at which q rises through `half`. The curve starts at zero strain and zero q.
std::vector<double> rises_through(std::span<const CurvePoint> curve, double half) {
    std::vector<double> strains;
    CurvePoint before{};
    for (const CurvePoint& point : curve) {
        if (before.deviator_stress < half && point.deviator_stress >= half)
            strains.push_back(crossing(before.axial_strain, before.deviator_stress,
                                       point.axial_strain, point.deviator_stress, half));
        before = point;
    }
    return strains;
}

/// Strain at which the smoothed curve rises through `half` for the last time; empty if it never
/// does.
std::optional<double> last_smoothed_rise(std::span<const CurvePoint> curve, double half,
                                         double window) {
    const SmoothedCurve s = smoothed_curve(curve, window);
    const auto& [strain, q] = s;
    for (std::size_t k = q.size(); k-- > 0;) {
        const double before = k > 0 ? q[k - 1] : 0;
        if (before < half && q[k] >= half)
            return crossing(k > 0 ? strain[k - 1] : 0, before, strain[k], q[k], half);
    }
    return std::nullopt;
}

/// E50 of the recorded and of the smoothed curve; `curve` ends with the peak.
void find_modulus(CurveResults& results, std::span<const CurvePoint> curve) {
    const double half = 0.5 * results.peak_deviator_stress;
    const std::vector<double> rises = rises_through(curve, half);
    const double window = std::min(smoothing_window, e50_window_share * rises.front());
    const double smoothed = last_smoothed_rise(curve, half, window).value_or(rises.front());
    const double strain = *std::ranges::min_element(
        rises, {}, [&](double rise) { return std::abs(rise - smoothed); });
    if (!(strain > 0) || !(smoothed > 0))
        throw SimulationError(
            "the deviator stress never rose above what it was before any strain: there "
            "is no E50");
    results.E50 = half / strain;
    results.smoothed_E50 = half / smoothed;
}

}  // namespace

bool moduli_differ(double a, double b) {
    return std::abs(a - b) > 0.02 * std::min(a, b);
}

CurveResults evaluate_curve(const std::vector<CurvePoint>& curve, double confining_stress,
                            const FailureRule& rule) {
    auto counted =
        std::ranges::lower_bound(curve, rule.transient_strain, {}, &CurvePoint::axial_strain);
    if (counted == curve.end() && !curve.empty()) --counted;
    const auto peak = std::max_element(counted, curve.end(), [](const auto& a, const auto& b) {
        return a.deviator_stress < b.deviator_stress;
    });
    if (peak == curve.end() || !(peak->deviator_stress > 0))
        throw SimulationError(
            "the deviator stress never became positive: there is no peak to evaluate");
    CurveResults results;
    const double q = peak->deviator_stress;
    results.peak_deviator_stress = q;
    results.axial_strain_at_peak = peak->axial_strain;
    results.friction_angle = std::asin(q / (q + 2 * confining_stress));
    results.smoothed_deviator_stress = smoothed_peak(curve, rule);
    results.failure = failure_of(curve, rule);
    find_modulus(results, {curve.begin(), peak + 1});
    return results;
}

}  // namespace grainfield::triaxial
