#include "triaxial/config/config_keys.hpp"

namespace grainfield::triaxial {
namespace {

// Structured bindings on purpose: a member added to one of these structs without a key here does
// not compile, so nothing can be left out of files by accident.

constexpr Range percentage{0, 100, true, true, "in [0, 100]"};
constexpr Range porosity_range{0.2, 0.9, false, false, "in (0.2, 0.9)"};
constexpr Range ratio{0, 1, true, true, "in [0, 1]"};
constexpr Range strain_range{0, 0.5, false, true, "in (0, 0.5]"};
constexpr Range share{0, 1, false, false, "in (0, 1)"};

void add_keys(Keys& keys, packing::Grading& grading) {
    auto& [sieve_diameter, passing] = grading;
    keys.push_back({"grading.sieve_diameter", slot(sieve_diameter, positive), "m"});
    keys.push_back({"grading.passing", slot(passing, percentage), "% by mass"});
}

void add_keys(Keys& keys, packing::PackingOptions& packing) {
    auto& [seed, block, blocks, porosity, relative_density, compaction_friction, gravity, spheres,
           isotropic_stress, max_spheres] = packing;
    keys.push_back({"packing.seed", slot(seed, 0), "of the block's draw and placing"});
    keys.push_back({"packing.block", slot(block, positive), "m"});
    keys.push_back({"packing.blocks", slot(blocks, 1), "in x, y, z"});
    keys.push_back({"packing.porosity", slot(porosity, porosity_range), "of the block"});
    keys.push_back({"packing.relative_density", slot(relative_density, ratio),
                    "optional, in place of the porosity: (e_max - e)/(e_max - e_min)"});
    keys.push_back({"packing.compaction_friction", slot(compaction_friction, below_right_angle),
                    "rad, optional, in place of both: while the block is shaken"});
    keys.push_back({"packing.gravity", slot(gravity, positive), "m/s2, along -y"});
    keys.push_back({"packing.spheres", slot(spheres, 1), "optional: fixes the count of one block"});
    keys.push_back({"packing.isotropic_stress", slot(isotropic_stress, positive),
                    "Pa, optional: the sample is brought to it after settling"});
    keys.push_back({"packing.max_spheres", slot(max_spheres, 1),
                    "gradings of which more are expected in a block are refused"});
}

void add_keys(Keys& keys, WallOptions& wall) {
    auto& [friction_angle, poisson_ratio] = wall;
    keys.push_back({"wall.friction_angle", slot(friction_angle, below_right_angle), "rad"});
    keys.push_back({"wall.poisson_ratio", slot(poisson_ratio, ratio), "ks/kn of the box"});
}

void add_keys(Keys& keys, TriaxialOptions& triaxial) {
    auto& [confining_stress, strain_rate, max_axial_strain, gravity] = triaxial;
    keys.push_back({"triaxial.confining_stress", slot(confining_stress, positive), "Pa"});
    keys.push_back({"triaxial.strain_rate", slot(strain_rate, positive), "1/s"});
    keys.push_back({"triaxial.max_axial_strain", slot_or_auto(max_axial_strain, strain_range),
                    "or \"auto\": stop once the peak is surely past"});
    keys.push_back({"triaxial.gravity", slot(gravity, non_negative), "m/s2, along -y"});
}

void add_keys(Keys& keys, MonteCarloOptions& montecarlo) {
    auto& [realizations, deterministic, mean_error, sd_error] = montecarlo;
    keys.push_back({"montecarlo.realizations", slot(realizations, 1), "of each case"});
    keys.push_back({"montecarlo.deterministic", slot(deterministic),
                    "the deterministic run of each case beside it"});
    keys.push_back({"montecarlo.target_mean_error", slot(mean_error, positive),
                    "stop a case once the 95 % intervals of its means are within this share"});
    keys.push_back({"montecarlo.target_sd_error", slot(sd_error, positive),
                    "and those of its standard deviations within this"});
}

}  // namespace

void add_keys(Keys& keys, ParticleOptions& particle) {
    auto& [density, normal_stiffness, stiffness_ratio, friction_angle] = particle;
    keys.push_back({"particle.density", slot(density, positive), "kg/m3"});
    keys.push_back({"particle.normal_stiffness", slot(normal_stiffness, positive), "Pa"});
    keys.push_back({"particle.stiffness_ratio", slot(stiffness_ratio, non_negative), "ks/kn"});
    keys.push_back({"particle.friction_angle", slot(friction_angle, below_right_angle), "rad"});
}

void add_keys(Keys& keys, core::Damping& damping) {
    auto& [force, moment] = damping;
    keys.push_back({"damping.force", slot(force, below_one), "share of the force"});
    keys.push_back({"damping.moment", slot(moment, below_one), "share of the moment"});
}

void add_keys(Keys& keys, core::TimeOptions& time) {
    auto& [step, safety, mass_scaling] = time;
    keys.push_back({"time.step", slot_or_auto(step, positive), "s, or \"auto\""});
    keys.push_back({"time.safety", slot(safety, share), "of the stability limit 2/omega_max"});
    keys.push_back({"time.mass_scaling", slot(mass_scaling, at_least_one),
                    "1: real masses; X: light spheres as heavy as a step X times larger needs"});
}

void add_keys(Keys& keys, core::SolverOptions& solver) {
    auto& [precision, isa] = solver;
    keys.push_back({"solver.precision", slot(precision, precision_names), "\"double\", \"mixed\""});
    keys.push_back(
        {"solver.isa", slot(isa, isa_names), "\"auto\", \"scalar\", \"avx2\", \"avx512\""});
}

Keys config_keys(Config& config) {
    auto& [grading, packing, particle, damping, wall, field, triaxial, time, solver, montecarlo] =
        config;
    Keys keys;
    add_keys(keys, grading);
    add_keys(keys, packing);
    add_keys(keys, particle);
    add_keys(keys, damping);
    add_keys(keys, wall);
    add_keys(keys, field);
    add_keys(keys, triaxial);
    add_keys(keys, time);
    add_keys(keys, solver);
    add_keys(keys, montecarlo);
    return keys;
}

}  // namespace grainfield::triaxial
