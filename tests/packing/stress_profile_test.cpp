// Stresses over the depth of columns and lattices whose contact forces are known.
#include "packing/stress_profile.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/packing/small_samples.hpp"

namespace grainfield::packing {
namespace {

constexpr double radius = 0.025;  // [m]
constexpr double gravity = 9.81;  // [m/s2]
constexpr double squeeze = 1e-6;  // overlap with each of the two x walls [m]

/// columns x n x columns spheres on top of each other at the overlaps that carry their weight:
/// the k-th contact from below, floor included, carries n - k spheres. Side walls squeeze the
/// outermost columns in x; the inner ones do not touch.
struct Columns {
    core::Simulation simulation;
    double top, base, mass, side_force;
};
Columns make_columns(int columns, int n) {
    const Material material;
    core::ParticleStore s = testing::spheres_of(
        std::vector<double>(static_cast<std::size_t>(columns * columns * n), radius), material);
    const double stiffness = 0.5 * radius * material.normal_stiffness;
    const double weight = s.mass[0] * gravity;
    const double spacing = 2 * radius * (1 + 1e-6);
    std::size_t at = 0;
    double top = 0;
    for (int i = 0; i < columns; ++i)
        for (int k = 0; k < columns; ++k) {
            double y = -radius;
            for (int j = 0; j < n; ++j) {
                y += 2 * radius - (n - j) * weight / stiffness;
                s.position.set(at++, Vec3(radius + i * spacing, y, radius + k * spacing));
            }
            top = y + radius;
        }
    const double end = 2 * radius + (columns - 1) * spacing;
    core::Scene scene = testing::box_scene(
        std::move(s), {Vec3(squeeze, 0, 0), Vec3(end - squeeze, 2 * top, end)}, material);
    scene.gravity = Vec3(0, -gravity, 0);
    const double mass = scene.spheres.mass[0];
    core::Simulation simulation(std::move(scene), kernels::reference_kernels());
    simulation.compute_forces(true);
    return {std::move(simulation), top, end * end, mass, stiffness * squeeze};
}

TEST(StressProfile, ColumnInClosedForm) {
    const int n = 7;
    const Columns c = make_columns(1, n);
    // Vertically at rest. (Two touching walls carry nothing along y: no friction, no motion.)
    EXPECT_LT(c.simulation.unbalanced_force_ratio(), 1e-8);
    const StressProfile p = measure_stress_profile(c.simulation, c.top, c.base, gravity, n);
    ASSERT_EQ(p.depth.size(), 7U);
    const double weight = c.mass * gravity;
    // Overlaps are 2e-5 of the height of a layer, and move centres and layers against each other.
    const double tolerance = 1e-4;
    EXPECT_NEAR(p.unit_weight, n * weight / (c.base * c.top), 1e-12 * p.unit_weight);
    for (std::size_t k = 0; k < p.depth.size(); ++k) {
        const double spheres_above = static_cast<double>(k) + 0.5;
        EXPECT_NEAR(p.depth[k], spheres_above * c.top / n, 1e-12);
        EXPECT_NEAR(p.vertical[k], spheres_above * weight / c.base,
                    tolerance * n * weight / c.base);
        // Both side contacts of the layer's sphere, branches of one radius.
        const double side = 2 * c.side_force * (radius - squeeze) / (c.base * c.top / n);
        EXPECT_NEAR(p.horizontal_x[k], side, 1e-9 * side);
        EXPECT_EQ(p.horizontal_z[k], 0);
    }
    EXPECT_NEAR(p.slope_ratio, 1, tolerance);
    EXPECT_NEAR(p.r2, 1, 1e-6);
    EXPECT_NEAR(p.K0, 0, 1e-9);
}

TEST(StressProfile, LatticeFollowsItsUnitWeight) {
    const Columns c = make_columns(3, 12);
    for (const int layers : {12, 6, 4, 3}) {  // a whole number of spheres to a layer
        const StressProfile p =
            measure_stress_profile(c.simulation, c.top, c.base, gravity, layers);
        EXPECT_NEAR(p.slope_ratio, 1, 2e-4) << layers;
        EXPECT_NEAR(p.r2, 1, 1e-6) << layers;
    }
    // Else the staircase of the forces shows: half a sphere's weight at most, of twelve.
    const StressProfile p = measure_stress_profile(c.simulation, c.top, c.base, gravity, 5);
    EXPECT_NEAR(p.slope_ratio, 1, 0.05);
    EXPECT_GT(p.r2, 0.99);
}

}  // namespace
}  // namespace grainfield::packing
