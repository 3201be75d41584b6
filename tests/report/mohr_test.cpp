// Envelopes of circles whose answer is exact.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "triaxial/report/mohr.hpp"

namespace grainfield::triaxial::report {
namespace {

/// The circle at sigma_3 that touches tau = c + sigma tan(phi).
MohrCircle touching(double sigma3, double c, double phi) {
    const double q = 2 * (sigma3 * std::sin(phi) + c * std::cos(phi)) / (1 - std::sin(phi));
    return {sigma3, q, "made up"};
}

TEST(Mohr, OneCircleGivesTheLineThroughTheOrigin) {
    for (const double phi : {0.1, 0.5, 1.2}) {
        const Envelope envelope = envelope_through_origin(touching(100e3, 0, phi));
        EXPECT_NEAR(envelope.friction_angle, phi, 1e-14);
        EXPECT_EQ(envelope.intercept, 0);
    }
}

TEST(Mohr, ExactCirclesWithoutCohesionHaveNoIntercept) {
    std::vector<MohrCircle> circles;
    for (const double sigma3 : {50e3, 100e3, 200e3, 800e3})
        circles.push_back(touching(sigma3, 0, 0.52));
    const Envelope envelope = fit_envelope(circles);
    EXPECT_NEAR(envelope.friction_angle, 0.52, 1e-13);
    EXPECT_NEAR(envelope.intercept, 0, 1e-12 * 800e3);  // round-off of stresses of 800 kPa
    EXPECT_NEAR(envelope.rms_residual, 0, 1e-12 * 800e3);
}

TEST(Mohr, FindsCohesionAndTheResidual) {
    std::array circles{touching(100e3, 12e3, 0.4), touching(200e3, 12e3, 0.4),
                       touching(300e3, 12e3, 0.4)};
    Envelope envelope = fit_envelope(circles);
    EXPECT_NEAR(envelope.friction_angle, 0.4, 1e-13);
    EXPECT_NEAR(envelope.intercept, 12e3, 1e-12 * 300e3);
    circles[1].deviator_stress *= 1.05;
    envelope = fit_envelope(circles);
    EXPECT_GT(envelope.rms_residual, 100);
    EXPECT_LT(envelope.rms_residual, 0.05 * circles[1].radius());
}

TEST(Mohr, RefusesWhatHasNoLine) {
    const MohrCircle one = touching(100e3, 0, 0.5);
    EXPECT_THROW(fit_envelope(std::array{one, one}), InputError);
    EXPECT_THROW(fit_envelope(std::array{one}), InputError);
    // t grows faster than s: no Mohr-Coulomb material.
    EXPECT_THROW(fit_envelope(std::array{MohrCircle{200e3, 1e3, ""}, MohrCircle{100e3, 400e3, ""}}),
                 InputError);
}

}  // namespace
}  // namespace grainfield::triaxial::report
