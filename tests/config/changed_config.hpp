#pragma once
// A config in which every key differs from its default, as text and as a struct; but for
// packing.relative_density, which does not stand beside packing.compaction_friction.

#include <string_view>

#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

inline constexpr std::string_view changed_text = R"(
[grading]
sieve_diameter = [0.011, 0.05, 0.2]
passing = [0, 40.5, 100]
[packing]
seed = 7
block = [0.3, 0.2, 0.1]
blocks = [2, 3, 4]
porosity = 0.41
compaction_friction = 0.2
gravity = 1.62
spheres = 351
isotropic_stress = 5e3
max_spheres = 5000
[particle]
density = 2700
normal_stiffness = 1e8
stiffness_ratio = 0.2
friction_angle = 0.5
[damping]
force = 0.1
moment = 0.05
[wall]
friction_angle = 0.01
poisson_ratio = 0.3
[field]
variable = "both"
method = "cholesky"
seed = 8
correlation = "matern32"
correlation_length = [5, 0.5, 6.0]
stage0_cells = 512
cross_correlation = 0.5
data = "/data/cpt.csv"
data_deviations = 40
stiffness.minimum = 1e8
stiffness.maximum = 9e9
stiffness.s = 3
stiffness.marginal = "beta"
stiffness.mean = 8e8
stiffness.cov = 1.6
stiffness.mean_gradient = -1e7
stiffness.preserve_mean = true
[field.friction]
marginal = "truncated-normal"
minimum = 0.2
maximum = 0.8
s = 3
mean = 0.5
cov = 0.2
mean_gradient = 0.01
preserve_mean = true
[triaxial]
confining_stress = 200e3
strain_rate = 0.02
max_axial_strain = 0.05
gravity = 9.81
[time]
step = 1e-6
safety = 0.7
mass_scaling = 2
[solver]
precision = "double"
isa = "avx2"
[montecarlo]
realizations = 3
deterministic = false
target_mean_error = 0.02
target_sd_error = 0.2
)";

inline Config changed_config() {
    Config c;
    c.grading = {{0.011, 0.05, 0.2}, {0, 40.5, 100}};
    c.packing = {7, {0.3, 0.2, 0.1}, {2, 3, 4}, 0.41, {}, 0.2, 1.62, 351, 5e3, 5000};
    c.particle = {2700, 1e8, 0.2, 0.5};
    c.damping = {0.1, 0.05};
    c.wall = {0.01, 0.3};
    c.field.variable = randomfield::Variable::both;
    c.field.method = randomfield::Method::cholesky;
    c.field.correlation = randomfield::Correlation::matern32;
    c.field.seed = 8;
    c.field.correlation_length = {5, 0.5, 6};
    c.field.stage0_cells = 512;
    c.field.cross_correlation = 0.5;
    c.field.data = "/data/cpt.csv";
    c.field.data_deviations = 40;
    using randomfield::MarginalKind;
    c.field.friction = {MarginalKind::truncated_normal, 0.2, 0.8, 3, 0.5, 0.2, 0.01, true};
    c.field.stiffness = {MarginalKind::beta, 1e8, 9e9, 3, 8e8, 1.6, -1e7, true};
    c.triaxial = {200e3, 0.02, 0.05, 9.81};
    c.time = {1e-6, 0.7, 2};
    c.solver = {core::Precision::double_, kernels::InstructionSet::avx2};
    c.montecarlo = {3, false, 0.02, 0.2};
    return c;
}

}  // namespace grainfield::triaxial
