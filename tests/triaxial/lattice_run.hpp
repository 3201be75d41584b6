#pragma once
// Lattices in the stages of the triaxial test, with each kernel table that a test asks for.

#include <algorithm>
#include <string>
#include <vector>

#include "packing/isotropic.hpp"
#include "tests/kernels/kernel_tables.hpp"
#include "tests/triaxial/lattice_samples.hpp"
#include "triaxial/realization/shear.hpp"

namespace grainfield::triaxial::testing {

/// The reference, and the widest vectors of this machine in double and in mixed precision.
inline std::vector<kernels::KernelCase> best_kernels() {
    std::vector<kernels::KernelCase> best(3);
    for (const kernels::KernelCase& c : kernels::kernel_cases()) {
        if (c.table == nullptr) continue;
        best[c.name == "reference" ? 0 : c.name.ends_with("_mixed") ? 2 : 1] = c;  // ascending
    }
    return best;
}

/// A config for lattices: quasi-static, the spheres' material that of Tran et al.
inline Config lattice_config(double friction, double stress, double strain_rate, double strain) {
    Config config;
    config.particle.friction_angle = std::atan(friction);
    config.particle.stiffness_ratio = 0.3;
    config.triaxial.confining_stress = stress;
    config.triaxial.strain_rate = strain_rate;
    config.triaxial.max_axial_strain = strain;
    return config;
}

/// The scene of a lattice with the config's properties.
inline core::Scene lattice_scene(Sample sample, const Config& config) {
    std::fill(sample.spheres.friction_angle.begin(), sample.spheres.friction_angle.end(),
              config.particle.friction_angle);
    return make_scene(std::move(sample), config);
}

/// sigma_1/sigma_3 at the peak of the whole test.
inline double stress_ratio_at_failure(Sample sample, const Config& config,
                                      const kernels::KernelTable& table) {
    core::Simulation simulation(lattice_scene(std::move(sample), config), table);
    core::Monitor silent;
    const TestResult result = run_test(simulation, config, silent);
    EXPECT_LT(result.lateral_rms_error, 0.003);
    EXPECT_LT(result.results.axial_strain_at_peak, 0.9 * *config.triaxial.max_axial_strain);
    return 1 + result.results.peak_deviator_stress / config.triaxial.confining_stress;
}

/// How a block answers a small axial strain at constant lateral stress.
struct SmallStrain {
    double modulus;  ///< d sigma_y/d epsilon_y [Pa]
    double lateral;  ///< -d (epsilon_x + epsilon_z)/d epsilon_y [-]
};

/// Isotropic compression and shear stage; from the curve between a quarter of the strain, where the
/// servos have settled, and its end.
inline SmallStrain small_strain(Sample sample, const Config& config,
                                const kernels::KernelTable& table) {
    core::Simulation simulation(lattice_scene(std::move(sample), config), table);
    core::Monitor silent;
    core::Driver driver(simulation, config.time, silent);
    packing::compress_isotropically(driver, config.triaxial.confining_stress);
    ShearStage shear(driver, config.triaxial, config.particle.density, {.transient_strain = 1e-5});
    shear.run();
    const CurvePoint& end = shear.curve().back();
    const auto start =
        std::find_if(shear.curve().begin(), shear.curve().end(), [&](const CurvePoint& p) {
            return p.axial_strain > 0.25 * *config.triaxial.max_axial_strain;
        });
    const double strain = end.axial_strain - start->axial_strain;
    return {(end.axial_stress - start->axial_stress) / strain,
            1 - (end.volumetric_strain - start->volumetric_strain) / strain};
}

}  // namespace grainfield::triaxial::testing
