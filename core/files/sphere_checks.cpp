#include "core/files/sphere_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "core/base/errors.hpp"

namespace grainfield::core {
namespace {

std::string name_of(std::size_t i, std::span<const std::int32_t> lines) {
    if (i < lines.size()) return fmt::format("sphere {} (line {})", i, lines[i]);
    return fmt::format("sphere {}", i);
}

bool is_finite(double v) {
    return std::isfinite(v);
}
bool is_positive(double v) {
    return std::isfinite(v) && v > 0;
}
bool is_not_negative(double v) {
    return std::isfinite(v) && v >= 0;
}
bool is_friction_angle(double v) {
    return v >= 0 && v < std::numbers::pi / 2;
}

struct Rule {
    const char* name;
    const Column<double>* values;
    bool (*holds)(double);
    const char* allowed;
};

}  // namespace

void check_spheres(const ParticleStore& s, const std::string& source,
                   std::span<const std::int32_t> lines) {
    if (s.size() == 0) throw InputError(fmt::format("{}: no sphere; at least one needed", source));
    const Rule rules[] = {
        {"x", &s.position.x, is_finite, "must be a finite number [m]"},
        {"y", &s.position.y, is_finite, "must be a finite number [m]"},
        {"z", &s.position.z, is_finite, "must be a finite number [m]"},
        {"radius", &s.radius, is_positive, "must be > 0 m"},
        {"mass", &s.mass, is_not_negative, "must be >= 0 kg"},
        {"normal_stiffness", &s.normal_stiffness, is_not_negative, "must be >= 0 Pa"},
        {"friction_angle", &s.friction_angle, is_friction_angle, "must be >= 0 and < pi/2 rad"},
        {"vx", &s.velocity.x, is_finite, "must be a finite number [m/s]"},
        {"vy", &s.velocity.y, is_finite, "must be a finite number [m/s]"},
        {"vz", &s.velocity.z, is_finite, "must be a finite number [m/s]"},
        {"wx", &s.spin.x, is_finite, "must be a finite number [rad/s]"},
        {"wy", &s.spin.y, is_finite, "must be a finite number [rad/s]"},
        {"wz", &s.spin.z, is_finite, "must be a finite number [rad/s]"},
    };
    for (const Rule& rule : rules)
        for (std::size_t i = 0; i < s.size(); ++i)
            if (!rule.holds((*rule.values)[i]))
                throw InputError(fmt::format("{}: {}: {} = {}: {}", source, name_of(i, lines),
                                             rule.name, (*rule.values)[i], rule.allowed));
}

void check_overlaps(const ParticleStore& s,
                    std::span<const std::pair<std::int32_t, std::int32_t>> candidates,
                    const std::string& source, std::span<const std::int32_t> lines) {
    struct Bad {
        double relative;  ///< overlap over the smaller radius [-]
        std::int32_t i, j;
    };
    std::vector<Bad> bad;
    for (const auto& [a, b] : candidates) {
        const std::size_t i = std::min(a, b);
        const std::size_t j = std::max(a, b);
        const double reach = s.radius[i] + s.radius[j];
        const double smaller = std::min(s.radius[i], s.radius[j]);
        const double overlap = reach - (s.position[j] - s.position[i]).norm();
        if (i != j && overlap > largest_relative_overlap * smaller)
            bad.push_back({overlap / smaller, std::min(a, b), std::max(a, b)});
    }
    if (bad.empty()) return;
    // Worst first, then by ids, so that the message does not hang on the order of the candidates.
    const auto order = [](const Bad& p, const Bad& q) {
        return std::tuple(-p.relative, p.i, p.j) < std::tuple(-q.relative, q.i, q.j);
    };
    const auto same = [](const Bad& p, const Bad& q) { return p.i == q.i && p.j == q.j; };
    std::sort(bad.begin(), bad.end(), order);
    bad.erase(std::unique(bad.begin(), bad.end(), same), bad.end());
    const auto i = static_cast<std::size_t>(bad[0].i);
    const auto j = static_cast<std::size_t>(bad[0].j);
    const double smaller = std::min(s.radius[i], s.radius[j]);
    throw InputError(
        fmt::format("{}: {} and {} overlap by {:.4g} m = {:.4g} % of the smaller radius {:.4g} m; "
                    "allowed: {:g} % ({} such pair{})",
                    source, name_of(i, lines), name_of(j, lines), bad[0].relative * smaller,
                    100 * bad[0].relative, smaller, 100 * largest_relative_overlap, bad.size(),
                    bad.size() == 1 ? "" : "s"));
}

}  // namespace grainfield::core
