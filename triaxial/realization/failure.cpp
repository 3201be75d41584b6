#include "triaxial/realization/failure.hpp"

#include <algorithm>
#include <cmath>

namespace grainfield::triaxial {
namespace {

// The constants of the end of a test. They were chosen on one half of the tests of
// bench/results/stopping.md and checked on the other.

// Softening that ends a test: so far below the smoothed peak ...
constexpr double softening = 0.10;  // [-]
// ... over so much strain: a share of the strain at the peak, and not less than this.
constexpr double hold_share = 0.5;       // [-]
constexpr double shortest_hold = 0.003;  // [-]

// What is called a peak once a test has ended needs to be held for less.
constexpr double label_hold_share = 0.1;  // [-]

// Strength above that of the critical state comes from dilation (Rowe 1962, Bolton 1986). A sample
// that does not dilate at its peak contracts on and hardens again, however long the dip: 32 % over
// 5 % of strain were seen. So the volume must grow by this much per axial strain at the peak,
constexpr double least_dilation = 0.25;  // [-]
// averaged over this much strain on either side.
constexpr double dilation_reach = 0.0025;  // [-]
// Stress fluctuates with the number of force chains across the sample, about n^(2/3) of n spheres,
// and their mean by n^(-1/3). Small samples recover from any dip, unless they dilate by more:
constexpr double small_sample_dilation = 6.2;  // times n^(-1/3) [-]

// A plateau stays within this share of its highest value ...
constexpr double plateau_band = 0.05;  // [-]
// ... for as long as it took to reach it and for this strain at least.
constexpr double shortest_plateau = 0.04;  // [-]
// It ends a test only in the critical state: with no more change of volume per axial strain.
constexpr double plateau_dilation = 0.10;  // [-]

/// First point at `strain` or beyond; the size of the curve if there is none.
std::size_t first_at(std::span<const CurvePoint> curve, double strain) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(curve, strain, {}, &CurvePoint::axial_strain) - curve.begin());
}

/// Growth of volume per axial strain between two points [-].
double dilation(const CurvePoint& from, const CurvePoint& to) {
    return -(to.volumetric_strain - from.volumetric_strain) / (to.axial_strain - from.axial_strain);
}

/// Whether the sample dilated at its peak by more than fluctuations of its size come to.
bool dilates_at(std::span<const CurvePoint> curve, double strain, std::size_t spheres) {
    const std::size_t last = curve.size() - 1;
    const CurvePoint& from = curve[std::min(last, first_at(curve, strain - dilation_reach))];
    const CurvePoint& to = curve[std::min(last, first_at(curve, strain + dilation_reach))];
    const double size = std::cbrt(static_cast<double>(std::max<std::size_t>(spheres, 1)));
    return to.axial_strain > from.axial_strain &&
           dilation(from, to) >= std::max(least_dilation, small_sample_dilation / size);
}

/// The smoothed curve after the start transient with its highest point.
struct Smoothed {
    SmoothedCurve curve;
    std::size_t highest = 0;

    Smoothed(std::span<const CurvePoint> points, double transient_strain) {
        points = points.subspan(first_at(points, transient_strain));
        curve = smoothed_curve(points, smoothing_window);
        if (points.empty()) return;
        // Only full windows count: the first ones hold few points.
        std::size_t full = first_at(points, points[0].axial_strain + smoothing_window);
        if (full == points.size()) full = 0;
        const auto& q = curve.deviator_stress;
        highest = static_cast<std::size_t>(
            std::max_element(q.begin() + static_cast<std::ptrdiff_t>(full), q.end()) - q.begin());
    }
    std::size_t size() const { return curve.axial_strain.size(); }
    double strain(std::size_t k) const { return curve.axial_strain[k]; }
    double stress(std::size_t k) const { return curve.deviator_stress[k]; }
    double peak() const { return stress(highest); }
    double strain_at_peak() const { return strain(highest); }
    bool softened(std::size_t k) const { return stress(k) <= (1 - softening) * peak(); }

