#include "triaxial/realization/curve.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace grainfield::triaxial {
namespace {

constexpr double fallen = 0.05;          // of the peak or of the confining stress [-]
constexpr double further_strain = 0.01;  // without a new peak [-]
constexpr double largest_strain = 0.10;  // [-]

}  // namespace

CurveResults evaluate_curve(const std::vector<CurvePoint>& curve, double confining_stress) {
    const auto peak = std::max_element(
        curve.begin(), curve.end(),
        [](const auto& a, const auto& b) { return a.deviator_stress < b.deviator_stress; });
    if (peak == curve.end() || !(peak->deviator_stress > 0))
        throw SimulationError(
            "the deviator stress never became positive: there is no peak to evaluate");
    CurveResults results;
    results.peak_deviator_stress = peak->deviator_stress;
    results.axial_strain_at_peak = peak->axial_strain;
    const double q = peak->deviator_stress;
    results.friction_angle = std::asin(q / (q + 2 * confining_stress));
    const double half = 0.5 * q;
    CurvePoint before{};  // the curve starts at zero strain and zero deviator stress
    for (const CurvePoint& point : curve) {
        if (point.deviator_stress >= half) {
            const double share =
                (half - before.deviator_stress) / (point.deviator_stress - before.deviator_stress);
            const double strain =
                before.axial_strain + share * (point.axial_strain - before.axial_strain);
            if (!(strain > 0))
                throw SimulationError(
                    "the deviator stress never rose above what it was before any strain: there "
                    "is no E50");
            results.E50 = half / strain;
            break;
        }
        before = point;
    }
    return results;
}

bool PeakWatch::past_peak(const CurvePoint& point) {
    if (point.deviator_stress > peak_) {
        peak_ = point.deviator_stress;
        strain_at_peak_ = point.axial_strain;
    }
    const double fall = peak_ - point.deviator_stress;
    if (fall > fallen * std::max(peak_, confining_stress_))
        reason_ = "the deviator stress fell 5 % below its peak";
    else if (point.axial_strain > strain_at_peak_ + further_strain)
        reason_ = "a further 1 % of strain brought no new peak";
    else if (point.axial_strain >= largest_strain)
        reason_ = "10 % of axial strain";
    else
        return false;
    return true;
}

}  // namespace grainfield::triaxial
