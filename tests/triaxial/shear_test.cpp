// The whole test on a small sample: servo quality, the curve, its dependence on stress and step.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "core/drive/box.hpp"
#include "packing/isotropic.hpp"
#include "tests/triaxial/small_test.hpp"
#include "triaxial/realization/shear.hpp"

namespace grainfield::triaxial {
namespace {

using testing::dense_sample;
using testing::FinishedTest;
using testing::small_config;

constexpr int spheres = 900;

void expect_held(const TestResult& r) {
    EXPECT_LT(r.isotropic_unbalanced, 1e-3);
    EXPECT_LT(r.isotropic_stress_error, 2e-3);
    EXPECT_LT(r.lateral_rms_error, 0.005);
    EXPECT_LE(r.lateral_max_error, 0.01);
    EXPECT_GE(r.lowest_start_ratio, -0.01);
}

/// Everything a recorded curve must obey, whatever the sample.
void expect_consistent(const FinishedTest& run, const Config& config) {
    const TestResult& r = run.result;
    ASSERT_GT(r.curve.size(), 50U);
    const double sigma3 = config.triaxial.confining_stress, rate = config.triaxial.strain_rate;
    double worst_after = 0;
    for (std::size_t k = 0; k < r.curve.size(); ++k) {
        const CurvePoint& p = r.curve[k];
        if (k > 0) {
            EXPECT_GT(p.axial_strain, r.curve[k - 1].axial_strain);
            EXPECT_GT(p.time, r.curve[k - 1].time);
        }
        EXPECT_NEAR(p.deviator_stress,
                    p.axial_stress - 0.5 * (p.lateral_stress_x + p.lateral_stress_z),
                    1e-9 * sigma3);
        // dh/dt = -rate h, a step late at most. (Point k is recorded before its step is taken.)
        EXPECT_NEAR(p.axial_strain, 1 - std::exp(-rate * p.time), 2 * rate * r.mean_step);
        EXPECT_GT(p.contacts, 0);
        if (p.axial_strain > 1e-3)
            worst_after = std::max({worst_after, std::abs(p.lateral_stress_x / sigma3 - 1),
                                    std::abs(p.lateral_stress_z / sigma3 - 1)});
    }
    EXPECT_NEAR(worst_after, r.lateral_max_error, 1e-12);
    EXPECT_GT(r.results.peak_deviator_stress, 0);
    EXPECT_GT(r.results.E50, 0);
    EXPECT_NEAR(static_cast<double>(r.shear_steps) * r.mean_step, r.curve.back().time,
                2 * r.mean_step);
}

TEST(Shear, HoldsTheConfiningStressAndStiffensWithIt) {
    const Sample sample = dense_sample(spheres);
    Config config = small_config(sample);
    config.triaxial.max_axial_strain = 0.015;  // before a sample so small softens
    double peak[2], modulus[2], ratio[2];
    for (int k = 0; k < 2; ++k) {
        config.triaxial.confining_stress = 100e3 * (k + 1);
        SCOPED_TRACE(config.triaxial.confining_stress);
        const FinishedTest run = testing::run(sample, config);
        expect_held(run.result);
        expect_consistent(run, config);
        EXPECT_EQ(run.result.end_reason, ended_as_asked);
        EXPECT_EQ(run.result.inertia_ratio, 1);
        // Only the walls' box is known at the end: the last point is at most one step older.
        const double shrunk = 1 - run.simulation.spheres().solid_volume() /
                                      core::box_dimensions(run.simulation).prod();
        const double at_point =
            1 - (1 - run.result.sheared_porosity) / (1 - run.result.curve.back().volumetric_strain);
        EXPECT_NEAR(shrunk, at_point, 1e-5);
        peak[k] = run.result.results.peak_deviator_stress;
        modulus[k] = run.result.results.E50;
        ratio[k] = peak[k] / config.triaxial.confining_stress;
        RecordProperty(k ? "200kPa" : "100kPa",
                       "peak " + std::to_string(peak[k]) + " E50 " + std::to_string(modulus[k]) +
                           " rms " + std::to_string(run.result.lateral_rms_error) + " max " +
                           std::to_string(run.result.lateral_max_error) + " start " +
                           std::to_string(run.result.lowest_start_ratio) + " I " +
                           std::to_string(run.result.inertial_number) + " end " +
                           run.result.end_reason);
    }
    EXPECT_GT(modulus[1], modulus[0]);
    // Without cohesion the strength is proportional to the stress; the rate's share falls.
    EXPECT_NEAR(ratio[1] / ratio[0], 1, 0.15);
}

TEST(Shear, OwnWeightIsNoStrength) {
    // Ten times the earth's, so that the weight is not lost in the stress: the mean of top and
    // bottom is half of it above the confining stress, and nothing is sheared yet.
    const Sample sample = dense_sample(200);
    Config config = small_config(sample);
    config.triaxial.gravity = 98.1;
    config.triaxial.max_axial_strain = 0;
    core::Simulation simulation(make_scene(sample, config), kernels::reference_kernels());
    core::Monitor monitor;
    core::Driver driver(simulation, config.time, monitor);
    packing::compress_isotropically(driver, config.triaxial.confining_stress);
    double mass = 0;
    for (const double m : simulation.spheres().mass) mass += m;
    const double weight = 98.1 * mass / core::wall_area(core::box_dimensions(simulation), 1);
    ASSERT_GT(weight, 0.3 * config.triaxial.confining_stress);
    ShearStage shear(driver, config.triaxial, config.particle.density, {});
    shear.run();
    ASSERT_EQ(shear.curve().size(), 1U);
    // The stresses are good to 0.3 % (Isotropic tests).
    EXPECT_NEAR(shear.curve()[0].axial_stress, config.triaxial.confining_stress,
                0.003 * (config.triaxial.confining_stress + weight));
}

TEST(Shear, EndsByItselfOnceTheSampleHasFailed) {
    const Sample sample = dense_sample(spheres);
    const FinishedTest run = testing::run(sample, small_config(sample));
    const TestResult& r = run.result;
    EXPECT_EQ(r.end_reason, "peak");
    EXPECT_EQ(r.results.failure, Failure::peak);
    EXPECT_LT(r.lateral_rms_error, 0.005);
    // A peak at some 2.4 %, and softening over half of that; small samples fluctuate meanwhile.
    EXPECT_GT(r.curve.back().axial_strain, 1.5 * r.results.axial_strain_at_peak);
    EXPECT_LT(r.curve.back().axial_strain, 0.1);
    EXPECT_EQ(reached_failure(r.curve, {.spheres = sample.spheres.size(),
                                        .transient_strain = r.inertial_number}),
              Failure::peak);
}

TEST(Shear, HoldsTheConfiningStressAtAnyStiffnessContrast) {
    Sample sample = dense_sample(spheres);
    Config config = small_config(sample);
    config.field.variable = randomfield::Variable::stiffness;
    config.field.correlation_length = Vec3(0.1, 0.01, 0.1);
    config.field.stiffness.cov = 2;
    config.triaxial.max_axial_strain = 0.01;
    map_field(config, 3, sample);
    // 1: Tran et al.'s field (local averages of blocks far wider than theta differ little);
    // 2: independent lognormal blocks of the same COV; 3: every block a hundredth of the next.
    const double spread = std::sqrt(std::log(1 + 2.0 * 2.0));
    const core::RandomStream random(1, core::Stream::perturbation);
    for (const int kind : {1, 2, 3}) {
        SCOPED_TRACE(kind);
        for (std::size_t i = 0; i < sample.spheres.size() && kind > 1; ++i) {
            const core::BlockIndex& b = sample.spheres.block[i];
            const auto cell = static_cast<std::uint64_t>(b[0] + 2 * (b[1] + 4 * b[2]));
            const double lognormal =
                9e8 * std::exp(spread * random.normal(0, cell) - 0.5 * spread * spread);
            sample.spheres.normal_stiffness[i] =
                kind == 2 ? lognormal : ((b[0] + b[1] + b[2]) % 2 == 0 ? 9e9 : 9e7);
        }
        for (const double stress : {100e3, 200e3}) {
            SCOPED_TRACE(stress);
            config.triaxial.confining_stress = stress;
            const FinishedTest run = testing::run(sample, config);
            RecordProperty(std::to_string(kind) + "_" + std::to_string(int(stress)),
                           std::to_string(run.result.lateral_rms_error) + " max " +
                               std::to_string(run.result.lateral_max_error) + " start " +
                               std::to_string(run.result.lowest_start_ratio));
            expect_held(run.result);
            expect_consistent(run, config);
            EXPECT_GE(run.result.curve.back().axial_strain, 0.01);
            EXPECT_LT(run.result.curve.back().axial_strain, 0.0101);
        }
    }
}

TEST(Shear, MassScalingHalvesTheStepsForTheSamePeak) {
    const Sample sample = dense_sample(spheres);
    Config config = small_config(sample);
    config.triaxial.max_axial_strain = 0.02;
    const FinishedTest real = testing::run(sample, config);
    config.time.mass_scaling = 2;
    const FinishedTest scaled = testing::run(sample, config);
    EXPECT_GT(scaled.result.inertia_ratio, 1);
    EXPECT_NEAR(static_cast<double>(scaled.result.shear_steps) /
                    static_cast<double>(real.result.shear_steps),
                0.5, 0.1);
    const double peak = real.result.results.peak_deviator_stress;
    EXPECT_NEAR(scaled.result.results.peak_deviator_stress, peak, 0.1 * peak);
    RecordProperty("rms_real", std::to_string(real.result.lateral_rms_error));
    RecordProperty("rms_scaled", std::to_string(scaled.result.lateral_rms_error));
    RecordProperty("peaks", std::to_string(peak) + " " +
                                std::to_string(scaled.result.results.peak_deviator_stress));
}

}  // namespace
}  // namespace grainfield::triaxial
