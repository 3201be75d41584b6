#pragma once
// Field by field, written out by hand: independent of the key list under test.

#include <gtest/gtest.h>

#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

inline void expect_equal(const randomfield::MarginalOptions& a,
                         const randomfield::MarginalOptions& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.minimum, b.minimum);
    EXPECT_EQ(a.maximum, b.maximum);
    EXPECT_EQ(a.s, b.s);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.cov, b.cov);
    EXPECT_EQ(a.mean_gradient, b.mean_gradient);
    EXPECT_EQ(a.preserve_mean, b.preserve_mean);
}

inline void expect_equal(const Config& a, const Config& b) {
    EXPECT_EQ(a.grading.sieve_diameter, b.grading.sieve_diameter);
    EXPECT_EQ(a.grading.passing, b.grading.passing);
    EXPECT_EQ(a.packing.seed, b.packing.seed);
    EXPECT_EQ(a.packing.block, b.packing.block);
    EXPECT_EQ(a.packing.blocks, b.packing.blocks);
    EXPECT_EQ(a.packing.porosity, b.packing.porosity);
    EXPECT_EQ(a.packing.relative_density, b.packing.relative_density);
    EXPECT_EQ(a.packing.compaction_friction, b.packing.compaction_friction);
    EXPECT_EQ(a.packing.gravity, b.packing.gravity);
    EXPECT_EQ(a.packing.spheres, b.packing.spheres);
    EXPECT_EQ(a.packing.isotropic_stress, b.packing.isotropic_stress);
    EXPECT_EQ(a.packing.max_spheres, b.packing.max_spheres);
    EXPECT_EQ(a.particle.density, b.particle.density);
    EXPECT_EQ(a.particle.normal_stiffness, b.particle.normal_stiffness);
    EXPECT_EQ(a.particle.stiffness_ratio, b.particle.stiffness_ratio);
    EXPECT_EQ(a.particle.friction_angle, b.particle.friction_angle);
    EXPECT_EQ(a.damping.force, b.damping.force);
    EXPECT_EQ(a.damping.moment, b.damping.moment);
    EXPECT_EQ(a.wall.friction_angle, b.wall.friction_angle);
    EXPECT_EQ(a.wall.poisson_ratio, b.wall.poisson_ratio);
    EXPECT_EQ(a.field.variable, b.field.variable);
    EXPECT_EQ(a.field.method, b.field.method);
    EXPECT_EQ(a.field.correlation, b.field.correlation);
    EXPECT_EQ(a.field.seed, b.field.seed);
    EXPECT_EQ(a.field.correlation_length, b.field.correlation_length);
    EXPECT_EQ(a.field.stage0_cells, b.field.stage0_cells);
    EXPECT_EQ(a.field.cross_correlation, b.field.cross_correlation);
    EXPECT_EQ(a.field.data, b.field.data);
    EXPECT_EQ(a.field.data_deviations, b.field.data_deviations);
    expect_equal(a.field.friction, b.field.friction);
    expect_equal(a.field.stiffness, b.field.stiffness);
    EXPECT_EQ(a.triaxial.confining_stress, b.triaxial.confining_stress);
    EXPECT_EQ(a.triaxial.strain_rate, b.triaxial.strain_rate);
    EXPECT_EQ(a.triaxial.max_axial_strain, b.triaxial.max_axial_strain);
    EXPECT_EQ(a.triaxial.gravity, b.triaxial.gravity);
    EXPECT_EQ(a.time.step, b.time.step);
    EXPECT_EQ(a.time.safety, b.time.safety);
    EXPECT_EQ(a.time.mass_scaling, b.time.mass_scaling);
    EXPECT_EQ(a.solver.precision, b.solver.precision);
    EXPECT_EQ(a.solver.isa, b.solver.isa);
    EXPECT_EQ(a.montecarlo.realizations, b.montecarlo.realizations);
    EXPECT_EQ(a.montecarlo.deterministic, b.montecarlo.deterministic);
    EXPECT_EQ(a.montecarlo.target_mean_error, b.montecarlo.target_mean_error);
    EXPECT_EQ(a.montecarlo.target_sd_error, b.montecarlo.target_sd_error);
}

}  // namespace grainfield::triaxial
