// The highest frequency of a network: the estimate against the dense eigenvalue problem, and
// against the exact values of infinite lattices.

#include "core/drive/frequency.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/drive/step_control.hpp"
#include "tests/core/test_scenes.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::core {
namespace {

/// Adds K_n (n.u)^2 + K_s |slip|^2 of a contact to the stiffness; columns of the bodies in `b`.
void add_contact(Eigen::MatrixXd& stiffness, const Eigen::Matrix<double, 3, Eigen::Dynamic>& b,
                 const Vec3& normal, double kn, double ks) {
    const Eigen::Matrix3d along = normal * normal.transpose();
    const Eigen::Matrix3d spring = kn * along + ks * (Eigen::Matrix3d::Identity() - along);
    stiffness += b.transpose() * spring * b;
}

Eigen::Matrix3d cross_matrix(const Vec3& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

/// omega_max of all overlapping pairs and walls by the dense generalised eigenvalue problem.
double dense_frequency(const Scene& scene) {
    const ParticleStore& s = scene.spheres;
    const auto n = static_cast<Eigen::Index>(s.size());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    Eigen::VectorXd mass(6 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
        mass.segment<3>(6 * i).setConstant(s.mass[i]);
        mass.segment<3>(6 * i + 3).setConstant(0.4 * s.mass[i] * s.radius[i] * s.radius[i]);
        // Slip of the far body at the contact: u_j - u_i - (r_i w_i + r_j w_j) x n.
        for (Eigen::Index j = i + 1; j < n; ++j) {
            const Vec3 branch = s.position[j] - s.position[i];
            if (branch.norm() >= s.radius[i] + s.radius[j]) continue;
            const Vec3 normal = branch.normalized();
            Eigen::Matrix<double, 3, Eigen::Dynamic> b = Eigen::MatrixXd::Zero(3, 6 * n);
            b.block<3, 3>(0, 6 * i) = -Eigen::Matrix3d::Identity();
            b.block<3, 3>(0, 6 * j) = Eigen::Matrix3d::Identity();
            b.block<3, 3>(0, 6 * i + 3) = s.radius[i] * cross_matrix(normal);
            b.block<3, 3>(0, 6 * j + 3) = s.radius[j] * cross_matrix(normal);
            const double kn = 0.5 * (s.radius[i] + s.radius[j]) * s.normal_stiffness[i] *
                              s.normal_stiffness[j] /
                              (s.normal_stiffness[i] + s.normal_stiffness[j]);
            add_contact(stiffness, b, normal, kn, scene.stiffness_ratio * kn);
        }
        for (const Wall& wall : scene.walls) {
            if (wall.normal.dot(s.position[i] - wall.point) >= s.radius[i]) continue;
            Eigen::Matrix<double, 3, Eigen::Dynamic> b = Eigen::MatrixXd::Zero(3, 6 * n);
            b.block<3, 3>(0, 6 * i) = -Eigen::Matrix3d::Identity();
            b.block<3, 3>(0, 6 * i + 3) = s.radius[i] * cross_matrix(-wall.normal);
            const double ka = s.normal_stiffness[i], kb = wall.normal_stiffness;
            const double sa = scene.stiffness_ratio * ka, sb = wall.stiffness_ratio * kb;
            add_contact(stiffness, b, wall.normal, s.radius[i] * ka * kb / (ka + kb),
                        s.radius[i] * sa * sb / (sa + sb));
        }
    }
    const Eigen::VectorXd scale = mass.array().sqrt().inverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * stiffness * scale.asDiagonal();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                         .eigenvalues()
                         .maxCoeff());
}

/// Overlapping spheres at random, of two stiffnesses, in a box whose walls touch some.
Scene random_packing(std::uint64_t realization, double lambda, double contrast) {
    std::vector<Ball> balls;
    for (std::uint64_t i = 0; i < 50; ++i)
        balls.push_back({.x = 0.15 * random_vec(i, realization),
                         .radius = test_radius * (1 + 0.5 * random_vec(i, 50 + realization).x()),
                         .stiffness = i % 2 == 0 ? test_stiffness : contrast * test_stiffness});
    Scene scene = scene_of(balls, 0.5);
    scene.stiffness_ratio = lambda;
    scene.walls = box_walls({Vec3::Constant(-0.17), Vec3::Constant(0.17)},
                            plane(Vec3::Zero(), Vec3::UnitX(), 0.5, 0.3));
    return scene;
}

double estimate(const Scene& scene, const kernels::KernelTable& table) {
    Simulation sim(scene, table);
    sim.compute_forces();
    return FrequencyEstimator().estimate(sim);
}

using Frequency = KernelTest;

TEST_P(Frequency, AgreesWithTheDenseEigenvalue) {
    for (double lambda : {0.1, 0.5, 1.0})
        for (double contrast : {1.0, 100.0})
            for (std::uint64_t k = 0; k < 5; ++k) {
                const Scene scene = random_packing(k, lambda, contrast);
                const double ratio = estimate(scene, table()) / dense_frequency(scene);
                // Below 1 the step is too long by that; safety 0.8 leaves a quarter.
                EXPECT_GE(ratio, 0.995) << lambda << " " << contrast << " " << k;
                EXPECT_LE(ratio, 1.05) << lambda << " " << contrast << " " << k;
            }
}

TEST_P(Frequency, IsZeroWithoutContactsAndThatOfACagedSphereIsDefined) {
    Simulation sim(scene_of({Ball{}, Ball{.x = Vec3(1, 0, 0), .radius = 0.01}}), table());
    sim.compute_forces();
    EXPECT_EQ(FrequencyEstimator().estimate(sim), 0.0);
    // Two contacts on opposite sides of the lightest sphere: 4 K_n/m.
    const double expected = std::sqrt(4 * 0.01 * test_stiffness / 2 / sphere_mass(0.01));
    EXPECT_NEAR(caged_frequency(sim, 0), expected, 1e-12 * expected);
    // Rolling and sliding of one contact, both bodies turning: 7 K_s/m.
    Scene rough = sim.scene();
    rough.stiffness_ratio = 1.0;
    Simulation turning(std::move(rough), table());
    turning.compute_forces();
    EXPECT_NEAR(caged_frequency(turning, 0), std::sqrt(7.0 / 4.0) * expected, 1e-12 * expected);
}

TEST_P(Frequency, SmoothContactsCountBesideRoughOnes) {
    // A sphere rolls on the rough floor at 3.5 K_s/m; another is caged between smooth walls, at
    // 2 K_n/m, which is a little more. On the mass, K_n of the one is far less than K_n + 2 K_s of
    // the other.
    Scene scene = scene_of(
        {Ball{.x = Vec3(0.05, 0.0299, 0), .radius = 0.03, .stiffness = 0.108 * test_stiffness},
         Ball{.x = Vec3(0.05, 1, 0)}},
        0.5);
    scene.stiffness_ratio = 1.0;
    scene.walls = {plane(Vec3::Zero(), Vec3::UnitY(), 0.5, 1.0),
                   plane(Vec3(1e-3, 0, 0), Vec3::UnitX()),
                   plane(Vec3(0.099, 0, 0), -Vec3::UnitX())};
    const double kn = test_radius * test_stiffness / 2;
    const double rolling = 3.5 * 0.03 * test_stiffness * 0.108 / 1.108 / sphere_mass(0.03);
    const double caged = 2 * kn / sphere_mass(test_radius);
    ASSERT_GT(caged, 1.05 * rolling);
    EXPECT_NEAR(estimate(scene, table()), std::sqrt(caged), 0.005 * std::sqrt(caged));
}

TEST_P(Frequency, ACagedSphereIsAsFastAsItsNeighboursAllow) {
    // A light stiff sphere between two soft heavy ones: K_n (1/m + 1/M) of each contact, which is
    // less than between two of its own kind. Bands of 1e-12: both are a few operations.
    const double gap = 1e-6, soft = 1e6, stiff = 1e9, small = 0.005, large = 0.02;
    const double reach = small + large + gap;
    Scene scene = scene_of({Ball{.x = Vec3(-reach, 0, 0), .radius = large},
                            Ball{.x = Vec3(0, 0, 0), .radius = small},
                            Ball{.x = Vec3(reach, 0, 0), .radius = large}});
    scene.spheres.normal_stiffness = {soft, stiff, soft};
    Simulation sim(scene, table());
    sim.compute_forces();
    const double kn = 0.5 * (small + large) * soft * stiff / (soft + stiff);
    const double inverse_masses = 1 / sphere_mass(small) + 1 / sphere_mass(large);
    const double expected = std::sqrt(2 * kn * inverse_masses);
    EXPECT_NEAR(caged_frequency(sim, 0), expected, 1e-12 * expected);
    // Rough ones: both bodies of the stiffer contact turning, 3.5 K_s (1/m + 1/M).
    Scene rough = sim.scene();
    rough.stiffness_ratio = 1.0;
    Simulation turning(std::move(rough), table());
    turning.compute_forces();
    const double fastest = std::sqrt(3.5 * kn * inverse_masses);
    EXPECT_NEAR(caged_frequency(turning, 0), fastest, 1e-12 * fastest);
    // Known to be faster than any sphere alone could be: no need to look at neighbours.
    const double alike = std::sqrt(4 * small * stiff / 2 / sphere_mass(small));
    EXPECT_NEAR(caged_frequency(sim, 2 * alike), alike, 1e-12 * alike);
}

TEST_P(Frequency, TheStepSitsNearTheLimitOfTheNetworkAtAnyContrast) {
    for (double contrast : {1.0, 1e3})
        for (std::uint64_t k = 0; k < 5; ++k) {
            Simulation sim(random_packing(k, 0.1, contrast), table());
            sim.compute_forces();
            const double limit = 2 / FrequencyEstimator().estimate(sim);
            StepControl control({});  // safety 0.8
            const double step = control.next(sim);
            EXPECT_LE(step, 0.8 * 1.005 * limit) << contrast << " " << k;
            // What a sphere could do once it is caged between two others costs something.
            EXPECT_GE(step, 0.5 * limit) << contrast << " " << k;
        }
}

TEST_P(Frequency, AFewIterationsFromTheLastModeAreAsGoodAsManyFromScratch) {
    // The stiffnesses change by up to a fifth, and with them which spheres take part in the mode.
    double worst = 1, sum = 0;
    constexpr std::uint64_t packings = 20;
    for (std::uint64_t k = 0; k < packings; ++k) {
        Simulation sim(random_packing(k, 0.5, 3.0), table());
        sim.compute_forces();
        FrequencyEstimator estimator;
        estimator.estimate(sim, 5, 8);
        std::vector<double> stiffness(sim.size()), friction(sim.size(), std::atan(0.5));
        for (std::size_t i = 0; i < sim.size(); ++i)
            stiffness[i] =
                sim.spheres().normal_stiffness[i] * (1 + 0.2 * random_vec(i, 99 + k).x());
        sim.change().set_properties(stiffness, friction);
        sim.compute_forces();
        const double ratio =
            estimator.estimate(sim, 1, 5) / FrequencyEstimator().estimate(sim, 8, 12);
        worst = std::min(worst, ratio);
        sum += ratio / packings;
        EXPECT_LE(ratio, 1.05) << k;
    }
    // Below 1 the step is too long by that; safety 0.8 leaves a quarter. On the mean neither the
    // last mode nor the residual that is added may be missing: each makes a quarter of a per cent
    // or more.
    EXPECT_GE(worst, 0.95);
    EXPECT_GE(sum, 0.9985);
    EXPECT_LE(sum, 1.004);
    RecordProperty("worst", std::to_string(worst));
    RecordProperty("mean", std::to_string(sum));
}

/// FCC block of `cells`^3 cubic cells, just touching more than not.
Scene fcc_block(int cells, double lambda) {
    const double a = 2 * std::sqrt(2.0) * test_radius * (1 - 1e-6);
    std::vector<Ball> balls;
    for (int i = 0; i < 2 * cells; ++i)
        for (int j = 0; j < 2 * cells; ++j)
            for (int k = 0; k < 2 * cells; ++k)
                if ((i + j + k) % 2 == 0) balls.push_back({.x = 0.5 * a * Vec3(i, j, k)});
    Scene scene = scene_of(balls, 0.5);
    scene.stiffness_ratio = lambda;
    return scene;
}

TEST_P(Frequency, FreeFccBlocksApproachTheInfiniteLatticeFromBelow) {
    const double kn = 0.5 * test_radius * test_stiffness, m = sphere_mass(test_radius);
    for (double lambda : {0.1, 0.8}) {
        const double bound = std::sqrt(m / kn) * std::min(1 / std::sqrt(2 * (1 + lambda)),
                                                          0.3162277660168379 / std::sqrt(lambda));
        double last = 0;
        for (int cells : {2, 4, 8}) {
            const double omega = estimate(fcc_block(cells, lambda), table());
            EXPECT_GT(2 / omega, bound * (1 - 1e-3)) << cells;
            EXPECT_GT(omega, last * 0.999);
            last = omega;
        }
        verify::record(
            {.scene = "Time step of an FCC lattice",
             .quantity = fmt::format("stability limit of 8^3 cells, lambda = {}", lambda),
             .closed_form = "sqrt(m/K_n) min(1/sqrt(2 (1 + lambda)), sqrt(0.1/lambda))",
             .source = "highest mode of the infinite lattice",
             .unit = "s",
             .tolerance = "a free block approaches it from above"},
            GetParam().name, bound, 2 / last, 0.03 * bound);
    }
}

GRAINFIELD_FOR_ALL_KERNELS(Frequency);

}  // namespace
}  // namespace grainfield::core