    /// First point of those up to the last one that all lie within the band below the highest.
    std::size_t plateau_begin() const {
        std::size_t k = size();
        while (k > 0 && stress(k - 1) >= (1 - plateau_band) * peak()) --k;
        return k;
    }
    bool level() const {
        const std::size_t begin = plateau_begin();
        return begin < size() && begin <= highest &&
               strain(size() - 1) - strain(begin) >= std::max(shortest_plateau, strain(begin));
    }
};

}  // namespace

std::string_view failure_name(Failure failure) {
    switch (failure) {
        case Failure::peak:
            return "peak";
        case Failure::plateau:
            return "plateau";
        case Failure::strain_limit:
            break;
    }
    return "strain-limit";
}

std::optional<Failure> failure_of_name(std::string_view name) {
    for (const Failure failure : {Failure::peak, Failure::plateau, Failure::strain_limit})
        if (name == failure_name(failure)) return failure;
    return std::nullopt;
}

std::string end_in_words(std::string_view end_reason) {
    if (end_reason == ended_as_asked) return "the axial strain asked for was reached";
    const std::optional<Failure> failure = failure_of_name(end_reason);
    if (failure == Failure::peak) return "q stayed more than 10 % below its peak";
    if (failure == Failure::plateau) return "q had levelled off, and the volume with it";
    if (failure == Failure::strain_limit) return "15 % of axial strain, the limit of a test";
    return std::string(end_reason);
}

SmoothedCurve smoothed_curve(std::span<const CurvePoint> curve, double window) {
    SmoothedCurve smoothed;
    smoothed.axial_strain.reserve(curve.size());
    smoothed.deviator_stress.reserve(curve.size());
    double strains = 0, stresses = 0;
    std::size_t first = 0;
    for (std::size_t k = 0; k < curve.size(); ++k) {
        strains += curve[k].axial_strain;
        stresses += curve[k].deviator_stress;
        for (; curve[k].axial_strain - curve[first].axial_strain >= window && first < k; ++first) {
            strains -= curve[first].axial_strain;
            stresses -= curve[first].deviator_stress;
        }
        const auto n = static_cast<double>(k - first + 1);
        smoothed.axial_strain.push_back(strains / n);
        smoothed.deviator_stress.push_back(stresses / n);
    }
    return smoothed;
}

double smoothed_peak(std::span<const CurvePoint> curve, const FailureRule& rule) {
    const Smoothed s(curve, rule.transient_strain);
    return s.size() > 0 ? s.peak() : 0;
}

Failure failure_of(std::span<const CurvePoint> curve, const FailureRule& rule) {
    const Smoothed s(curve, rule.transient_strain);
    if (s.size() == 0 || !(s.peak() > 0)) return Failure::strain_limit;
    const double hold = std::max(shortest_hold, label_hold_share * s.strain_at_peak());
    std::size_t since = s.highest;  // the last point that had not softened
    for (std::size_t k = s.highest; k < s.size(); ++k) {
        if (!s.softened(k)) since = k;
        if (s.strain(k) - s.strain(since) >= hold) return Failure::peak;
    }
    return s.level() ? Failure::plateau : Failure::strain_limit;
}

std::optional<Failure> reached_failure(std::span<const CurvePoint> curve, const FailureRule& rule) {
    if (curve.empty()) return std::nullopt;
    const Smoothed s(curve, rule.transient_strain);
    if (s.size() > 0 && s.peak() > 0) {
        const double hold = std::max(shortest_hold, hold_share * s.strain_at_peak());
        std::size_t since = s.size() - 1;
        while (since > s.highest && s.softened(since)) --since;
        if (s.strain(s.size() - 1) - s.strain(since) >= hold &&
            dilates_at(curve, s.strain_at_peak(), rule.spheres))
            return Failure::peak;
        if (s.level()) {
            const std::size_t begin = first_at(curve, s.strain(s.plateau_begin()));
            if (std::abs(dilation(curve[begin], curve.back())) <= plateau_dilation)
                return Failure::plateau;
        }
    }
    if (curve.back().axial_strain >= failure_strain_limit) return Failure::strain_limit;
    return std::nullopt;
}

}  // namespace grainfield::triaxial
