#include "triaxial/realization/curve.hpp"

#include <algorithm>
#include <cmath>
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

/// Strains at which q rises through `half`; strain(k) and q(k) of `points` points. The curve starts
/// at zero strain and zero q.
template <class Strain, class Stress>
std::vector<double> rises_through(double half, std::size_t points, const Strain& strain,
                                  const Stress& q) {
    std::vector<double> rises;
    double strain0 = 0, q0 = 0;
    for (std::size_t k = 0; k < points; ++k) {
        if (q0 < half && q(k) >= half)
            rises.push_back(crossing(strain0, q0, strain(k), q(k), half));
        strain0 = strain(k);
        q0 = q(k);
    }
    return rises;
}

/// E50 of the recorded and of the smoothed curve; `curve` ends with the peak.
void find_modulus(CurveResults& results, std::span<const CurvePoint> curve) {
    const double half = 0.5 * results.peak_deviator_stress;
    const std::vector<double> rises = rises_through(
        half, curve.size(), [&](std::size_t k) { return curve[k].axial_strain; },
        [&](std::size_t k) { return curve[k].deviator_stress; });
    const SmoothedCurve s =
        smoothed_curve(curve, std::min(smoothing_window, e50_window_share * rises.front()));
    const std::vector<double> smoothed_rises = rises_through(
        half, s.axial_strain.size(), [&](std::size_t k) { return s.axial_strain[k]; },
        [&](std::size_t k) { return s.deviator_stress[k]; });
    const double smoothed = smoothed_rises.empty() ? rises.front() : smoothed_rises.back();
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
