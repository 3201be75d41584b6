#pragma once
// What a random field is asked to be.

#include <array>
#include <cstdint>
#include <optional>

#include "kernels/vec3.hpp"
#include "randomfield/correlation.hpp"

namespace grainfield::randomfield {

enum class Variable { none, friction, stiffness, both };
enum class Method {
    las,          ///< local average subdivision with correlated detail
    las_classic,  ///< local average subdivision as published
    cholesky,     ///< exact, dense factor
    circulant     ///< exact, FFT on a periodic grid around
};

/// Bounded marginal of the friction angle, Eq. (7).
struct FrictionMarginal {
    double minimum = 0.3;  ///< phi_min [rad]
    double maximum = 0.9;  ///< phi_max [rad]
    double s = 2.0;        ///< variability factor [-]
};

/// Lognormal marginal of the normal stiffness, Eqs. (8)-(9).
struct StiffnessMarginal {
    double mean = 9e8;           ///< mu [Pa]
    double cov = 0.8;            ///< coefficient of variation [-]
    bool preserve_mean = false;  ///< rescale so that the mean over cells is mu, not less [-]
};

struct FieldOptions {
    Variable variable = Variable::none;
    Method method = Method::las;
    Correlation correlation = Correlation::markov;
    std::uint64_t seed = 1;                    ///< [-]
    Vec3 correlation_length{10.0, 1.0, 10.0};  ///< theta_x, theta_y, theta_z [m]
    std::optional<std::int64_t> stage0_cells;  ///< largest stage 0 of LAS [-]
    FrictionMarginal friction;
    StiffnessMarginal stiffness;

    void validate() const;  ///< throws InputError naming key, value and what is allowed
};

}  // namespace grainfield::randomfield
