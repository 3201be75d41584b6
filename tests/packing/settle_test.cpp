// Settling under gravity: the floor carries the weight, everything is at rest.
#include "packing/settle.hpp"

#include <gtest/gtest.h>

#include "core/drive/servo.hpp"
#include "tests/packing/small_samples.hpp"

namespace grainfield::packing {
namespace {

TEST(Settle, FloorCarriesTheWeight) {
    const PackingOptions options = testing::small_options();
    const Material material;
    core::ParticleStore s = testing::spheres_of(std::vector<double>(60, 0.022), material);
    const double height = place_at_random(s, 0.2, 0.2, 0.4, 2);
    double weight = 0;
    for (double m : s.mass) weight += m * options.gravity;
    core::Scene scene =
        testing::box_scene(std::move(s), {Vec3::Zero(), Vec3(0.2, height, 0.2)}, material);
    scene.walls.erase(scene.walls.begin() + 3);
    core::Simulation simulation(std::move(scene), kernels::reference_kernels());
    core::Monitor monitor;
    core::Driver driver(simulation, {}, monitor);
    settle_under_gravity(driver, 2, options.gravity, height);
    EXPECT_NEAR(core::wall_compression(simulation, 2), weight, 0.006 * weight);
    EXPECT_LT(simulation.unbalanced_force_ratio(), 0.015);
    for (std::size_t i = 0; i < simulation.spheres().size(); ++i) {
        EXPECT_EQ(simulation.spheres().velocity[i], Vec3::Zero());
        EXPECT_GT(simulation.spheres().position.y[i], 0);
    }
}

}  // namespace
}  // namespace grainfield::packing
