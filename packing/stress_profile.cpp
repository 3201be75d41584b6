#include "packing/stress_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/drive/measures.hpp"

namespace grainfield::packing {
namespace {

/// Least-squares line y = slope x + intercept and its R^2.
struct Line {
    double slope, intercept, r2;
};
Line fit(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, xy = 0, yy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        xx += (x[k] - mx) * (x[k] - mx);
        xy += (x[k] - mx) * (y[k] - my);
        yy += (y[k] - my) * (y[k] - my);
    }
    if (xx == 0 || yy == 0) return {0, my, 0};
    return {xy / xx, my - xy / xx * mx, xy * xy / (xx * yy)};
}

}  // namespace

StressProfile measure_stress_profile(const core::Simulation& simulation, double top, double base,
                                     double gravity, int layers) {
    StressProfile profile;
    const auto n = static_cast<std::size_t>(layers);
    const double height = top / layers;
    std::vector<Vec3> sums(n, Vec3::Zero());  // bottom layer first
    for (const core::Branch& b : core::force_branches(simulation)) {
        const Vec3 branch = b.to - b.from;
        const double low = std::min(b.from.y(), b.to.y()), high = std::max(b.from.y(), b.to.y());
        const auto first = std::clamp(static_cast<int>(low / height), 0, layers - 1);
        const auto last = std::clamp(static_cast<int>(high / height), 0, layers - 1);
        for (int layer = first; layer <= last; ++layer) {
            // The outermost layers take what lies beyond them.
            const double from = layer == 0 ? low : std::max(low, layer * height);
            const double to = layer == layers - 1 ? high : std::min(high, (layer + 1) * height);
            const double share = high > low ? (to - from) / (high - low) : 1.0;
            sums[static_cast<std::size_t>(layer)] += share * b.force.cwiseProduct(branch);
        }
    }
    const double volume = base * height;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 stress = sums[n - 1 - k] / volume;
        profile.depth.push_back((static_cast<double>(k) + 0.5) * height);
        profile.vertical.push_back(stress.y());
        profile.horizontal_x.push_back(stress.x());
        profile.horizontal_z.push_back(stress.z());
    }
    const auto& mass = simulation.spheres().mass;
    profile.unit_weight = std::accumulate(mass.begin(), mass.end(), 0.0) * gravity / (base * top);
    const Line vertical = fit(profile.depth, profile.vertical);
    profile.slope_ratio = vertical.slope / profile.unit_weight;
    profile.r2 = vertical.r2;
    std::vector<double> horizontal(n);
    for (std::size_t k = 0; k < n; ++k)
        horizontal[k] = 0.5 * (profile.horizontal_x[k] + profile.horizontal_z[k]);
    profile.K0 = fit(profile.vertical, horizontal).slope;
    return profile;
}

}  // namespace grainfield::packing
