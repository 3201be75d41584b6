#pragma once
// Diameters of the spheres of a block, drawn from a sieve curve by mass.

#include <cstdint>
#include <vector>

#include "core/base/monitor.hpp"
#include "packing/packing_options.hpp"

namespace grainfield::packing {

/// Eq. (2) of Tran et al., read as in docs/method.md, section 4.1: the curve is by mass, so that
/// diameters have the number density f(D)/D^3, f being the slope of the curve. In closed form
/// segment by segment.
class NumberDistribution {
  public:
    explicit NumberDistribution(const Grading& grading);

    /// Diameter below which the share u in [0, 1] of the grains lies [m].
    double quantile(double u) const;
    /// Mean of D^3 over the grains between the shares u0 < u1 [m3].
    double mean_cube(double u0, double u1) const;
    /// The two sieves with the largest share of the grains between them.
    struct Piece {
        double fine, coarse;  // sieves [m]
        double share;         // of the grains, by number [-]
    };
    Piece most_numerous() const;

  private:
    struct Segment {
        double d0, d1;  // sieves [m]
        double slope;   // of the passing share by mass [1/m]
        double u0, u1;  // cumulative shares by number [-]
        double mass0;   // passing share by mass at d0 [-]
    };
    double mass_share(double u) const;

    std::vector<Segment> segments_;
    double inverse_mean_cube_ = 0;  // integral of f/D^3 [1/m3]
};

struct GradingDraw {
    std::vector<double> diameter;  ///< ascending [m]
    double scale = 1;              ///< what the drawn diameters were multiplied by [-]
};

/// Spheres that together have the target volume [m3]. Stratified: one grain from each of n equal
/// shares of the number distribution. n follows from the volume, or is `count`; a common factor
/// then brings the volume to the target exactly. Throws InputError where that would be more than
/// most_spheres, and Interrupted where the monitor asks to stop.
GradingDraw draw_diameters(const Grading& grading, double target_volume, std::uint64_t seed,
                           std::optional<std::int32_t> count, core::Monitor* monitor = nullptr);

/// How many spheres have the target volume [m3], but for the scatter of a draw.
double expected_spheres(const Grading& grading, double target_volume);

/// Share of the mass in the `count` largest grains; diameters ascend [-].
double mass_share_of_largest(const std::vector<double>& diameters, std::size_t count);

/// Share by mass of the spheres at or below each diameter [%], like the sieve curve.
std::vector<double> achieved_passing(const std::vector<double>& diameters,
                                     const std::vector<double>& sieves);

}  // namespace grainfield::packing
