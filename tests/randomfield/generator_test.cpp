// The generators as linear maps: covariances without sampling.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "randomfield/covariance/covariance.hpp"
#include "randomfield/generators/cholesky_generator.hpp"
#include "randomfield/generators/las_classic_generator.hpp"
#include "randomfield/generators/las_generator.hpp"
#include "randomfield/verification/field_error.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

GridSpec grid_of(std::int32_t nx, std::int32_t ny, std::int32_t nz) {
    GridSpec grid;
    grid.cells = {nx, ny, nz};
    return grid;
}

TEST(Covariance, MatrixOfTheBlocksIsPositiveDefinite) {
    for (const double theta_y : {0.01, 0.1, 0.5, 1.0, 10.0}) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
            exact_covariance(GridSpec{}, paper_theta(theta_y)), Eigen::EigenvaluesOnly);
        EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0) << theta_y;
    }
}

TEST(LowerFactor, IsTheCholeskyFactorAcrossTiles) {
    for (const Eigen::Index n : {1, 2, 31, 32, 33, 64, 100}) {
        const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n + 3);
        const Eigen::MatrixXd c = a * a.transpose();
        const auto size = static_cast<std::size_t>(n);
        const auto factor = LowerFactor::of({c.data(), c.data() + n * n}, size);
        ASSERT_TRUE(factor);
        EXPECT_EQ(factor->nugget(), 0.0);
        Eigen::MatrixXd l(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) {
                l(i, j) = (*factor)(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
            }
        }
        EXPECT_TRUE(l.isLowerTriangular(0.0));
        // Backward error of Cholesky: (n + 1) eps.
        EXPECT_LT((l * l.transpose() - c).cwiseAbs().maxCoeff(), 2e-14 * c.cwiseAbs().maxCoeff());

        const Eigen::VectorXd x = Eigen::VectorXd::Random(n);
        Eigen::VectorXd y = l * (l.transpose() * x);
        factor->solve_lower({y.data(), size});
        factor->solve_upper({y.data(), size});
        EXPECT_LT((c * (y - x)).norm(), 1e-12 * (c * x).norm());
    }
}

TEST(LowerFactor, SingularMatricesGetTheSmallestNuggetAndIndefiniteOnesNone) {
    // Rank one: a correlation length of infinity.
    const auto constant = LowerFactor::of(std::vector<double>(25, 4.0), 5);
    ASSERT_TRUE(constant);
    EXPECT_GT(constant->nugget(), 0.0);
    EXPECT_LE(constant->nugget(), 3e-13);
    for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t j = 0; j < 5; ++j) {
            double sum = 0.0;
            for (std::size_t k = 0; k < 5; ++k) sum += (*constant)(i, k) * (*constant)(j, k);
            EXPECT_NEAR(sum, 4.0, 4.0 * 4e-13);
        }
    }
    EXPECT_FALSE(LowerFactor::of({1.0, 2.0, 2.0, 1.0}, 2));
    EXPECT_FALSE(LowerFactor::of({0.0}, 1));
    EXPECT_FALSE(LowerFactor::of({std::nan("")}, 1));
    EXPECT_FALSE(LowerFactor::of({1.0, std::nan(""), std::nan(""), 1.0}, 2));
}

struct Case {
    CellCount cells;
    Vec3 theta;
};

// Any grid, any correlation length from 0.001 of a cell to 1e4 domains, isotropic or not.
TEST(Cholesky, IsExactForAnyGridAndCorrelationLength) {
    for (const CellCount& cells : {CellCount{6, 12, 6}, CellCount{1, 1, 1}, CellCount{5, 7, 3},
                                   CellCount{8, 1, 8}, CellCount{7, 1, 1}}) {
        const GridSpec grid{cells, Vec3(0.25, 0.25, 0.25)};
        for (const Vec3& theta :
             {paper_theta(2.5e-4), paper_theta(0.01), paper_theta(1.0), Vec3(3e4, 3e4, 3e4),
              paper_theta(3e4), Vec3(3e4, 0.1, 3e4), Vec3(1e-3, 3e4, 2.0), Vec3(3e4, 0.3, 0.3)}) {
            const LasGenerator generator(grid, theta);
            ASSERT_EQ(generator.subdivisions(), 0u);
            const CovarianceError error = covariance_error(generator);
            EXPECT_LT(error.covariance, 1e-12) << theta.transpose();
        }
    }
}

TEST(Cholesky, RefusesWhatDoesNotFit) {
    const std::string message =
        input_error([] { CholeskyGenerator(grid_of(100, 100, 100), paper_theta(1.0)); });
    EXPECT_NE(message.find("1000000"), std::string::npos) << message;
    EXPECT_NE(message.find("at most 16384"), std::string::npos) << message;
    EXPECT_NE(message.find("field.stage0_cells"), std::string::npos) << message;
    // A cell's variance below the smallest double: white noise of nothing.
    EXPECT_NE(input_error([] {
                  CholeskyGenerator(GridSpec{}, Vec3(1e-150, 1e-150, 1e-150));
              }).find("field.correlation_length"),
              std::string::npos);
}

TEST(Las, WithoutSubdivisionIsTheExactFactor) {
    const LasGenerator las(GridSpec{}, paper_theta(1.0));
    const CholeskyGenerator exact(GridSpec{}, paper_theta(1.0));
    ASSERT_EQ(las.subdivisions(), 0u);
    ASSERT_EQ(las.normals(), exact.normals());
    std::vector<double> u(432), a(432), b(432);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::sin(1.0 + static_cast<double>(i));
    las.apply(u, a);
    exact.apply(u, b);
    EXPECT_EQ(a, b);
}

// docs/method.md, section 5.3: 3 x 6 x 3 -> 6 x 12 x 6 at Tran et al.'s anisotropy.
TEST(LasClassic, OneSubdivisionHasTheKnownErrors) {
    struct Row {
        double theta_y, error;
    };
    for (const Row& row :
         {Row{0.01, 0.145}, Row{0.1, 0.396}, Row{0.5, 0.201}, Row{1.0, 0.112}, Row{10.0, 0.012}}) {
        const LasClassicGenerator las(GridSpec{}, paper_theta(row.theta_y), 54);
        ASSERT_EQ(las.subdivisions(), 1u);
        EXPECT_EQ(las.stage_cells(0), (CellCount{3, 6, 3}));
        EXPECT_EQ(las.normals(), 432u);
        const CovarianceError error = covariance_error(las);
        EXPECT_NEAR(error.covariance, row.error, 0.5e-3) << row.theta_y;  // the last digit known
        // After one split the variances are exact: round-off of sums over 27 parents.
        EXPECT_LT(error.variance, 1e-12) << row.theta_y;
    }
}

// Within one parent and one split everything is exact, the child made by conservation included.
TEST(LasClassic, SiblingsAreExactAfterOneSubdivision) {
    const Vec3 theta = paper_theta(0.5);
    const LasClassicGenerator las(GridSpec{}, theta, 54);
    const Eigen::MatrixXd map = linear_map(las);
    const Eigen::MatrixXd error = map * map.transpose() - exact_covariance(GridSpec{}, theta);
    const GridSpec grid;
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            const auto row = grid.index(2 + (a & 1), 4 + (a >> 1 & 1), 2 + (a >> 2));
            const auto column = grid.index(2 + (b & 1), 4 + (b >> 1 & 1), 2 + (b >> 2));
            EXPECT_LT(
                std::abs(error(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column))),
                1e-12);
        }
    }
}

}  // namespace
}  // namespace grainfield::randomfield
