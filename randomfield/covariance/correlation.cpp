#include "randomfield/covariance/correlation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"

namespace grainfield::randomfield {

const char* name_of(Correlation correlation) {
    switch (correlation) {
        case Correlation::markov:
            return "markov";
        case Correlation::separable_markov:
            return "separable-markov";
        case Correlation::gaussian:
            return "gaussian";
        case Correlation::spherical:
            return "spherical";
        case Correlation::matern32:
            return "matern32";
        case Correlation::matern52:
            return "matern52";
    }
    return "?";
}

double CorrelationModel::operator()(const Vec3& tau) const {
    const Vec3 scaled = tau.cwiseQuotient(length);
    const double r = scaled.norm();
    switch (kind) {
        case Correlation::markov:
            return std::exp(-2.0 * r);  // Eq. (10) of Tran et al.
        case Correlation::separable_markov:
            return std::exp(-2.0 * scaled.lpNorm<1>());
        case Correlation::gaussian:
            return std::exp(-std::numbers::pi * r * r);
        case Correlation::spherical: {
            const double h = 0.75 * r;
            return h < 1.0 ? (1.0 - h) * (1.0 - h) * (1.0 + 0.5 * h) : 0.0;
        }
        case Correlation::matern32: {
            const double h = 4.0 * r;
            return (1.0 + h) * std::exp(-h);
        }
        case Correlation::matern52: {
            const double h = 16.0 / 3.0 * r;
            return (1.0 + h + h * h / 3.0) * std::exp(-h);
        }
    }
    return 0.0;
}

void CorrelationModel::validate() const {
    for (const double theta : {length[0], length[1], length[2]}) {
        if (theta > 0.0 && std::isfinite(theta)) continue;
        throw InputError(
            fmt::format("field.correlation_length = [{}, {}, {}]: each correlation length must be "
                        "positive and finite (m)",
                        length[0], length[1], length[2]));
    }
}

}  // namespace grainfield::randomfield
