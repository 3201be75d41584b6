// Draws: reproducible, distributed as they should be, mapped to spheres.

#include "randomfield/block_field.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <initializer_list>
#include <thread>

#include "tests/larger.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

FieldOptions options_of(Variable variable, double theta_y = 1.0) {
    FieldOptions options;
    options.variable = variable;
    options.correlation_length = paper_theta(theta_y);
    options.seed = 20240607;
    return options;
}

void expect_same(const BlockField& a, const BlockField& b) {
    EXPECT_EQ(a.G, b.G);
    EXPECT_EQ(a.G_stiffness, b.G_stiffness);
    EXPECT_EQ(a.friction_angle, b.friction_angle);
    EXPECT_EQ(a.normal_stiffness, b.normal_stiffness);
}

// EXPECT_EQ on doubles: bit for bit, in any order, on any number of threads, from any generator.
TEST(BlockField, DrawsDependOnSeedAndRealizationOnly) {
    GridSpec fine;
    fine.cells = {48, 96, 48};  // large enough for the generator's own threads
    for (const GridSpec& grid : {GridSpec{}, fine}) {
        const FieldGenerator generator(grid, options_of(Variable::both));
        std::vector<BlockField> serial;
        serial.reserve(4);
        for (std::uint64_t k = 0; k < 4; ++k) serial.push_back(generator.draw(k));
        for (const int count : {1, 2, 4}) {
            std::vector<BlockField> parallel(4);
            std::vector<std::thread> threads;
            threads.reserve(static_cast<std::size_t>(count));
            for (int t = 0; t < count; ++t) {
                threads.emplace_back([&, t] {
                    for (int k = 3 - t; k >= 0; k -= count) {
                        parallel[static_cast<std::size_t>(k)] =
                            generator.draw(static_cast<std::uint64_t>(k));
                    }
                });
            }
            for (std::thread& thread : threads) thread.join();
            for (std::size_t k = 0; k < 4; ++k) expect_same(parallel[k], serial[k]);
        }
        expect_same(FieldGenerator(grid, options_of(Variable::both)).draw(2), serial[2]);
        EXPECT_NE(serial[0].G, serial[1].G);
    }
    FieldOptions other = options_of(Variable::both);
    ++other.seed;
    EXPECT_NE(FieldGenerator(GridSpec{}, other).draw(0).G,
              FieldGenerator(GridSpec{}, options_of(Variable::both)).draw(0).G);
}

TEST(BlockField, HoldsTheColumnsThatAreRandom) {
    const BlockField none = FieldGenerator(GridSpec{}, options_of(Variable::none)).draw(3);
    const BlockField friction = FieldGenerator(GridSpec{}, options_of(Variable::friction)).draw(3);
    const BlockField stiffness =
        FieldGenerator(GridSpec{}, options_of(Variable::stiffness)).draw(3);
    const BlockField both = FieldGenerator(GridSpec{}, options_of(Variable::both)).draw(3);
    EXPECT_EQ(none.G.size(), 432u);
    EXPECT_TRUE(none.friction_angle.empty() && none.normal_stiffness.empty());
    EXPECT_TRUE(friction.normal_stiffness.empty() && friction.G_stiffness.empty());
    EXPECT_TRUE(stiffness.friction_angle.empty() && stiffness.G_stiffness.empty());
    // Each the same alone or with the other, and the two not the same field.
    EXPECT_EQ(both.G, friction.G);
    EXPECT_EQ(both.G_stiffness, stiffness.G);
    EXPECT_EQ(both.friction_angle, friction.friction_angle);
    EXPECT_EQ(both.normal_stiffness, stiffness.normal_stiffness);
    EXPECT_NE(both.G, both.G_stiffness);
    const Marginal angle(FieldOptions().friction, 1.0);
    for (std::size_t c = 0; c < 432; ++c) {
        EXPECT_EQ(both.friction_angle[c], angle(both.G[c]));
        EXPECT_GT(both.normal_stiffness[c], 0.0);
    }
}

