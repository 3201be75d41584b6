// What is read off a stress-strain curve.
#include "triaxial/realization/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"

namespace grainfield::triaxial {
namespace {

CurvePoint point(double strain, double q) {
    CurvePoint p;
    p.axial_strain = strain;
    p.deviator_stress = q;
    return p;
}

/// q = peak * 2 s/(1 + s^2), s = strain/strain_at_peak: half the peak at s = 2 - sqrt(3).
std::vector<CurvePoint> smooth_curve(double peak, double strain_at_peak, double interval,
                                     double end) {
    std::vector<CurvePoint> curve;
    for (int k = 0; k * interval <= end; ++k) {
        const double s = k * interval / strain_at_peak;
        curve.push_back(point(k * interval, peak * 2 * s / (1 + s * s)));
    }
    return curve;
}

TEST(Curve, SmoothCurveInClosedForm) {
    const CurveResults r = evaluate_curve(smooth_curve(180e3, 0.01, 5e-5, 0.03), 100e3);
    EXPECT_NEAR(r.peak_deviator_stress, 180e3, 1e-6 * 180e3);
    EXPECT_NEAR(r.axial_strain_at_peak, 0.01, 1e-12);
    const double E50 = 90e3 / (0.01 * (2 - std::sqrt(3.0)));
    // Linear between points 5e-5 apart: curvature leaves h^2 q''/8q', 1e-5 here.
    EXPECT_NEAR(r.E50, E50, 1e-4 * E50);
    // Means over the window h, a fifth of the strain: h^2 q''/24q' of the strain is 7e-4.
    EXPECT_NEAR(r.smoothed_E50, E50, 1.5e-3 * E50);
    EXPECT_NEAR(std::sin(r.friction_angle), 180.0 / 380.0, 1e-6);
}

TEST(Curve, PiecewiseLinearCurveIsExact) {
    // Half the peak lies between the first two points, in the straight piece from (0, 0).
    const std::vector<CurvePoint> coarse{point(0.004, 120), point(0.01, 200), point(0.02, 150)};
    const CurveResults r = evaluate_curve(coarse, 100);
    EXPECT_EQ(r.peak_deviator_stress, 200);
    EXPECT_EQ(r.axial_strain_at_peak, 0.01);
    EXPECT_NEAR(r.E50, 120 / 0.004, 1e-9);
    EXPECT_NEAR(r.friction_angle, std::asin(0.5), 1e-15);
    // Between two later points.
    const std::vector<CurvePoint> later{point(0.001, 20), point(0.003, 60), point(0.005, 140),
                                        point(0.01, 200)};
    EXPECT_NEAR(evaluate_curve(later, 100).E50, 100 / 0.004, 1e-9);
}

TEST(Curve, LoadingBranchCountsNotTheFallingOne) {
    std::vector<CurvePoint> curve = smooth_curve(180e3, 0.01, 1e-4, 0.09);  // back to 40 kPa
    const double expected = 90e3 / (0.01 * (2 - std::sqrt(3.0)));
    EXPECT_NEAR(evaluate_curve(curve, 100e3).E50, expected, 1e-3 * expected);
}

TEST(Curve, NoPositiveStressIsAnError) {
    EXPECT_THROW(evaluate_curve({}, 100e3), SimulationError);
    EXPECT_THROW(evaluate_curve({point(0, 0), point(1e-4, -3)}, 100e3), SimulationError);
}

TEST(Curve, PeakBeforeAnyStrainIsAnError) {
    std::vector<CurvePoint> curve(2);
    curve[0].deviator_stress = 0.09;
    curve[1].axial_strain = 1e-3;
    curve[1].deviator_stress = -5;
    EXPECT_THROW(evaluate_curve(curve, 4e5), SimulationError);
}

/// Straight lines from (0, 0) through the corners, recorded every 5e-5 of strain.
std::vector<CurvePoint> straight_lines(const std::vector<std::pair<double, double>>& corners) {
    std::vector<CurvePoint> curve{point(0, 0)};
    double strain0 = 0, q0 = 0;
    for (const auto& [strain1, q1] : corners) {
        const int points = static_cast<int>(std::lround((strain1 - strain0) / 5e-5));
        for (int k = 1; k <= points; ++k)
            curve.push_back(
                point(strain0 + (strain1 - strain0) * k / points, q0 + (q1 - q0) * k / points));
        strain0 = strain1;
        q0 = q1;
    }
    return curve;
}

/// Half the peak is passed three times; the last rise before the peak counts.
TEST(Curve, ModulusIsThatOfTheLastRiseThroughHalfThePeak) {
    const auto curve = straight_lines({{0.01, 70}, {0.03, 40}, {0.06, 40}, {0.1, 120}, {0.12, 90}});
    const CurveResults r = evaluate_curve(curve, 100);
    EXPECT_EQ(r.peak_deviator_stress, 120);
    EXPECT_NEAR(r.E50, 60 / 0.07, 1e-6);  // 60 / 0.0086 at the first rise
    EXPECT_NEAR(r.smoothed_E50, 60 / 0.07, 1e-6);
    EXPECT_FALSE(moduli_differ(r.E50, r.smoothed_E50));
}

/// A single point that jumps over half the peak is no loading: the modulus stays by the curve.
TEST(Curve, ModulusIsNotThatOfASpike) {
    auto curve = straight_lines({{0.01, 100}, {0.02, 60}});
    curve[40].deviator_stress = 70;  // at 0.2 %, where the curve has 20
    const CurveResults r = evaluate_curve(curve, 100);
    EXPECT_NEAR(r.E50, 50 / 0.005, 1e-6);
    EXPECT_NEAR(r.smoothed_E50, 50 / 0.005, 0.01 * 50 / 0.005);
}

TEST(Curve, ModuliAreBothGivenWhereTheyDifferByTwoPercent) {
    EXPECT_FALSE(moduli_differ(100, 101.9));
    EXPECT_TRUE(moduli_differ(100, 102.1));
    EXPECT_TRUE(moduli_differ(102.1, 100));
}

TEST(Curve, SmoothedPeakLiesBelowTheRecordedOneByTheNoise) {
    auto curve = smooth_curve(180e3, 0.01, 5e-5, 0.03);
    EXPECT_NEAR(evaluate_curve(curve, 100e3).smoothed_deviator_stress, 180e3, 0.005 * 180e3);
    curve[200].deviator_stress = 200e3;
    const CurveResults r = evaluate_curve(curve, 100e3);
    EXPECT_EQ(r.peak_deviator_stress, 200e3);
    EXPECT_NEAR(r.smoothed_deviator_stress, 180e3, 0.005 * 180e3);
}

}  // namespace
}  // namespace grainfield::triaxial
