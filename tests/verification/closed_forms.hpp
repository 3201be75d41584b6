#pragma once
// Closed forms of contacts with a shear spring and Coulomb friction, put together from their pieces
// of sticking and sliding.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfield::verify {

inline constexpr double pi = std::numbers::pi;

/// Slip velocity after an oblique impact without damping and gravity, over the normal speed [-]
/// (Di Maio & Di Renzo, Chem. Eng. Sci. 59, 2004; linear springs). `slip` before the impact is over
/// the normal speed too.
///
/// In the time tau = omega t, tau from 0 to pi, with spring and forces over v_n/omega and K_n: the
/// normal force is sin(tau), the shear force lambda xi, and slip answers a shear force by
/// ds/dtau = -3.5 lambda xi. Sticking: d(xi)/dtau = s, an oscillator of frequency
/// W = sqrt(3.5 lambda). Sliding in the direction d = +-1: lambda xi = d mu sin(tau), so that
/// s = s_1 + 3.5 d mu (cos(tau) - cos(tau_1)), until s d falls to d(xi)/dtau d = (mu/lambda)
/// cos(tau), the pace of the limit itself.
inline double slip_after_impact(double slip, double mu, double lambda) {
    const double frequency = std::sqrt(3.5 * lambda);
    double tau = 0, xi = 0, s = slip;
    bool sliding = slip > mu / lambda;
    while (tau < pi) {
        if (sliding) {
            const double d = s >= 0 && tau == 0 ? 1.0 : (xi >= 0 ? 1.0 : -1.0);
            // d s_1 - 3.5 mu cos(tau_1) + 3.5 mu c = mu c/lambda
            const double c = (d * s - 3.5 * mu * std::cos(tau)) / (mu / lambda - 3.5 * mu);
            double end = c > -1 && c < 1 ? std::acos(c) : pi;
            if (end <= tau) end = pi;
            s += 3.5 * d * mu * (std::cos(end) - std::cos(tau));
            xi = d * mu / lambda * std::sin(end);
            tau = end;
            sliding = false;
        } else {
            const double xi0 = xi, s0 = s, tau0 = tau;
            const auto spring = [&](double t) {
                return xi0 * std::cos(frequency * (t - tau0)) +
                       s0 / frequency * std::sin(frequency * (t - tau0));
            };
            const auto over = [&](double t) {
                return lambda * std::abs(spring(t)) - mu * std::sin(t);
            };
            // The first crossing of the limit, from a fine scan; just after a slide the spring is
            // at the limit but for round-off.
            double low = tau0, high = pi;
            const int parts = 20000;
            for (int k = 1; k <= parts; ++k) {
                const double t = tau0 + (pi - tau0) * k / parts;
                if (over(t) > 1e-12 || k == parts) {
                    low = tau0 + (pi - tau0) * (k - 1) / parts;
                    high = t;
                    break;
                }
            }
            for (int k = 0; k < 60; ++k) {
                const double middle = 0.5 * (low + high);
                (over(middle) > 0 ? high : low) = middle;
            }
            tau = high;
            xi = spring(tau);
            s = s0 * std::cos(frequency * (tau - tau0)) -
                frequency * xi0 * std::sin(frequency * (tau - tau0));
            sliding = true;
            if (pi - tau < 1e-9) tau = pi;
        }
    }
    return s;
}

/// Slip velocity at a time of a sphere on a plane under a constant normal force, its shear spring
/// unloaded at first. The slip obeys ds/dt = a - omega_s^2 xi, d(xi)/dt = s while the contact
/// sticks and ds/dt = a - omega_s^2 limit while it slides.
struct SlipUnderConstantLoad {
    double acceleration;  ///< a, of the slip without friction: g sin(theta) [m/s2]
    double frequency;     ///< omega_s = sqrt(3.5 K_s/m) [rad/s]
    double limit;         ///< spring length at which it slides, mu N/K_s [m]
    double start;         ///< slip at t = 0, >= 0 [m/s]

    double at(double t) const {
        const double middle = acceleration / (frequency * frequency);
        const double amplitude = std::hypot(middle, start / frequency);
        // Sticking at first: xi = middle - amplitude cos(frequency t + phase).
        const double phase = std::atan2(start / frequency, middle);
        const auto swing = [&](double time) {
            return amplitude * frequency * std::sin(frequency * time + phase);
        };
        if (middle + amplitude <= limit) return swing(t);
        const double slides = (std::acos((middle - limit) / amplitude) - phase) / frequency;
        if (t <= slides) return swing(t);
        const double a = acceleration - frequency * frequency * limit;
        const double s1 = swing(slides);
        const double sticks = a < 0 ? slides - s1 / a : HUGE_VAL;
        if (t <= sticks) return s1 + a * (t - slides);
        return -(limit - middle) * frequency * std::sin(frequency * (t - sticks));
    }
    /// When it comes to roll for good; infinite where it never does [s].
    double rolls_from() const {
        const double middle = acceleration / (frequency * frequency);
        const double amplitude = std::hypot(middle, start / frequency);
        if (middle + amplitude <= limit) return 0;
        const double phase = std::atan2(start / frequency, middle);
        const double slides = (std::acos((middle - limit) / amplitude) - phase) / frequency;
        const double a = acceleration - frequency * frequency * limit;
        if (a >= 0) return HUGE_VAL;
        return slides - amplitude * frequency * std::sin(frequency * slides + phase) / a;
    }
};

}  // namespace grainfield::verify
