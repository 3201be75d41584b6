// Lattices whose stresses and moduli are known exactly.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/drive/measures.hpp"
#include "tests/core/test_scenes.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::core {
namespace {

constexpr double R = test_radius;

/// n^3 spheres with overlaps delta[a] along each axis, squeezed by six walls; rigid walls stand
/// half an overlap in, so that every layer has the same force.
Scene cubic_block(int n, const Vec3& delta, const Eigen::Matrix3d& turn) {
    const Vec3 spacing = Vec3::Constant(2 * R) - delta;
    std::vector<Ball> balls;
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int c = 0; c < n; ++c)
                balls.push_back(
                    {.x = turn * spacing.cwiseProduct(Vec3(a + 0.5, b + 0.5, c + 0.5))});
    Scene scene = scene_of(balls, 0.5);
    scene.walls = box_walls({Vec3::Zero(), n * spacing}, plane(Vec3::Zero(), Vec3::UnitX(), 0.5));
    for (Wall& wall : scene.walls) {
        wall.normal_stiffness = 1e18 * test_stiffness;  // wall contacts of 2 K_n
        wall.point = turn * wall.point;
        wall.normal = turn * wall.normal;
    }
    return scene;
}

const std::string lattice_stress_page = "Stress and moduli of lattices";

using LatticeStress = KernelTest;

TEST_P(LatticeStress, SimpleCubicStressIsExactInAllNineComponents) {
    const int n = 5;
    const Vec3 delta = R * Vec3(1e-3, 4e-3, 2e-3);
    for (const Eigen::Matrix3d& turn :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), some_rotation()}) {
        Simulation sim(cubic_block(n, delta, turn), table());
        sim.compute_forces(true);
        const Vec3 size = n * (Vec3::Constant(2 * R) - delta);
        // n^2 chains along each axis, each of force K_n delta.
        Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
        for (int a = 0; a < 3; ++a)
            expected(a, a) = n * n * test_kn * delta[a] * size[a] / size.prod();
        expected = (turn * expected * turn.transpose()).eval();
        const Eigen::Matrix3d stress = mean_stress(sim, size.prod());
        // Overlaps of 1e-3 R in coordinates of 10 R.
        verify::record({.scene = lattice_stress_page,
                        .quantity = "simple cubic: stress tensor, largest error of nine components",
                        .closed_form = "n^2 K_n delta_a L_a/V, turned",
                        .source = "Love, Weber",
                        .unit = "Pa",
                        .tolerance = "round-off of overlaps of 1e-3 R",
                        .scale = expected.norm()},
                       GetParam().name, 0, (stress - expected).cwiseAbs().maxCoeff(),
                       roundoff(is_mixed() ? 10 : 1e5) * expected.norm());
        EXPECT_LT(sim.unbalanced_force_ratio(), roundoff(1e5));
        EXPECT_EQ(sim.contacts().count(), 3 * n * n * (n + 1));
    }
}

TEST_P(LatticeStress, SimpleCubicModuli) {
    // Strain delta/2R against the undeformed lattice, whose faces are (2R)^2 a chain.
    const int n = 4;
    for (double strain : {1e-4, 1e-6}) {
        const double delta = 2 * R * strain, volume = std::pow(2 * R * n, 3);
        Simulation one(cubic_block(n, Vec3(delta, 0, 0), Eigen::Matrix3d::Identity()), table());
        one.compute_forces();
        // Double takes overlaps from positions; single precision keeps separations instead.
        const double rounding = is_mixed() ? roundoff(4) : roundoff(100) / strain;
        const std::string why = "the strain itself, and round-off over it";
        verify::record({.scene = lattice_stress_page,
                        .quantity = fmt::format("simple cubic: C11, strain {:g}", strain),
                        .closed_form = "K_n/(2 R)",
                        .source = "lattice sum",
                        .unit = "Pa",
                        .tolerance = why},
                       GetParam().name, test_kn / (2 * R), mean_stress(one, volume)(0, 0) / strain,
                       2 * strain * test_kn / (2 * R) + rounding * test_kn / R);
        Simulation all(cubic_block(n, Vec3::Constant(delta), Eigen::Matrix3d::Identity()), table());
        all.compute_forces();
        verify::record({.scene = lattice_stress_page,
                        .quantity = fmt::format("simple cubic: bulk modulus, strain {:g}", strain),
                        .closed_form = "K_n/(6 R)",
                        .source = "lattice sum",
                        .unit = "Pa",
                        .tolerance = why},
                       GetParam().name, test_kn / (6 * R),
                       mean_stress(all, volume).trace() / 3 / (3 * strain),
                       2 * strain * test_kn / (6 * R) + rounding * test_kn / R);
    }
}

/// Change of stress of an FCC lattice under an affine strain: one sphere and its twelve
/// neighbours, moved in one step of a Simulation, so heavy that no force moves them.
Eigen::Matrix3d fcc_stress_change(const kernels::KernelTable& table, double lambda,
                                  const Eigen::Matrix3d& strain) {
    const double squeeze = 1e-5;
    std::vector<Ball> balls{Ball{}};
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
            for (int k = -1; k <= 1; ++k)
                if (std::abs(i) + std::abs(j) + std::abs(k) == 2)
                    balls.push_back({.x = std::sqrt(2.0) * R * (1 - squeeze) * Vec3(i, j, k)});
    for (Ball& ball : balls) ball.v = -strain * ball.x;  // in one step of 1 s
    Scene scene = scene_of(balls, 1e6);
    scene.stiffness_ratio = lambda;
    std::fill(scene.spheres.mass.begin(), scene.spheres.mass.end(), 1e30);
    Simulation sim(std::move(scene), table);
    const auto stress = [&] {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const Branch& b : force_branches(sim))
            if (b.from.isZero(1e-12)) sum += b.force * (b.to - b.from).transpose();
        return Eigen::Matrix3d(0.5 * sum / (4 * std::sqrt(2.0) * R * R * R));
    };
    sim.compute_forces();
    const Eigen::Matrix3d before = stress();
    sim.advance(1.0);
    sim.compute_forces();
    EXPECT_EQ(sim.contacts().count(), 12 + 24);
    return stress() - before;
}

