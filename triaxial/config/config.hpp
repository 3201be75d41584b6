#pragma once
// The whole configuration as one aggregate, with Tran et al.'s values as defaults
// (docs/interface.md, "Config keys"). One struct a TOML table.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/solver_options.hpp"
#include "packing/packing_options.hpp"
#include "randomfield/field_options.hpp"

namespace grainfield::triaxial {

struct ParticleOptions {
    double density = 2600;          ///< [kg/m3]
    double normal_stiffness = 9e8;  ///< k_n [Pa]
    double stiffness_ratio = 0.1;   ///< k_s/k_n [-]
    double friction_angle = 0.6;    ///< phi [rad]
};

struct WallOptions {
    double friction_angle = 0;   ///< [rad]
    double poisson_ratio = 0.2;  ///< as in YADE's FrictMat: k_s/k_n of the box [-]
};

struct TriaxialOptions {
    double confining_stress = 100e3;         ///< sigma_3 [Pa]
    double strain_rate = 0.1;                ///< of the current height [1/s]
    std::optional<double> max_axial_strain;  ///< unset: "auto", once the peak is surely past [-]
    double gravity = 0;                      ///< along -y [m/s2]
};

/// The campaign around the runs; its sweep and cases are in load_campaign().
struct MonteCarloOptions {
    std::int32_t realizations = 250;  ///< of each case [-]
    bool deterministic = true;        ///< the deterministic run of each case beside it [-]
    /// A case stops sooner once the 95 % intervals of peak and E50 are within this share of their
    /// means [-], and those of the standard deviations within this share of these [-].
    std::optional<double> target_mean_error = std::nullopt;
    std::optional<double> target_sd_error = std::nullopt;
};

struct Config {
    packing::Grading grading;
    packing::PackingOptions packing;
    ParticleOptions particle;
    core::Damping damping{0.2, 0.2};
    WallOptions wall;
    randomfield::FieldOptions field;
    TriaxialOptions triaxial;
    core::TimeOptions time;
    core::SolverOptions solver;
    MonteCarloOptions montecarlo;

    /// Checks every value, and values against each other. Throws InputError naming key, value and
    /// what is allowed.
    void validate() const;
};

}  // namespace grainfield::triaxial
