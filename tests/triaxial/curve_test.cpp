// What is read off a stress-strain curve, and when a test may end.
#include "triaxial/realization/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

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

/// Strain at which the watch ends the test, and its reason.
std::pair<double, std::string> ended(const std::vector<CurvePoint>& curve) {
    PeakWatch watch(100e3);
    for (const CurvePoint& p : curve)
        if (watch.past_peak(p)) return {p.axial_strain, watch.reason()};
    return {-1, ""};
}

TEST(Curve, PeakBeforeAnyStrainIsAnError) {
    std::vector<CurvePoint> curve(2);
    curve[0].deviator_stress = 0.09;
    curve[1].axial_strain = 1e-3;
    curve[1].deviator_stress = -5;
    EXPECT_THROW(evaluate_curve(curve, 4e5), SimulationError);
}

TEST(PeakWatch, FallOfFivePercent) {
    // 2 s/(1 + s^2) = 0.95 at s = (1 + sqrt(1 - 0.95^2))/0.95.
    const double s = (1 + std::sqrt(1 - 0.95 * 0.95)) / 0.95;
    const auto [strain, reason] = ended(smooth_curve(180e3, 0.01, 5e-5, 0.03));
    EXPECT_NEAR(strain, 0.01 * s, 5e-5);
    EXPECT_NE(reason.find("5 %"), std::string::npos) << reason;
}

TEST(PeakWatch, NoNewPeakForOnePercentOfStrain) {
    std::vector<CurvePoint> curve;
    for (int k = 0; k <= 1000; ++k) {  // up to 200 at 2 %, then down by 2 % in 4 % of strain
        const double strain = k * 1e-4;
        curve.push_back(point(strain, strain <= 0.02 ? 1e4 * strain : 200 - 100 * (strain - 0.02)));
    }
    const auto [strain, reason] = ended(curve);
    EXPECT_NEAR(strain, 0.03, 1.5e-4);
    EXPECT_NE(reason.find("no new peak"), std::string::npos) << reason;
}

TEST(PeakWatch, TenPercentWhereStressKeepsGrowing) {
    std::vector<CurvePoint> curve;
    for (int k = 0; k <= 1200; ++k) curve.push_back(point(k * 1e-4, 100.0 * k));
    const auto [strain, reason] = ended(curve);
    EXPECT_NEAR(strain, 0.1, 1e-6);
    EXPECT_NE(reason.find("10 %"), std::string::npos) << reason;
}

TEST(PeakWatch, NoiseEndsATestNeitherEarlyNorNever) {
    // 1 % of the peak, as a single realization's chaos is, uniform about the smooth curve.
    const core::RandomStream random(1, core::Stream::perturbation);
    for (std::uint64_t k = 0; k < 20; ++k) {
        std::vector<CurvePoint> curve = smooth_curve(180e3, 0.015, 5e-5, 0.1);
        for (std::size_t i = 1; i < curve.size(); ++i)
            curve[i].deviator_stress += 180e3 * 0.02 * (random.uniform(k, i) - 0.5);
        const auto [strain, reason] = ended(curve);
        EXPECT_GT(strain, 0.015) << k;
        EXPECT_LT(strain, 0.03) << k << reason;
    }
}

TEST(PeakWatch, NegativeStartIsNoPeak) {
    PeakWatch watch(100e3);
    EXPECT_FALSE(watch.past_peak(point(0, -1e3)));
    EXPECT_FALSE(watch.past_peak(point(5e-5, -2e3)));
    EXPECT_FALSE(watch.past_peak(point(1e-4, 5e3)));
    EXPECT_EQ(watch.peak(), 5e3);
}

/// Noise in the first points, where q is a small part of what it becomes, ends no test.
TEST(PeakWatch, NoiseAtTheStartDoesNotEndATest) {
    PeakWatch watch(100e3);
    EXPECT_FALSE(watch.past_peak(point(0, 40)));
    EXPECT_FALSE(watch.past_peak(point(5e-5, 20))) << watch.reason();
    EXPECT_FALSE(watch.past_peak(point(1e-4, 2e3)));
}

}  // namespace
}  // namespace grainfield::triaxial