TEST_P(LatticeStress, FccModuli) {
    const double e = 1e-6;
    for (double lambda : {0.1, 0.5, 1.0}) {
        const double c = test_kn / (std::sqrt(2.0) * R);
        Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
        strain(0, 0) = e;
        // The initial stress changes moduli by its strain, 1e-5; the strain itself by 1e-6.
        const double tolerance = 1e-4 * c;
        const Eigen::Matrix3d axial = fcc_stress_change(table(), lambda, strain) / e;
        const auto check = [&](const char* name, const char* form, double expected, double found) {
            verify::record({.scene = lattice_stress_page,
                            .quantity = fmt::format("FCC: {}, lambda = {}", name, lambda),
                            .closed_form = form,
                            .source = "lattice sum",
                            .unit = "Pa",
                            .tolerance = "strain of 1e-5 before, 1e-6 of the test's"},
                           GetParam().name, expected, found, tolerance);
        };
        check("C11", "(K_n + K_s)/(sqrt(2) R)", c * (1 + lambda), axial(0, 0));
        check("C12", "(K_n - K_s)/(2 sqrt(2) R)", c * (1 - lambda) / 2, axial(1, 1));
        EXPECT_NEAR(axial(2, 2), c * (1 - lambda) / 2, tolerance);
        EXPECT_LT(std::abs(axial(0, 1)) + std::abs(axial(1, 2)) + std::abs(axial(0, 2)), tolerance);
        strain.setZero();
        strain(0, 1) = strain(1, 0) = e;
        const Eigen::Matrix3d shear = fcc_stress_change(table(), lambda, strain) / (2 * e);
        check("C44", "(K_n + K_s)/(2 sqrt(2) R)", c * (1 + lambda) / 2, shear(0, 1));
        EXPECT_NEAR(shear(1, 0), c * (1 + lambda) / 2, tolerance);
        EXPECT_LT(std::abs(shear(0, 0)) + std::abs(shear(2, 2)), tolerance);
    }
}

TEST_P(LatticeStress, FabricOfASimpleCubicBlock) {
    Simulation sim(cubic_block(4, Vec3::Constant(1e-3 * R), Eigen::Matrix3d::Identity()), table());
    sim.compute_forces();
    const Fabric fabric = measure_fabric(sim);
    EXPECT_DOUBLE_EQ(fabric.coordination_number, 6.0);
    EXPECT_DOUBLE_EQ(fabric.mechanical_coordination_number, 6.0);
    EXPECT_EQ(fabric.rattler_fraction, 0.0);
    EXPECT_LT((fabric.tensor - Eigen::Matrix3d::Identity() / 3).norm(), 1e-12);
    EXPECT_LT(fabric.anisotropy, 1e-12);
}

// Thornton (2000): (2C - N1)/(N - N0 - N1). 64 spheres of a free block with 144 contacts, the
// corners with three each; beside them one that hangs on a corner and one that touches nothing.
TEST_P(LatticeStress, SpheresWithLessThanTwoContactsAreRattlers) {
    Scene scene = cubic_block(4, Vec3::Constant(1e-3 * R), Eigen::Matrix3d::Identity());
    const std::size_t n = scene.spheres.size();
    ASSERT_EQ(n, 64u);
    std::size_t corner = 0;
    for (std::size_t i = 1; i < n; ++i)
        if (scene.spheres.position[i].sum() > scene.spheres.position[corner].sum()) corner = i;
    const Vec3 outermost = scene.spheres.position[corner];
    for (const double distance : {1.999 * R, 10 * R}) {
        const std::size_t i = scene.spheres.size();
        scene.spheres.resize(i + 1);
        scene.spheres.position.set(i, outermost + distance * Vec3::Ones().normalized());
        scene.spheres.radius[i] = R;
        scene.spheres.mass[i] = scene.spheres.mass[0];
        scene.spheres.normal_stiffness[i] = scene.spheres.normal_stiffness[0];
    }
    scene.walls.clear();
    Simulation sim(std::move(scene), table());
    sim.compute_forces();
    const Fabric fabric = measure_fabric(sim);
    EXPECT_DOUBLE_EQ(fabric.coordination_number, 2 * 145.0 / 66);
    EXPECT_DOUBLE_EQ(fabric.mechanical_coordination_number, (2 * 145.0 - 1) / (66 - 2));
    EXPECT_GT(fabric.mechanical_coordination_number, fabric.coordination_number);
    EXPECT_DOUBLE_EQ(fabric.rattler_fraction, 2.0 / 66);
    EXPECT_NEAR(fabric.rattler_volume_fraction, 2.0 / 66, 1e-14);  // sums of 66 terms
}

GRAINFIELD_FOR_ALL_KERNELS(LatticeStress);

}  // namespace
}  // namespace grainfield::core
