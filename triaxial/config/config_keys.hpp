#pragma once
// Every key of a config (docs/interface.md, "Config keys"): path, range, unit, variable.

#include <array>
#include <string_view>
#include <vector>

#include "core/solver_options.hpp"
#include "triaxial/config/config.hpp"
#include "triaxial/config/key_slot.hpp"

namespace grainfield::triaxial {

using Keys = std::vector<ConfigKey>;

inline constexpr std::array precision_names{
    Named<core::Precision>{core::Precision::double_, "double"},
    Named<core::Precision>{core::Precision::mixed, "mixed"}};
inline constexpr std::array isa_names{
    Named<core::Isa>{core::Isa::automatic, "auto"}, Named<core::Isa>{core::Isa::scalar, "scalar"},
    Named<core::Isa>{core::Isa::avx2, "avx2"}, Named<core::Isa>{core::Isa::avx512, "avx512"}};
inline constexpr std::array variable_names{
    Named<randomfield::Variable>{randomfield::Variable::none, "none"},
    Named<randomfield::Variable>{randomfield::Variable::friction, "friction"},
    Named<randomfield::Variable>{randomfield::Variable::stiffness, "stiffness"},
    Named<randomfield::Variable>{randomfield::Variable::both, "both"}};
inline constexpr std::array method_names{
    Named<randomfield::Method>{randomfield::Method::las, "las"},
    Named<randomfield::Method>{randomfield::Method::las_classic, "las-classic"},
    Named<randomfield::Method>{randomfield::Method::cholesky, "cholesky"},
    Named<randomfield::Method>{randomfield::Method::circulant, "circulant"}};
inline constexpr std::array correlation_names{
    Named<randomfield::Correlation>{randomfield::Correlation::markov, "markov"},
    Named<randomfield::Correlation>{randomfield::Correlation::separable_markov, "separable-markov"},
    Named<randomfield::Correlation>{randomfield::Correlation::gaussian, "gaussian"},
    Named<randomfield::Correlation>{randomfield::Correlation::spherical, "spherical"},
    Named<randomfield::Correlation>{randomfield::Correlation::matern32, "matern32"},
    Named<randomfield::Correlation>{randomfield::Correlation::matern52, "matern52"}};
inline constexpr std::array marginal_names{
    Named<randomfield::MarginalKind>{randomfield::MarginalKind::bounded, "bounded"},
    Named<randomfield::MarginalKind>{randomfield::MarginalKind::lognormal, "lognormal"},
    Named<randomfield::MarginalKind>{randomfield::MarginalKind::normal, "normal"},
    Named<randomfield::MarginalKind>{randomfield::MarginalKind::truncated_normal,
                                     "truncated-normal"},
    Named<randomfield::MarginalKind>{randomfield::MarginalKind::beta, "beta"},
    Named<randomfield::MarginalKind>{randomfield::MarginalKind::weibull, "weibull"}};

/// All keys in the order of docs/interface.md. They refer to `config`, which must outlive them.
Keys config_keys(Config& config);

/// The tables that a scene shares with a config, each with its table's name in the paths.
void add_keys(Keys& keys, ParticleOptions& particle);
void add_keys(Keys& keys, core::Damping& damping);
void add_keys(Keys& keys, core::TimeOptions& time);
void add_keys(Keys& keys, core::SolverOptions& solver);
/// The tables [field], [field.friction] and [field.stiffness].
void add_keys(Keys& keys, randomfield::FieldOptions& field);

}  // namespace grainfield::triaxial