TEST(BlockField, MethodsAgreeWhereNothingIsSubdivided) {
    FieldOptions exact = options_of(Variable::stiffness);
    exact.method = Method::cholesky;
    const FieldGenerator a(GridSpec{}, exact);
    const FieldGenerator b(GridSpec{}, options_of(Variable::stiffness));
    expect_same(a.draw(7), b.draw(7));
    EXPECT_LT(a.covariance_error(), 1e-12);
    EXPECT_NEAR(a.gamma(), 0.847760867523, 1e-12);
    EXPECT_NEAR(a.stiffness_mean_ratio(), std::exp(-std::log(1.64) * (1.0 - a.gamma()) / 2.0),
                1e-14);

    FieldOptions subdivided = options_of(Variable::stiffness);
    subdivided.stage0_cells = 54;
    EXPECT_LT(FieldGenerator(GridSpec{}, subdivided).covariance_error(), 0.008);
    subdivided.method = Method::las_classic;
    EXPECT_NEAR(FieldGenerator(GridSpec{}, subdivided).covariance_error(), 0.112, 0.5e-3);
}

// The sum of squares of the draws whitened by an independent factor is chi-squared; every single
// sample covariance has a known spread. Significance 1e-6 each. With and without a subdivision,
// each against its own M M^T.
TEST(BlockField, SampleCovarianceIsThatOfTheField) {
    const int draws = 4000;
    for (const std::int64_t stage0 : {512, 54}) {
        FieldOptions options = options_of(Variable::friction, 0.5);
        options.stage0_cells = stage0;
        const FieldGenerator generator(GridSpec{}, options);
        const Eigen::MatrixXd map = linear_map(generator.generator());
        const Eigen::MatrixXd covariance = map * map.transpose();
        const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
        ASSERT_EQ(llt.info(), Eigen::Success);

        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(432, 432);
        Eigen::VectorXd mean = Eigen::VectorXd::Zero(432);
        double chi2 = 0.0;
        for (int k = 0; k < draws; ++k) {
            const BlockField field = generator.draw(static_cast<std::uint64_t>(k));
            const Eigen::Map<const Eigen::VectorXd> g(field.G.data(), 432);
            chi2 += llt.matrixL().solve(g).squaredNorm();
            sum.selfadjointView<Eigen::Lower>().rankUpdate(g);
            mean += g;
        }
        const boost::math::chi_squared total(432.0 * draws);
        EXPECT_GT(chi2, quantile(total, 1e-6));
        EXPECT_LT(chi2, quantile(complement(total, 1e-6)));

        // Means: N(0, C_aa / n). Covariances: variance (C_aa C_bb + C_ab^2) / n, near to normal at
        // n = 4000. Largest of m such at 1e-6 by Bonferroni: 6.0 of 432, 6.9 of 93,528 (+ 0.1 for
        // the chi-squared's tail).
        double worst_mean = 0.0, worst_covariance = 0.0;
        for (Eigen::Index a = 0; a < 432; ++a) {
            worst_mean =
                larger(worst_mean, std::abs(mean[a]) / std::sqrt(draws * covariance(a, a)));
            for (Eigen::Index b = 0; b <= a; ++b) {
                const double spread = std::sqrt(
                    (covariance(a, a) * covariance(b, b) + covariance(a, b) * covariance(a, b)) /
                    draws);
                worst_covariance = std::max(
                    worst_covariance, std::abs(sum(a, b) / draws - covariance(a, b)) / spread);
            }
        }
        EXPECT_LT(worst_mean, 6.2);
        EXPECT_LT(worst_covariance, 7.0);
        EXPECT_GT(worst_covariance, 2.0);  // and not all the same number either
    }
}

// Friction and stiffness are uncorrelated (paper): mean product of one cell over realizations
// against its standard error; 4.9 is a significance of 1e-6.
TEST(BlockField, FrictionAndStiffnessAreUncorrelated) {
    const FieldGenerator generator(GridSpec{}, options_of(Variable::both, 10.0));
    double sum = 0.0, square = 0.0;
    const int draws = 2000;
    for (int k = 0; k < draws; ++k) {
        const BlockField field = generator.draw(static_cast<std::uint64_t>(k));
        const double product = field.G[200] * field.G_stiffness[200];
        sum += product;
        square += product * product;
    }
    EXPECT_LT(std::abs(sum) / std::sqrt(square), 4.9);
}

