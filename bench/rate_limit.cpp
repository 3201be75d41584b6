#include "bench/rate_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace grainfield::bench {
namespace {

struct Fit {
    RateLaw law;
    double chi_square = std::numeric_limits<double>::infinity();
};

constexpr int first_exponent = 30, last_exponent = 120, exponent_step = 2;  // [1/100]

/// The points of one damping with the powers of their rates, an exponent a row.
struct Powers {
    std::vector<const RatePoint*> points;
    std::vector<std::vector<double>> rows;

    Powers(std::span<const RatePoint> all, std::size_t damping) {
        for (const RatePoint& p : all)
            if (p.damping == static_cast<int>(damping)) points.push_back(&p);
        for (int k = first_exponent; k <= last_exponent; k += exponent_step) {
            rows.emplace_back();
            for (const RatePoint* p : points) rows.back().push_back(std::pow(p->rate, 0.01 * k));
        }
    }
};

/// The best law for a given limit: the slope by least squares, the exponent by search.
Fit fit_law(const Powers& powers, double limit, double deviation) {
    Fit best;
    for (std::size_t row = 0; row < powers.rows.size(); ++row) {
        const std::vector<double>& x = powers.rows[row];
        double products = 0, squares = 0, chi_square = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            products += powers.points[k]->runs * x[k] * (powers.points[k]->value - limit);
            squares += powers.points[k]->runs * x[k] * x[k];
        }
        const double slope = products / squares;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double off = (powers.points[k]->value - limit - slope * x[k]) / deviation;
            chi_square += powers.points[k]->runs * off * off;
        }
        if (chi_square < best.chi_square) {
            const double exponent = 0.01 * (first_exponent + exponent_step * static_cast<int>(row));
            best = {{slope, exponent}, chi_square};
        }
    }
    return best;
}

double chi_square(const std::vector<Powers>& dampings, double limit, double deviation) {
    double sum = 0;
    for (const Powers& damping : dampings) sum += fit_law(damping, limit, deviation).chi_square;
    return sum;
}

}  // namespace

double RateLimit::rate_within(std::size_t damping, double share) const {
    const RateLaw& law = laws[damping];
    return std::pow(share * value / std::abs(law.slope), 1 / law.exponent);
}

RateLimit rate_limit(std::span<const RatePoint> points, std::size_t dampings, double deviation) {
    if (!(deviation > 0)) throw std::invalid_argument("rate_limit: no scatter of single runs");
    const auto [least, most] =
        std::ranges::minmax(points, {}, [](const RatePoint& p) { return p.value; });
    std::vector<Powers> powers;
    for (std::size_t d = 0; d < dampings; ++d) powers.emplace_back(points, d);
    // A grid: the profile has kinks where the exponent of a damping reaches its bounds.
    constexpr int steps = 2000;
    const double from = 0.3 * least.value, step = (1.3 * most.value - from) / steps;
    std::vector<double> profile;
    for (int k = 0; k <= steps; ++k)
        profile.push_back(chi_square(powers, from + k * step, deviation));
    const auto lowest = std::ranges::min_element(profile);
    const auto at = static_cast<std::size_t>(lowest - profile.begin());

    RateLimit limit;
    limit.value = from + static_cast<double>(at) * step;
    const auto freedom = static_cast<double>(points.size()) - 1 - 2 * static_cast<double>(dampings);
    limit.misfit = *lowest / std::max(1.0, freedom);
    const double allowed = *lowest + 3.841 * std::max(1.0, limit.misfit);  // chi-square, 95 %
    std::size_t low = at, high = at;
    while (low > 0 && profile[low] <= allowed) --low;
    while (high + 1 < profile.size() && profile[high] <= allowed) ++high;
    limit.low = from + static_cast<double>(low) * step;
    limit.high = from + static_cast<double>(high) * step;
    for (const Powers& damping : powers)
        limit.laws.push_back(fit_law(damping, limit.value, deviation).law);
    return limit;
}

}  // namespace grainfield::bench
