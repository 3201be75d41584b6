// Phase 1 on a small block.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/drive/measures.hpp"
#include "tests/packing/small_samples.hpp"

namespace grainfield::packing {
namespace {

using testing::box_scene;
using ::testing::HasSubstr;
using testing::kernels_here;
using testing::narrow_grading;
using testing::small_options;

void expect_inside_and_at_rest(const core::ParticleStore& s, const Vec3& size) {
    for (std::size_t i = 0; i < s.size(); ++i) {
        EXPECT_GE(s.position[i].minCoeff(), 0) << i;
        EXPECT_GE((size - s.position[i]).minCoeff(), 0) << i;
        EXPECT_EQ(s.velocity[i], Vec3::Zero()) << i;
        EXPECT_EQ(s.spin[i], Vec3::Zero()) << i;
    }
}

/// The block's spheres between its walls, which give half the overlap of a mirror image.
core::Simulation at_rest(core::ParticleStore spheres, const PackingOptions& options,
                         const Material& material, double gravity) {
    core::Scene scene = box_scene(std::move(spheres), {Vec3::Zero(), options.block}, material);
    for (core::Wall& wall : scene.walls) wall.normal_stiffness *= 1e6;
    scene.gravity = Vec3(0, gravity, 0);
    core::Simulation simulation(std::move(scene), kernels::reference_kernels());
    simulation.compute_forces(true);
    return simulation;
}

double own_stress(const PackingOptions& options, const Material& material) {
    return 0.5 * bulk_unit_weight(material, options.porosity, options.gravity) * options.block.y();
}

TEST(Block, MeetsPorosityWithTheStressOfItsOwnWeight) {
    const PackingOptions options = small_options();
    const Material material;
    core::Monitor monitor;
    const Block block = pack_block(options, narrow_grading(), material, kernels_here(), monitor);
    EXPECT_GT(block.spheres.size(), 30U);
    EXPECT_EQ(block.spheres.size(), block.grading.diameter.size());
    EXPECT_NEAR(1 - block.spheres.solid_volume() / options.block.prod(), 0.51, 1e-9);
    EXPECT_NEAR(block.porosity, 0.51, 1e-9);
    EXPECT_GT(block.mean_stress, 0);
    EXPECT_LE(block.mean_stress, 2 * own_stress(options, material));
    EXPECT_LE(block.compaction_friction_angle, material.friction_angle);
    EXPECT_GT(block.settled_height, 0.15);
    EXPECT_GT(block.steps, 0);
    expect_inside_and_at_rest(block.spheres, options.block);
    expect_inside_and_at_rest(block.hanging, options.block);
    ASSERT_EQ(block.hanging.size(), block.spheres.size());
    double farthest = 0;
    for (std::size_t i = 0; i < block.spheres.size(); ++i) {
        EXPECT_EQ(block.hanging.radius[i], block.spheres.radius[i]);
        EXPECT_EQ(block.hanging.mass[i], block.spheres.mass[i]);
        EXPECT_EQ(block.hanging.friction_angle[i], material.friction_angle);
        EXPECT_EQ(block.spheres.friction_angle[i], material.friction_angle);
        farthest =
            std::max(farthest, (block.hanging.position[i] - block.spheres.position[i]).norm());
    }
    EXPECT_LT(farthest, 0.06) << "standing on its head moves loose spheres across their pore only";
}

TEST(Block, IsInEquilibriumBetweenItsWalls) {
    // Without friction, forces follow from positions: the state can be looked at from outside.
    PackingOptions options = small_options();
    options.compaction_friction = 0.0;
    Material material;
    material.friction_angle = 0;
    core::Monitor monitor;
    const Block block = pack_block(options, narrow_grading(), material, kernels_here(), monitor);
    EXPECT_EQ(block.compaction_friction_angle, 0);
    options.block = block.size;
    for (const double gravity : {-9.81, 9.81}) {
        SCOPED_TRACE(gravity);
        const core::Simulation simulation =
            at_rest(gravity < 0 ? block.spheres : block.hanging, options, material, gravity);
        // pack_block() ends at 1e-3 with one step of creep after it was measured.
        EXPECT_LT(simulation.unbalanced_force_ratio(), 2e-3);
        double weight = 0;
        for (double m : block.spheres.mass) weight += m * options.gravity;
        const auto vertical =
            simulation.wall_loads()[2].force.y() + simulation.wall_loads()[3].force.y();
        EXPECT_NEAR(vertical, weight * gravity / 9.81, 0.01 * weight);
        if (gravity < 0) {
            EXPECT_NEAR(core::mean_stress(simulation, options.block.prod()).trace() / 3,
                        block.mean_stress, 1e-6 * block.mean_stress);
        }
    }
}

TEST(Block, UnreachablePorosityIsRefusedWithWhatCanBe) {
    PackingOptions options = small_options();
    for (const double porosity : {0.30, 0.60}) {
        options.porosity = porosity;
        core::Monitor monitor;
        const std::string message = message_of<InputError>(
            [&] { pack_block(options, narrow_grading(), {}, kernels_here(), monitor); });
        EXPECT_THAT(message, HasSubstr(fmt::format("packing.porosity = {:g}: cannot", porosity)));
        const auto at = message.rfind("which can have ");
        ASSERT_NE(at, std::string::npos) << message;
        const double densest = std::stod(message.substr(at + 15));
        EXPECT_GT(densest, 0.40);
        EXPECT_LT(densest, 0.51);
        const double loosest = std::stod(message.substr(message.find(" to ", at) + 4));
        EXPECT_GT(loosest, densest);
        EXPECT_LT(loosest, 0.60);
        EXPECT_THAT(message, HasSubstr("times the largest of"));
    }
}

/// 150 grains of the paper's curve.
PackingOptions paper_block() {
    PackingOptions options;
    options.spheres = 150;
    options.blocks = {1, 1, 1};
    return options;
}

TEST(Block, HasTheRelativeDensityThatIsAskedFor) {
    PackingOptions options = paper_block();
    core::Monitor monitor;
    double last = 1;
    for (const double density : {0.0, 0.5, 1.0}) {
        SCOPED_TRACE(density);
        options.relative_density = density;
        const Block block = pack_block(options, {}, {}, kernels_here(), monitor);
        EXPECT_NEAR(block.range.relative_density(block.porosity), density, 1e-6);
        EXPECT_NEAR(block.porosity, 1 - block.spheres.solid_volume() / block.size.prod(), 1e-9);
        EXPECT_EQ(block.size.x(), options.block.x());
        EXPECT_EQ(block.size.z(), options.block.z());
        EXPECT_LT(block.porosity, last);
        last = block.porosity;
        EXPECT_LE(block.mean_stress, 2 * own_stress(options, {}));
        expect_inside_and_at_rest(block.spheres, block.size);
        expect_inside_and_at_rest(block.hanging, block.size);
        for (const double friction : block.spheres.friction_angle) EXPECT_EQ(friction, 0.6);
    }
}

TEST(Block, IsTheDenserTheLessFrictionItWasShakenWith) {
    PackingOptions options = paper_block();
    options.spheres = 351;  // of fewer, two states would scatter by as much as they differ
    core::Monitor monitor;
    double last = 0;
    for (const double friction : {0.0, 0.6}) {
        SCOPED_TRACE(friction);
        options.compaction_friction = friction;
        const Block block = pack_block(options, {}, {}, kernels_here(), monitor);
        EXPECT_EQ(block.compaction_friction_angle, friction);
        EXPECT_GT(block.porosity, last);
        last = block.porosity;
        EXPECT_LT(block.porosity, block.range.loosest);
        for (const double angle : block.spheres.friction_angle) EXPECT_EQ(angle, 0.6);
    }
}

}  // namespace
}  // namespace grainfield::packing
