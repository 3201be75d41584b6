#pragma once
// The correlation functions a field may have, and what theta means in each.

#include "kernels/vec3.hpp"

namespace grainfield::randomfield {

/// Correlation at a lag tau, with r^2 = sum over d of (tau_d / theta_d)^2. theta_d is the scale of
/// fluctuation along its axis, the integral of rho(tau) over all tau in that direction alone, as
/// Fenton & Vanmarcke have it; so every model with the same theta has the same area under its
/// curve.
enum class Correlation {
    markov,            ///< exp(-2 r), Eq. (10) of Tran et al.: ellipsoidal
    separable_markov,  ///< product over d of exp(-2 |tau_d| / theta_d)
    gaussian,          ///< exp(-pi r^2)
    spherical,         ///< 1 - 3/2 h + 1/2 h^3 with h = 3/4 r; none beyond a range of 4/3 theta
    matern32,          ///< (1 + h) exp(-h) with h = 4 r
    matern52           ///< (1 + h + h^2/3) exp(-h) with h = 16/3 r
};

/// The name of a correlation in configs and messages: "markov", "separable-markov", ...
const char* name_of(Correlation correlation);

/// What two points of the field have to do with each other.
struct CorrelationModel {
    /// Implicit on purpose: correlation lengths alone are those of Tran et al.'s model.
    CorrelationModel(const Vec3& theta, Correlation model = Correlation::markov)  // NOLINT
        : length(theta), kind(model) {}

    Vec3 length;       ///< theta_x, theta_y, theta_z [m]
    Correlation kind;  ///< [-]

    /// The correlation of two points tau = (x, y, z) apart, tau in metres [-].
    [[nodiscard]] double operator()(const Vec3& tau) const;
    /// InputError where a length is not positive and finite.
    void validate() const;
};

}  // namespace grainfield::randomfield
