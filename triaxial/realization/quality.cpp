#include "triaxial/realization/quality.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grainfield::triaxial {
namespace {

/// RMS error of both lateral stresses up to a strain; of the first point at least.
double rms_error(std::span<const CurvePoint> curve, double strain) {
    double sum = 0;
    std::size_t points = 0;
    for (const CurvePoint& p : curve) {
        if (points > 0 && p.axial_strain > strain) break;
        sum += p.lateral_square_error;
        ++points;
    }
    return points > 0 ? std::sqrt(sum / static_cast<double>(points)) : 0.0;
}

}  // namespace

HeldStress held_stress(std::span<const CurvePoint> curve, const CurveResults& results) {
    const double strain_at_E50 = 0.5 * results.peak_deviator_stress / results.E50;
    return {.to_E50 = rms_error(curve, strain_at_E50),
            .to_peak = rms_error(curve, results.axial_strain_at_peak)};
}

std::optional<ShearEnergy> shear_energy(std::span<const core::EnergyRow> rows, double shear_began,
                                        double duration) {
    const core::EnergyRow *first = nullptr, *last = nullptr;
    double kinetic = 0, elastic = 0;
    for (const core::EnergyRow& row : rows) {
        if (row.time < shear_began) continue;
        // A row is needed at either end, so the one just after the peak counts too.
        if (first != nullptr && last->time >= shear_began + duration) break;
        if (first == nullptr) first = &row;
        last = &row;
        kinetic += row.energy.kinetic + row.energy.rotational;
        elastic += row.energy.elastic_normal + row.energy.elastic_shear;
    }
    if (first == last || !(elastic > 0)) return std::nullopt;
    const double damped = last->energy.damping_work - first->energy.damping_work;
    const double slipped = last->energy.friction_work - first->energy.friction_work;
    if (!(damped + slipped > 0)) return std::nullopt;
    return ShearEnergy{.damping_share = damped / (damped + slipped),
                       .kinetic_ratio = kinetic / elastic};
}

std::string not_quasi_static(double inertial_number, const std::optional<ShearEnergy>& energy) {
    std::string why;
    if (inertial_number > quasi_static_inertial_number)
        why = fmt::format("the inertial number is {:.2g}, above {:.2g}", inertial_number,
                          quasi_static_inertial_number);
    if (energy && energy->damping_share > quasi_static_damping_share)
        why += fmt::format(
            "{}numerical damping took {:.0f} % of the dissipated energy, more than "
            "{:.0f} %",
            why.empty() ? "" : " and ", 100 * energy->damping_share,
            100 * quasi_static_damping_share);
    if (why.empty()) return {};
    return fmt::format(
        "{}: {}; a slower test (triaxial.strain_rate) gives another peak, most often a lower one",
        not_quasi_static_words, why);
}

}  // namespace grainfield::triaxial
