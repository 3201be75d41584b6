#include "triaxial/report/mohr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace grainfield::triaxial::report {

std::string soil_difference(const MohrCircle& here, const MohrCircle& there) {
    std::string text;
    for (const auto& [name, value] : here.soil) {
        const auto other = there.soil.find(name);
        if (other == there.soil.end() || other->second == value) continue;
        text += fmt::format("{}{}: {} here, {} there", text.empty() ? "" : "; ", name, value,
                            other->second);
    }
    return text;
}

Envelope envelope_through_origin(const MohrCircle& circle) {
    return {.friction_angle = std::asin(circle.radius() / circle.centre())};
}

Envelope fit_envelope(std::span<const MohrCircle> circles) {
    const auto [low, high] = std::ranges::minmax_element(
        circles, {}, [](const MohrCircle& c) { return c.confining_stress; });
    if (circles.size() < 2 ||
        high->confining_stress - low->confining_stress < 1e-3 * high->confining_stress)
        throw InputError(
            "the failure envelope needs runs at two confining stresses at least; the companions' "
            "confining stresses do not differ from the run's");

    // A straight line touches every circle when t = c cos(phi) + s sin(phi): linear in (s, t).
    const auto n = static_cast<double>(circles.size());
    double mean_s = 0, mean_t = 0;
    for (const auto& c : circles) {
        mean_s += c.centre() / n;
        mean_t += c.radius() / n;
    }
    double ss = 0, st = 0;
    for (const auto& c : circles) {
        ss += (c.centre() - mean_s) * (c.centre() - mean_s);
        st += (c.centre() - mean_s) * (c.radius() - mean_t);
    }
    const double sine = st / ss;
    if (!(std::abs(sine) < 1.0))
        throw InputError(fmt::format(
            "no failure envelope fits the runs' Mohr circles: sin(phi) would be {:.3g}", sine));

    Envelope envelope{.friction_angle = std::asin(sine)};
    const double a = mean_t - sine * mean_s;
    envelope.intercept = a / std::cos(envelope.friction_angle);
    double square = 0;
    for (const auto& c : circles) square += std::pow(c.radius() - a - sine * c.centre(), 2) / n;
    envelope.rms_residual = std::sqrt(square);
    return envelope;
}

}  // namespace grainfield::triaxial::report