// G_stiffness = rho G_friction + sqrt(1 - rho^2) G' with the G' of the stiffness alone.
TEST(BlockField, CrossCorrelationMixesTheTwoFields) {
    FieldOptions options = options_of(Variable::both);
    const BlockField plain = FieldGenerator(GridSpec{}, options).draw(4);
    for (const double rho : {0.6, -0.3, 1.0, -1.0}) {
        options.cross_correlation = rho;
        const BlockField mixed = FieldGenerator(GridSpec{}, options).draw(4);
        EXPECT_EQ(mixed.G, plain.G);
        for (std::size_t c = 0; c < 432; ++c)
            EXPECT_NEAR(mixed.G_stiffness[c],
                        rho * plain.G[c] + std::sqrt(1.0 - rho * rho) * plain.G_stiffness[c],
                        1e-15);
    }
}

// The mean product of the two fields in a cell against rho gamma; 4.9 is a significance of 1e-6.
TEST(BlockField, CrossCorrelationIsTheOneAskedFor) {
    FieldOptions options = options_of(Variable::both, 10.0);
    options.cross_correlation = -0.7;
    const FieldGenerator generator(GridSpec{}, options);
    double sum = 0.0, square = 0.0;
    const int draws = 2000;
    for (int k = 0; k < draws; ++k) {
        const BlockField field = generator.draw(static_cast<std::uint64_t>(k));
        const double off = field.G[200] * field.G_stiffness[200] + 0.7 * generator.gamma();
        sum += off;
        square += off * off;
    }
    EXPECT_LT(std::abs(sum) / std::sqrt(square), 4.9);
}

// A seed must mean the same field for ever. Regression values, not analytic ones; the tolerance
// leaves room for another libm only (compilers and threads agree to the last bit).
TEST(BlockField, SeedsKeepTheirMeaning) {
    struct Value {
        std::size_t cell;
        double g, friction, stiffness;
    };
    const auto check = [](const BlockField& field, std::initializer_list<Value> values) {
        for (const Value& value : values) {
            EXPECT_NEAR(field.G[value.cell], value.g, 1e-12);
            EXPECT_NEAR(field.friction_angle[value.cell], value.friction, 1e-12);
            EXPECT_NEAR(field.normal_stiffness[value.cell], value.stiffness,
                        1e-12 * value.stiffness);
        }
    };
    FieldOptions options;
    options.variable = Variable::both;
    check(FieldGenerator(GridSpec{}, options).draw(0),
          {{0, -0.85863141117656971, 0.51998912832842503, 823881335.60257852},
           {200, -0.025202383880071955, 0.59759340124214833, 1064994078.8030895},
           {431, -0.47146367499915687, 0.55531350131889479, 1148275895.1493833}});
    options.stage0_cells = 54;
    options.method = Method::las_classic;
    check(FieldGenerator(GridSpec{}, options).draw(9),
          {{0, -0.60678625198228775, 0.54276612823620607, 159736425.32564113},
           {200, 1.2462040284972933, 0.71313115795421234, 1712994654.4777341},
           {431, -0.34378332692189223, 0.5673015261334744, 1547704636.9037271}});
}

TEST(BlockField, MapsCellsToSpheres) {
    const std::vector<double> column{1.0, 2.0, 3.0};
    const std::vector<std::size_t> cell{2, 0, 2, 1};
    std::vector<double> sphere(4, 9.0);
    BlockField::map({}, cell, sphere);
    EXPECT_EQ(sphere, (std::vector<double>{9.0, 9.0, 9.0, 9.0}));
    BlockField::map(column, cell, sphere);
    EXPECT_EQ(sphere, (std::vector<double>{3.0, 1.0, 3.0, 2.0}));
}

}  // namespace
}  // namespace grainfield::randomfield
