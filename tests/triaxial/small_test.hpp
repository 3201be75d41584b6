#pragma once
// A small sample for triaxial tests, made fresh in a second or two: a random packing compressed
// without friction, which makes it dense and its peak clear.

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/packing/small_samples.hpp"
#include "triaxial/realization/sample.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial::testing {

/// `n` spheres of +-17 % about 25 mm in radius in a box about twice as tall as wide, dense, at
/// rest; blocks = the cell of `cells` each sphere lies in.
inline Sample dense_sample(int n, const std::array<std::int32_t, 3>& cells = {2, 4, 2}) {
    const packing::Material material;
    std::vector<double> radii;
    double volume = 0;
    for (int i = 0; i < n; ++i) {
        radii.push_back(0.021 + 0.008 * (i * 367 % n) / n);
        volume += packing::testing::sphere_volume(2 * radii.back());
    }
    core::ParticleStore spheres = packing::testing::spheres_of(radii, material);
    const double width = std::cbrt(0.5 * volume / 0.62);  // of the dense sample
    const double height =
        packing::place_at_random(spheres, 1.15 * width, 1.15 * width, 2.6 * width, 17);
    core::Simulation simulation(
        packing::testing::box_scene(
            std::move(spheres), {Vec3::Zero(), Vec3(1.15 * width, height, 1.15 * width)}, material),
        kernels::reference_kernels());
    simulation.set_friction_angle(0);
    core::Monitor monitor;
    core::Driver driver(simulation, {}, monitor);
    packing::compress_isotropically(driver, 20e3);
    simulation.set_friction_angle(material.friction_angle);
    simulation.scale_velocities(0);

    Sample sample{simulation.spheres(), {}};
    for (int a = 0; a < 3; ++a) {
        sample.box.lower[a] = simulation.walls()[2 * a].point[a];
        sample.box.upper[a] = simulation.walls()[2 * a + 1].point[a];
    }
    const Vec3 size = sample.box.size();
    for (std::size_t i = 0; i < sample.spheres.size(); ++i)
        for (int a = 0; a < 3; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            const double share = (sample.spheres.position[i][a] - sample.box.lower[a]) / size[a];
            sample.spheres.block[i][axis] =
                std::clamp(static_cast<std::int32_t>(share * cells[axis]), 0, cells[axis] - 1);
        }
    return sample;
}

/// Tran et al.'s material and test with the field's grid over dense_sample().
inline Config small_config(const Sample& sample,
                           const std::array<std::int32_t, 3>& cells = {2, 4, 2}) {
    Config config;
    config.packing.blocks = cells;
    for (int a = 0; a < 3; ++a)
        config.packing.block[a] = sample.box.size()[a] / cells[static_cast<std::size_t>(a)];
    return config;
}

struct FinishedTest {
    TestResult result;
    core::Simulation simulation;
};

/// Runs the whole test on the sample.
inline FinishedTest run(Sample sample, const Config& config,
                        const kernels::KernelTable& kernels = kernels::reference_kernels(),
                        const core::SimulationOptions& options = {}) {
    core::Simulation simulation(make_scene(std::move(sample), config), kernels, options);
    core::Monitor monitor;
    TestResult result = run_test(simulation, config, monitor);
    return {std::move(result), std::move(simulation)};
}

}  // namespace grainfield::triaxial::testing
