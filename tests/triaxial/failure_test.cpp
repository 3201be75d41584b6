// When a test has failed: made-up curves for every branch of the rule, and recorded ones.
#include "triaxial/realization/failure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "triaxial/realization/curve.hpp"
#include "triaxial/report/number_table.hpp"

namespace grainfield::triaxial {
namespace {

using Curve = std::vector<CurvePoint>;
using Function = std::function<double(double)>;  // of the axial strain

constexpr FailureRule full_sample{.spheres = 151632, .transient_strain = 0.001};
constexpr FailureRule small_sample{.spheres = 628, .transient_strain = 0.001};

/// q [Pa] and the growth of volume per axial strain, recorded as a test does.
Curve curve_of(const Function& q, double dilation, double end = 0.16, double interval = 5e-5) {
    Curve curve;
    for (int k = 0; k * interval <= end; ++k) {
        CurvePoint p;
        p.axial_strain = k * interval;
        p.deviator_stress = q(p.axial_strain);
        p.volumetric_strain = -dilation * p.axial_strain;
        curve.push_back(p);
    }
    return curve;
}

/// 200 kPa at a strain of 1 %, 90 % of that at 1.595 %, 40 % at 4.79 %.
double softening_stress(double strain) {
    const double s = strain / 0.01;
    return 200e3 * 2 * s / (1 + s * s);
}

/// Straight lines between corners.
Function polygon(std::vector<std::pair<double, double>> corners) {
    return [corners = std::move(corners)](double strain) {
        for (std::size_t k = 1; k < corners.size(); ++k) {
            const auto& [x0, q0] = corners[k - 1];
            const auto& [x1, q1] = corners[k];
            if (strain <= x1) return q0 + (q1 - q0) * (strain - x0) / (x1 - x0);
        }
        return corners.back().second;
    };
}

struct End {
    double strain = -1;
    std::optional<Failure> failure;
};

/// Where a test with this curve ends, looked for at every recorded point.
End end_of(const Curve& curve, const FailureRule& rule) {
    for (std::size_t n = 1; n <= curve.size(); ++n)
        if (const auto failure = reached_failure({curve.data(), n}, rule))
            return {curve[n - 1].axial_strain, failure};
    return {};
}

TEST(Failure, EndsADilatantTestOnceItHasSoftenedForHalfTheStrainAtThePeak) {
    const End end = end_of(curve_of(softening_stress, 0.8), full_sample);
    EXPECT_EQ(end.failure, Failure::peak);
    // 10 % below the peak from 1.595 % on, and 0.5 % further; smoothing lags by half its window.
    EXPECT_NEAR(end.strain, 0.01595 + 0.005 + 0.001, 3e-4);
}

TEST(Failure, SofteningOfAContractingSampleIsADipHoweverLong) {
    // As a loose sample did: 70 kPa at 1 %, 48 kPa from 3 to 7 %, 140 kPa at 13 %.
    const Function q =
        polygon({{0, 0}, {0.01, 70e3}, {0.03, 48e3}, {0.07, 48e3}, {0.13, 140e3}, {0.2, 120e3}});
    const End end = end_of(curve_of(q, -0.2), full_sample);
    EXPECT_EQ(end.failure, Failure::strain_limit);
    EXPECT_NEAR(end.strain, 0.15, 1e-9);
    EXPECT_NEAR(end_of(curve_of(q, 0.2), full_sample).strain, 0.15, 1e-9);
    EXPECT_LT(end_of(curve_of(q, 0.3), full_sample).strain, 0.04);
}

TEST(Failure, ASmallSampleMustDilateMore) {
    // 6.2/628^(1/3) = 0.724.
    EXPECT_NEAR(end_of(curve_of(softening_stress, 0.70), small_sample).strain, 0.15, 1e-9);
    EXPECT_LT(end_of(curve_of(softening_stress, 0.75), small_sample).strain, 0.025);
}

TEST(Failure, DilationAtThePeakIsAMeanOverBothSidesOfIt) {
    // Volume that grows on one side only counts by half: 0.25 is needed.
    for (const bool before : {true, false})
        for (const auto& [dilation, failure] :
             {std::pair{0.4, Failure::strain_limit}, {0.6, Failure::peak}}) {
            Curve curve = curve_of(softening_stress, 0);
            for (CurvePoint& p : curve) {
                const double beyond = p.axial_strain - 0.01;
                p.volumetric_strain =
                    -dilation * (before ? std::min(beyond, 0.0) : std::max(beyond, 0.0));
            }
            EXPECT_EQ(end_of(curve, full_sample).failure, failure) << before << ' ' << dilation;
        }
}

TEST(Failure, ADipThatRecoversEndsNothing) {
    // A deep one that is short, and a long one of less than 10 %; then on to the peak at 5 %.
    const Function deep = polygon({{0, 0},
                                   {0.02, 100e3},
                                   {0.021, 70e3},
                                   {0.027, 70e3},
                                   {0.028, 100e3},
                                   {0.05, 130e3},
                                   {0.06, 80e3},
                                   {0.2, 80e3}});
    const Function shallow =
        polygon({{0, 0}, {0.02, 100e3}, {0.025, 92e3}, {0.045, 92e3}, {0.06, 130e3}, {0.08, 80e3}});
    for (const Function& q : {deep, shallow}) {
        const Curve curve = curve_of(q, 0.8);
        const End end = end_of(curve, full_sample);
        EXPECT_EQ(end.failure, Failure::peak);
        EXPECT_GT(end.strain, 0.06);
        EXPECT_LT(end.strain, 0.12);
        EXPECT_NEAR(evaluate_curve(curve, 100e3, full_sample).peak_deviator_stress, 130e3, 1);
    }
}

TEST(Failure, TheHigherOfTwoPeaksCounts) {
    const Function q =
        polygon({{0, 0}, {0.02, 100e3}, {0.026, 85e3}, {0.034, 105e3}, {0.04, 70e3}, {0.2, 70e3}});
    const Curve curve = curve_of(q, 0.8);
    const End end = end_of(curve, full_sample);
    EXPECT_EQ(end.failure, Failure::peak);
    EXPECT_GT(end.strain, 0.034 + 0.017);
    const auto ended = static_cast<std::ptrdiff_t>(std::lround(end.strain / 5e-5)) + 1;
    const CurveResults r =
        evaluate_curve({curve.begin(), curve.begin() + ended}, 100e3, full_sample);
    EXPECT_NEAR(r.axial_strain_at_peak, 0.034, 1e-9);
    EXPECT_EQ(r.failure, Failure::peak);
}

TEST(Failure, APlateauAtConstantVolumeEndsATest) {
    const Function level = polygon({{0, 0}, {0.02, 100e3}, {0.2, 100e3}});
    const End end = end_of(curve_of(level, 0.05), full_sample);
    EXPECT_EQ(end.failure, Failure::plateau);
    EXPECT_NEAR(end.strain, 0.019 + 0.04 + 0.001, 3e-4);  // from 95 % on, 4 %, half a window
    // Reached at 6 %, it must last as long.
    const Function late = polygon({{0, 0}, {0.06, 100e3}, {0.2, 100e3}});
    EXPECT_NEAR(end_of(curve_of(late, 0.0), full_sample).strain, 2 * 0.057 + 0.001, 3e-4);
    // A sample that still contracts will harden.
    EXPECT_NEAR(end_of(curve_of(level, -0.2), full_sample).strain, 0.15, 1e-9);
    EXPECT_EQ(failure_of(curve_of(level, -0.2), full_sample), Failure::plateau);
}

TEST(Failure, HardeningGoesToTheLimit) {
    const Curve curve = curve_of([](double strain) { return 1e6 * strain; }, 0.0);
    const End end = end_of(curve, full_sample);
    EXPECT_EQ(end.failure, Failure::strain_limit);
    EXPECT_NEAR(end.strain, 0.15, 1e-9);
    EXPECT_EQ(failure_of(curve, full_sample), Failure::strain_limit);
}

TEST(Failure, NoiseEndsATestNeitherEarlyNorNever) {
    // 1 % of the peak, as a single realization's chaos is, uniform about the smooth curve.
    const core::RandomStream random(1, core::Stream::perturbation);
    for (std::uint64_t k = 0; k < 20; ++k) {
        Curve curve =
            curve_of([](double strain) { return softening_stress(strain / 1.5); }, 0.8, 0.05);
        for (std::size_t i = 1; i < curve.size(); ++i)
            curve[i].deviator_stress += 200e3 * 0.02 * (random.uniform(k, i) - 0.5);
        const End end = end_of(curve, full_sample);
        EXPECT_GT(end.strain, 0.025) << k;
        EXPECT_LT(end.strain, 0.035) << k;
    }
}

TEST(Failure, NothingCountsInTheStartTransient) {
    // 150 kPa within 0.1 % of strain, before anything has had time to move; then the test.
    const FailureRule rule{.spheres = 151632, .transient_strain = 0.002};
    const Curve curve = curve_of(
        [](double strain) {
            return strain > 0 && strain < 0.001 ? 150e3 : 0.5 * softening_stress(strain);
        },
        0.8);
    const CurveResults r = evaluate_curve(curve, 100e3, rule);
    EXPECT_NEAR(r.peak_deviator_stress, 100e3, 1);
    EXPECT_NEAR(r.axial_strain_at_peak, 0.01, 1e-9);
    EXPECT_NEAR(end_of(curve, rule).strain, 0.022, 5e-4);
    // Without the limit the start would be the peak.
    EXPECT_EQ(evaluate_curve(curve, 100e3).peak_deviator_stress, 150e3);
    // A curve that ends within it is worth its last point.
    const Curve start(curve.begin(), curve.begin() + 31);
    const CurveResults last = evaluate_curve(start, 100e3, rule);
    EXPECT_EQ(last.peak_deviator_stress, start.back().deviator_stress);
    EXPECT_EQ(last.failure, Failure::strain_limit);
}

TEST(Failure, ShortCurvesAreNoFailure) {
    const core::RandomStream random(2, core::Stream::perturbation);
    EXPECT_FALSE(reached_failure({}, full_sample));
    EXPECT_EQ(failure_of({}, full_sample), Failure::strain_limit);
    EXPECT_EQ(smoothed_peak({}, full_sample), 0);
    for (std::uint64_t k = 0; k < 200; ++k) {
        Curve curve;
        for (std::uint64_t i = 0; i < 1 + k % 60; ++i) {
            CurvePoint p;
            p.axial_strain = 5e-5 * static_cast<double>(i);
            p.deviator_stress = 100e3 * (random.uniform(k, 2 * i) - 0.3);
            p.volumetric_strain = 1e-3 * (random.uniform(k, 2 * i + 1) - 0.5);
            curve.push_back(p);
        }
        EXPECT_FALSE(reached_failure(curve, full_sample)) << k;
        EXPECT_FALSE(reached_failure(curve, {})) << k;
        EXPECT_EQ(failure_of(curve, full_sample), Failure::strain_limit) << k;
    }
}

TEST(Failure, AFinishedCurveIsCalledWhatItIs) {
    const auto called = [](const Function& q, double end) {
        return failure_of(curve_of(q, 0, end), full_sample);
    };
    const Function fall = polygon({{0, 0}, {0.02, 100e3}, {0.03, 85e3}, {0.1, 85e3}});
    EXPECT_EQ(called(fall, 0.05), Failure::peak);
    EXPECT_EQ(called(fall, 0.018), Failure::strain_limit);  // before the peak
    EXPECT_EQ(called(fall, 0.027), Failure::strain_limit);  // not far enough below it
    // A rise of less than 5 % since the curve bent is a plateau, 10 % more are hardening.
    EXPECT_EQ(called(polygon({{0, 0}, {0.02, 100e3}, {0.1, 104e3}}), 0.1), Failure::plateau);
    EXPECT_EQ(called(polygon({{0, 0}, {0.02, 100e3}, {0.1, 125e3}}), 0.1), Failure::strain_limit);
    // Back after a dip, it has not stayed near its highest value.
    const Function back = polygon({{0, 0}, {0.02, 100e3}, {0.03, 92e3}, {0.04, 98e3}, {0.1, 98e3}});
    EXPECT_EQ(called(back, 0.1), Failure::strain_limit);
    // The highest point comes last.
    EXPECT_EQ(called(polygon({{0, 0}, {0.02, 100e3}, {0.03, 60e3}, {0.1, 130e3}}), 0.1),
              Failure::strain_limit);
}

TEST(Failure, NamesAndWords) {
    for (const Failure failure : {Failure::peak, Failure::plateau, Failure::strain_limit}) {
        EXPECT_EQ(failure_of_name(failure_name(failure)), failure);
        EXPECT_NE(end_in_words(failure_name(failure)), failure_name(failure));
    }
    EXPECT_EQ(failure_name(Failure::strain_limit), "strain-limit");
    EXPECT_FALSE(failure_of_name("asked"));
    EXPECT_NE(end_in_words(ended_as_asked), ended_as_asked);
    EXPECT_EQ(end_in_words("as an earlier version said"), "as an earlier version said");
}

TEST(SmoothedCurve, IsTheMeanOverTheWindow) {
    const Curve line = curve_of([](double strain) { return 3e6 * strain; }, 0, 0.01);
    const SmoothedCurve s = smoothed_curve(line, 0.002);
    ASSERT_EQ(s.axial_strain.size(), line.size());
    for (std::size_t k = 0; k < line.size(); ++k) {
        EXPECT_NEAR(s.deviator_stress[k], 3e6 * s.axial_strain[k], 1e-6) << k;
        EXPECT_NEAR(s.axial_strain[k],
                    line[k].axial_strain - std::min(0.5 * line[k].axial_strain, 0.001), 3e-5)
            << k;
    }
    // Points further apart than the window stay as they are.
    const Curve coarse = curve_of(softening_stress, 0, 0.05, 0.005);
    const SmoothedCurve same = smoothed_curve(coarse, 0.002);
    for (std::size_t k = 0; k < coarse.size(); ++k)
        EXPECT_NEAR(same.deviator_stress[k], coarse[k].deviator_stress, 1e-6);
}

TEST(SmoothedCurve, HasItsPeakWhereTheWindowIsFull) {
    // A jump at the first point that counts would be its own mean.
    Curve curve = curve_of(softening_stress, 0, 0.03);
    curve[20].deviator_stress = 1e6;
    EXPECT_NEAR(smoothed_peak(curve, full_sample), 200e3, 1e3);
}

/// A recorded curve, every fourth point: axial strain, deviator stress, volumetric strain.
Curve recorded(const std::string& name) {
    const auto columns = report::read_number_table(
        std::string(GRAINFIELD_SOURCE_DIR "/tests/triaxial/curves/") + name + ".csv",
        "axial_strain,deviator_stress_Pa,volumetric_strain");
    Curve curve(columns[0].size());
    for (std::size_t k = 0; k < curve.size(); ++k) {
        curve[k].axial_strain = columns[0][k];
        curve[k].deviator_stress = columns[1][k];
        curve[k].volumetric_strain = columns[2][k];
    }
    return curve;
}

struct Recorded {
    const char* name;
    std::size_t spheres;
    double peak, strain;      // of the whole curve, to 15 %
    double earliest, latest;  // strains between which the test may end
    double dip;               // how far the curve falls below its peak so far, before the peak
};

/// Curves to 15 % of strain. An end that gave less than the peak was the fault.
TEST(Failure, RecordedCurvesEndWithTheirPeak) {
    for (const Recorded& test : {// 100 kPa, packed without friction.
                                 Recorded{"dense", 5168, 241.4e3, 0.0099, 0.015, 0.022, 0},
                                 // k_n = 9e8 Pa, 100 kPa: a dip at 0.71 %.
                                 Recorded{"medium", 628, 135.4e3, 0.0212, 0.03, 0.15, 0.05},
                                 // k_n = 3e7 Pa, 100 kPa: a dip at 4 %.
                                 Recorded{"soft", 628, 137.0e3, 0.0753, 0.1, 0.15, 0.01},
                                 // 20 kPa: falls by half from 2 to 8 % and is back at 13 %.
                                 Recorded{"low_stress", 628, 34.2e3, 0.1294, 0.14, 0.15, 0.5},
                                 // Falls by a third from 1 to 5 % and doubles by 13 %.
                                 Recorded{"loose", 5616, 140.7e3, 0.1268, 0.14, 0.15, 0.1}}) {
        SCOPED_TRACE(test.name);
        const FailureRule rule{.spheres = test.spheres, .transient_strain = 0.001};
        const Curve curve = recorded(test.name);
        const CurveResults whole = evaluate_curve(curve, 100e3, rule);
        EXPECT_NEAR(whole.peak_deviator_stress, test.peak, 1e-3 * test.peak);
        EXPECT_NEAR(whole.axial_strain_at_peak, test.strain, 1e-4);
        double highest = 0, dip = 0;
        for (const CurvePoint& p : curve) {
            if (p.axial_strain > whole.axial_strain_at_peak) break;
            highest = std::max(highest, p.deviator_stress);
            dip = std::max(dip, 1 - p.deviator_stress / std::max(highest, 10e3));
        }
        EXPECT_GT(dip, test.dip);

        const End end = end_of(curve, rule);
        const double strain = end.failure ? end.strain : curve.back().axial_strain;
        EXPECT_GE(strain, test.earliest);
        EXPECT_LE(strain, test.latest + 1e-4);
        const auto last = std::ranges::upper_bound(curve, strain, {}, &CurvePoint::axial_strain);
        const CurveResults r = evaluate_curve({curve.begin(), last}, 100e3, rule);
        EXPECT_NEAR(r.peak_deviator_stress, whole.peak_deviator_stress,
                    0.005 * whole.peak_deviator_stress);
    }
}

}  // namespace
}  // namespace grainfield::triaxial
