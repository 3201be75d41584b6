#include "randomfield/marginals.hpp"

#include <cmath>
#include <numbers>

namespace grainfield::randomfield {

double friction_angle(const FrictionMarginal& marginal, double g) {
    const double half_range = 0.5 * (marginal.maximum - marginal.minimum);
    return marginal.minimum +
           half_range * (1.0 + std::tanh(marginal.s * g / (2.0 * std::numbers::pi)));  // Eq. (7)
}

StiffnessTransform::StiffnessTransform(const StiffnessMarginal& marginal, double gamma)
    // Eq. (9a): sigma_ln^2 = ln(1 + COV^2); Eq. (9b): mu_ln = ln mu - sigma_ln^2 / 2.
    : sigma_ln_(std::sqrt(std::log1p(marginal.cov * marginal.cov))),
      mu_ln_(std::log(marginal.mean) - 0.5 * sigma_ln_ * sigma_ln_),
      loss_(0.5 * sigma_ln_ * sigma_ln_ * (1.0 - gamma)),
      factor_(marginal.preserve_mean ? std::exp(loss_) : 1.0) {}

double StiffnessTransform::operator()(double g) const {
    return factor_ * std::exp(mu_ln_ + sigma_ln_ * g);  // Eq. (8)
}

double StiffnessTransform::mean_ratio() const {
    return factor_ * std::exp(-loss_);
}

}  // namespace grainfield::randomfield
