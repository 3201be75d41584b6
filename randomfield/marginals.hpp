#pragma once
// From the Gaussian field to the soil: the marginal distributions of Eqs. (7)-(9).

#include "randomfield/field_options.hpp"

namespace grainfield::randomfield {

/// Eq. (7): phi = phi_min + (phi_max - phi_min)/2 [1 + tanh(s G / 2 pi)] [rad].
double friction_angle(const FrictionMarginal& marginal, double g);

/// Eqs. (8)-(9): k_n = exp(mu_ln + sigma_ln G), of a point or of a cell's average G.
class StiffnessTransform {
  public:
    /// gamma: variance of the G that will be put in, gamma(D) for cells of size D (1 for points);
    /// it matters for preserve_mean and the mean only [-].
    StiffnessTransform(const StiffnessMarginal& marginal, double gamma);

    /// k_n of a cell [Pa].
    [[nodiscard]] double operator()(double g) const;

    [[nodiscard]] double mu_ln() const { return mu_ln_; }        ///< Eq. (9b) [ln Pa]
    [[nodiscard]] double sigma_ln() const { return sigma_ln_; }  ///< Eq. (9a) [-]
    /// E[k_n of a cell] / mu. The paper puts averages (variance gamma < 1) into Eq. (8), so the
    /// mean falls to exp(-sigma_ln^2 (1 - gamma)/2), unless preserve_mean scales it back to 1 [-].
    [[nodiscard]] double mean_ratio() const;

  private:
    double sigma_ln_;
    double mu_ln_;
    double loss_;    ///< sigma_ln^2 (1 - gamma)/2 [-]
    double factor_;  ///< exp(loss) under preserve_mean, else 1 [-]
};

}  // namespace grainfield::randomfield
