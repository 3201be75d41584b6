#pragma once
// What a random field is asked to be.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/vec3.hpp"
#include "randomfield/covariance/correlation.hpp"
#include "randomfield/grid.hpp"
#include "randomfield/marginals/marginal_options.hpp"

namespace grainfield::randomfield {

enum class Variable { none, friction, stiffness, both };
enum class Method {
    las,          ///< local average subdivision with correlated detail
    las_classic,  ///< local average subdivision as published
    cholesky,     ///< exact, dense factor
    circulant     ///< exact, FFT on a periodic grid around
};

struct FieldOptions {
    Variable variable = Variable::none;
    Method method = Method::las;
    Correlation correlation = Correlation::markov;
    std::uint64_t seed = 1;                    ///< [-]
    Vec3 correlation_length{10.0, 1.0, 10.0};  ///< theta_x, theta_y, theta_z [m]
    std::optional<std::int64_t> stage0_cells;  ///< largest stage 0 of LAS [-]
    /// Between the Gaussian fields of friction angle and stiffness, where both are random [-].
    double cross_correlation = 0.0;
    /// CSV of measured values to condition on (field_data.hpp); empty: none.
    std::string data;
    /// Measured values further than this from their distribution are taken for mistakes, in
    /// standard deviations of a cell's G [-].
    double data_deviations = 6.0;
    /// Friction angle, Eq. (7) of Tran et al. unless another marginal is asked for.
    MarginalOptions friction{MarginalKind::bounded, 0.3, 0.9, 2.0, 0.6, 0.15};
    /// Normal stiffness, Eqs. (8)-(9) of Tran et al. unless another marginal is asked for.
    MarginalOptions stiffness{MarginalKind::lognormal, {}, {}, 2.0, 9e8, 0.8};

    /// Whether a property is random.
    [[nodiscard]] bool random(Property property) const {
        return variable == Variable::both ||
               variable == (property == Property::friction_angle ? Variable::friction
                                                                 : Variable::stiffness);
    }

    /// Both throw InputError naming key, value and what is allowed; the second also where a trend
    /// leads out of what is allowed on the rows of a grid.
    void validate() const;
    void validate(const GridSpec& grid) const;
};

/// A line for each key that is set, but that the marginal in force has no use for:
/// "field.friction.s = 3 has no effect with ...".
std::vector<std::string> unused_keys(const FieldOptions& options);

}  // namespace grainfield::randomfield
