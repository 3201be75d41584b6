// Circulant embedding and Karhunen-Loeve modes: exact, or refused with the numbers.

#include "randomfield/generators/circulant_generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "core/base/random.hpp"
#include "randomfield/generators/modes.hpp"
#include "randomfield/verification/field_error.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

using testing::HasSubstr;

GridSpec torus_grid(const CellCount& cells) {
    return {cells, Vec3(0.25, 0.25, 0.25)};
}

// M M^T itself, unit normal by unit normal, against C; and the short cut through the spectrum.
TEST(Circulant, IsExactForGridsOfAnyShape) {
    for (const CellCount& cells : {CellCount{1, 1, 1}, CellCount{7, 1, 1}, CellCount{1, 9, 5},
                                   CellCount{5, 4, 3}, CellCount{2, 6, 2}}) {
        for (const Correlation kind :
             {Correlation::markov, Correlation::separable_markov, Correlation::gaussian,
              Correlation::spherical, Correlation::matern32, Correlation::matern52}) {
            const CirculantGenerator generator(torus_grid(cells), {Vec3(0.3, 0.2, 0.4), kind});
            const Eigen::MatrixXd map = linear_map(generator);
            const Eigen::MatrixXd error =
                map * map.transpose() - exact_covariance(generator.grid(), generator.correlation());
            EXPECT_LT(error.cwiseAbs().maxCoeff() / generator.gamma(), 1e-11) << name_of(kind);
            EXPECT_LT(covariance_error(generator).covariance, 1e-11) << name_of(kind);
            EXPECT_TRUE(generator.exact());
        }
    }
}

TEST(Circulant, PeriodsGrowUntilNoEigenvalueIsNegative) {
    const CirculantGenerator near(GridSpec{}, paper_theta(0.01));
    EXPECT_EQ(near.period(), (CellCount{10, 24, 10}));  // 2 (n - 1), or the next fast size
    EXPECT_LT(covariance_error(near).covariance, 1e-14);
    const CirculantGenerator far(GridSpec{}, paper_theta(0.5));
    EXPECT_GT(far.period()[0], 100);
    EXPECT_LT(covariance_error(far).covariance, 1e-14);
}

TEST(Circulant, NegativeEigenvaluesAreRefusedWithTheirSize) {
    const std::string message = input_error([] {
        CirculantGenerator(torus_grid({8, 8, 1}), {Vec3(3e3, 3e3, 3e3), Correlation::gaussian});
    });
    EXPECT_THAT(message, HasSubstr("field.method = \"circulant\""));
    EXPECT_THAT(message, HasSubstr("field.correlation_length = [3000, 3000, 3000]"));
    EXPECT_THAT(message, HasSubstr("the most negative one is -"));
    EXPECT_THAT(message, HasSubstr("gamma"));
    EXPECT_THAT(input_error([] {
                    CirculantGenerator(torus_grid({600, 600, 600}), {Vec3(1, 1, 1)});
                }),
                HasSubstr("at most 33554432 are allowed; lower packing.blocks"));
}

// The limit is named, and correlation lengths as long as the message says are indeed possible.
TEST(Circulant, RefusalsNameCorrelationLengthsThatWouldDo) {
    const auto refusal = [](double theta) {
        return input_error([&] {
            CirculantGenerator(torus_grid({40, 40, 40}),
                               CorrelationModel(Vec3(theta, theta, theta)), 1 << 22);
        });
    };
    const std::string message = refusal(25.0);  // of cells of 0.25 m
    EXPECT_THAT(message, HasSubstr("more than the 4194304 cells that are allowed"));
    EXPECT_THAT(
        message,
        HasSubstr("periods of 12 correlation lengths fit up to about [3.33, 3.33, 3.33] m"));
    EXPECT_EQ(refusal(3.33), "");
}

// Expected equality of doubles: the same bits on any number of threads.
TEST(Circulant, DoesNotDependOnThreads) {
    const CirculantGenerator generator(torus_grid({24, 24, 24}), paper_theta(0.1));
    std::vector<double> normals(generator.normals());
    core::RandomStream(1, core::Stream::field_friction).normals(0, 0, normals);
    std::vector<std::vector<double>> fields;
    const int before = omp_get_max_threads();
    for (const int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        fields.emplace_back(generator.grid().size());
        generator.apply(normals, fields.back());
    }
    omp_set_num_threads(before);
    EXPECT_EQ(fields[0], fields[1]);
    EXPECT_EQ(fields[0], fields[2]);
}

TEST(Modes, DiagonalizeTheCovariance) {
    for (const double theta_y : {0.1, 1.0}) {
        const GridSpec grid = torus_grid({4, 6, 3});
        const KarhunenLoeveModes modes = karhunen_loeve_modes(grid, paper_theta(theta_y));
        const Eigen::MatrixXd c = exact_covariance(grid, paper_theta(theta_y));
        const Eigen::Index n = c.rows();
        // Sorted, of unit length, orthogonal, and together C: round-off of an eigensolver.
        for (Eigen::Index m = 1; m < n; ++m) EXPECT_LE(modes.variance[m], modes.variance[m - 1]);
        EXPECT_LT((modes.shape.transpose() * modes.shape - Eigen::MatrixXd::Identity(n, n)).norm(),
                  1e-12);
        const Eigen::MatrixXd rebuilt =
            modes.shape * modes.variance.asDiagonal() * modes.shape.transpose();
        EXPECT_LT((rebuilt - c).cwiseAbs().maxCoeff(), 1e-13 * modes.variance[0]);
        // The trace: n gamma.
        EXPECT_NEAR(modes.variance.sum(), static_cast<double>(n) * c(0, 0),
                    1e-12 * c(0, 0) * static_cast<double>(n));
        EXPECT_NEAR(modes.share(n), 1.0, 1e-14);
        EXPECT_GT(modes.share(10), modes.share(9));
        // Signs: the first of the largest entries is positive; the first mode has one sign.
        for (Eigen::Index m = 0; m < n; ++m) {
            EXPECT_GE(modes.shape.col(m).maxCoeff(), (1.0 - 2e-9) * -modes.shape.col(m).minCoeff());
        }
        EXPECT_GT(modes.shape.col(0).minCoeff(), 0.0);
    }
    EXPECT_THAT(input_error([] {
                    karhunen_loeve_modes(torus_grid({50, 50, 50}), Vec3(1, 1, 1));
                }),
                HasSubstr("at most 2048"));
}

}  // namespace
}  // namespace grainfield::randomfield
