// Local average subdivision, the default and the published one: conservation, errors, any grid.

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <omp.h>

#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "randomfield/generators/las_classic_generator.hpp"
#include "randomfield/generators/las_generator.hpp"
#include "randomfield/verification/field_error.hpp"
#include "tests/larger.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

GridSpec las_grid(const CellCount& cells, double edge = 0.25) {
    return {cells, Vec3(edge, edge, edge)};
}

std::vector<double> some_normals(std::size_t count) {
    std::vector<double> u(count);
    for (std::size_t i = 0; i < count; ++i) u[i] = std::cos(3.0 * static_cast<double>(i));
    return u;
}

// The mean of the children is the parent, in every stage, to the round-off of their sum.
template <class Las>
void expect_conservation(const CellCount& cells) {
    const Las las(las_grid(cells), paper_theta(0.3), 5);
    ASSERT_GE(las.subdivisions(), 2u);
    const auto fields = las.apply_stages(some_normals(las.normals()));
    ASSERT_EQ(fields.size(), las.subdivisions() + 1);
    for (std::size_t s = 1; s < fields.size(); ++s) {
        const GridSpec coarse{las.stage_cells(s - 1), {}};
        const GridSpec fine{las.stage_cells(s), {}};
        std::vector<double> sum(coarse.size(), 0.0);
        std::vector<int> children(coarse.size(), 0);
        for (std::int32_t k = 0; k < fine.cells[2]; ++k) {
            for (std::int32_t j = 0; j < fine.cells[1]; ++j) {
                for (std::int32_t i = 0; i < fine.cells[0]; ++i) {
                    const CellCount at{i, j, k};
                    CellCount p{};
                    for (std::size_t d = 0; d < 3; ++d) {
                        p[d] = fine.cells[d] == coarse.cells[d] ? at[d] : at[d] / 2;
                    }
                    sum[coarse.index(p[0], p[1], p[2])] += fields[s][fine.index(i, j, k)];
                    ++children[coarse.index(p[0], p[1], p[2])];
                }
            }
        }
        for (std::size_t p = 0; p < sum.size(); ++p) {
            if (children[p] < children[0]) continue;  // cut at the end of an odd direction
            EXPECT_NEAR(sum[p] / children[p], fields[s - 1][p], 1e-14);
        }
    }
    std::vector<double> field(fields.back().size());
    las.apply(some_normals(las.normals()), field);
    EXPECT_EQ(field, fields.back());
}

TEST(Las, ParentsAreTheMeansOfTheirChildren) {
    for (const CellCount& cells : {CellCount{12, 24, 12}, CellCount{8, 1, 8}, CellCount{16, 1, 1},
                                   CellCount{2, 32, 4}, CellCount{5, 7, 11}}) {
        expect_conservation<LasGenerator>(cells);
        expect_conservation<LasClassicGenerator>(cells);
    }
}

// From at most 54 cells to Tran et al.'s blocks at their five correlation lengths. Regression
// values, rounded up; what they replace is in OneSubdivisionHasTheKnownErrors.
TEST(Las, CovarianceErrorsOfThePapersFieldsAreSmall) {
    struct Row {
        double theta_y, from_54, from_12;
    };
    for (const Row& row :
         {Row{0.01, 0.0126, 0.0126}, Row{0.1, 0.0440, 0.0443}, Row{0.5, 0.0153, 0.0179},
          Row{1.0, 0.0077, 0.0197}, Row{10.0, 0.0015, 0.0045}}) {
        const Vec3 theta = paper_theta(row.theta_y);
        const LasGenerator one(GridSpec{}, theta, 54);
        EXPECT_EQ(one.stage_cells(0), (CellCount{2, 12, 2}));
        EXPECT_EQ(one.subdivisions(), 4u);
        const double error = covariance_error(one).covariance;
        EXPECT_LT(error, row.from_54) << row.theta_y;
        EXPECT_GT(error, 0.9 * row.from_54) << row.theta_y;
        EXPECT_LT(covariance_error(LasGenerator(GridSpec{}, theta, 12)).covariance, row.from_12)
            << row.theta_y;
    }
}

// Many stages: errors of the published algorithm grow to 0.6, these stay below 0.047.
TEST(Las, ErrorsStaySmallOverManyStages) {
    for (const double theta_y : {0.01, 0.1, 0.5, 1.0, 10.0}) {
        const LasGenerator las(las_grid({8, 16, 8}), paper_theta(theta_y), 8);
        EXPECT_EQ(las.subdivisions(), 7u);
        const CovarianceError error = covariance_error(las);
        EXPECT_LT(error.covariance, 0.047) << theta_y;
        EXPECT_LT(error.variance, 0.029) << theta_y;
        ASSERT_EQ(error.variances.size(), 1024u);
        double worst = 0.0;
        for (const double v : error.variances) worst = larger(worst, std::abs(v - 1.0));
        EXPECT_NEAR(worst, error.variance, 1e-14);
    }
}

// From 54 cells to Tran et al.'s blocks, over the correlation lengths where each is worst.
// Regression values, rounded up, as README.md has them.
TEST(Las, ErrorsOfEveryCorrelationModelAreThoseStated) {
    struct Row {
        Correlation kind;
        double from_54;   // at theta_y = 0.1, 0.3 m: the larger one
        CellCount cells;  // where the stated error is reached, with its stage 0 and theta_y
        std::int64_t stage0;
        double theta_y;
    };
    constexpr CellCount blocks{6, 12, 6}, halves{8, 16, 8};
    for (const Row& row : {Row{Correlation::markov, 0.0440, halves, 8, 0.1},
                           Row{Correlation::separable_markov, 0.1013, blocks, 1, 1.0},
                           Row{Correlation::gaussian, 0.0581, halves, 8, 0.1},
                           Row{Correlation::spherical, 0.0526, halves, 8, 0.1},
                           Row{Correlation::matern32, 0.0463, halves, 8, 0.1},
                           Row{Correlation::matern52, 0.0479, halves, 8, 0.1}}) {
        SCOPED_TRACE(name_of(row.kind));
        double worst = 0.0;
        for (const double theta_y : {0.1, 0.3}) {
            const CorrelationModel model(paper_theta(theta_y), row.kind);
            const double error = covariance_error(LasGenerator(GridSpec{}, model, 54)).covariance;
            EXPECT_LT(error,
                      0.5 * covariance_error(LasClassicGenerator(GridSpec{}, model, 54)).covariance)
                << theta_y;
            worst = larger(worst, error);
        }
        EXPECT_LT(worst, row.from_54);
        EXPECT_GT(worst, 0.99 * row.from_54);
        const LasGenerator las(las_grid(row.cells), {paper_theta(row.theta_y), row.kind},
                               row.stage0);
        const double error = covariance_error(las).covariance;
        EXPECT_LT(error, las.stated_error());
        EXPECT_GT(error, 0.9 * las.stated_error());
    }
}

// Grids that are not powers of two of anything are cut from larger ones; from 0.001 of a cell to
// 1e4 domains, with a stage 0 of one cell and more.
TEST(Las, AnyGridAndAnyCorrelationLength) {
    for (const CellCount& cells : {CellCount{5, 7, 3}, CellCount{8, 1, 8}, CellCount{7, 1, 1},
                                   CellCount{1, 1, 9}, CellCount{6, 12, 6}, CellCount{2, 2, 2}}) {
        for (const double theta_y : {2.5e-4, 0.1, 3e4}) {
            const Vec3 theta = paper_theta(theta_y);
            for (const std::int64_t stage0 : {1, 30}) {
                const LasGenerator las(las_grid(cells), theta, stage0);
                const CellCount first = las.stage_cells(0);
                EXPECT_LE(first[0] * first[1] * first[2], stage0);
                EXPECT_EQ(las.stage_cells(las.subdivisions()), cells);
                const CovarianceError error = covariance_error(las);
                // Regression values over all grids and stages 0, and 2 %.
                EXPECT_LT(error.covariance, theta_y < 1e-3  ? 7.3e-6
                                            : theta_y > 1e3 ? 2.9e-6
                                                            : 0.047)
                    << theta_y << " stage 0 " << stage0;
                const LasClassicGenerator classic(las_grid(cells), theta, stage0);
                EXPECT_LT(covariance_error(classic).covariance, theta_y < 1e-3  ? 3.4e-3
                                                                : theta_y > 1e3 ? 2.3e-5
                                                                                : 0.62);
            }
            const LasGenerator exact(las_grid(cells), theta, 1000);
            EXPECT_TRUE(exact.exact());
            EXPECT_LT(covariance_error(exact).covariance, 1e-12);
        }
    }
    const LasGenerator cell(las_grid({1, 1, 1}), paper_theta(1.0), 1);
    EXPECT_EQ(cell.subdivisions(), 0u);
    EXPECT_EQ(cell.normals(), 1u);
}

// One axis only: of an exponential correlation in 1-D halving knows all that matters.
TEST(Las, OneDimensionalMarkovFieldsAreNearlyExact) {
    for (const double theta : {0.1, 1.0, 10.0}) {
        const LasGenerator las(las_grid({1, 64, 1}), {Vec3(1e3, theta, 1e3)}, 1);
        EXPECT_EQ(las.subdivisions(), 6u);
        EXPECT_LT(covariance_error(las).covariance, 0.0225) << theta;
    }
}

// The default stage 0 is Fenton's: a fine grid starts from at most 512 cells. One normal a cell.
TEST(Las, FineGridsStartFromAtMost512Cells) {
    const LasGenerator las(las_grid({48, 96, 48}, 0.03125), paper_theta(1.0));
    EXPECT_EQ(las.stage_cells(0), (CellCount{3, 48, 3}));
    EXPECT_EQ(las.stage_cells(las.subdivisions()), (CellCount{48, 96, 48}));
    EXPECT_NE(input_error([&] { linear_map(las); }).find("8192"), std::string::npos);
    const LasClassicGenerator classic(las_grid({48, 96, 48}, 0.03125), paper_theta(1.0));
    EXPECT_EQ(classic.subdivisions(), 3u);
    EXPECT_EQ(classic.stage_cells(0), (CellCount{6, 12, 6}));
    EXPECT_EQ(classic.normals(), 48u * 96u * 48u);
}

// EXPECT_EQ on doubles: the same bits on any number of threads, a large grid being shared by them.
TEST(Las, DoesNotDependOnThreads) {
    const LasGenerator las(las_grid({48, 48, 48}, 0.03125), paper_theta(0.1));
    const std::vector<double> normals = some_normals(las.normals());
    std::vector<std::vector<double>> fields;
    const int before = omp_get_max_threads();
    for (const int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        fields.emplace_back(las.grid().size());
        las.apply(normals, fields.back());
    }
    omp_set_num_threads(before);
    EXPECT_EQ(fields[0], fields[1]);
    EXPECT_EQ(fields[0], fields[2]);
}

// Normals drawn row by row, where they are needed, are those drawn before: in slabs along either
// axis, on any number of threads, and where nothing is subdivided.
TEST(Las, DrawsTheFieldOfTheStreamsNormals) {
    const core::RandomStream random(3, core::Stream::field_friction);
    const int before = omp_get_max_threads();
    for (const CellCount& cells :
         {CellCount{48, 48, 48}, CellCount{100, 90, 10}, CellCount{9, 200, 30},
          CellCount{1, 1, 700}, CellCount{6, 12, 6}}) {
        const LasGenerator las(las_grid(cells, 0.03125), paper_theta(0.1));
        std::vector<double> normals(las.normals()), applied(las.grid().size());
        random.normals(8, 0, normals);
        las.apply(normals, applied);
        for (const int threads : {1, 2}) {
            omp_set_num_threads(threads);
            std::vector<double> drawn(applied.size());
            las.draw(random, 8, drawn);
            EXPECT_EQ(drawn, applied) << cells[0] << " " << threads;
        }
    }
    omp_set_num_threads(before);
}

// The same bits on every instruction set of this machine, normals and sums.
TEST(Las, DoesNotDependOnTheInstructionSet) {
    const LasGenerator las(las_grid({13, 24, 12}, 0.125), paper_theta(0.1), 54);
    std::vector<std::vector<double>> fields;
    const std::int64_t all = hwy::SupportedTargets();
    for (const std::int64_t target :
         {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_STATIC_TARGET}}) {
        if ((all & target) == 0) continue;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        std::vector<double> normals(las.normals());
        core::RandomStream(3, core::Stream::field_friction).normals(8, 0, normals);
        fields.emplace_back(las.grid().size());
        las.apply(normals, fields.back());
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    ASSERT_GE(fields.size(), 1u);
    for (const std::vector<double>& field : fields) EXPECT_EQ(field, fields.front());
}

TEST(Las, RefusesWhatCannotBe) {
    const auto refused = [](const CellCount& cells, const Vec3& theta) {
        return input_error([&] { LasGenerator(las_grid(cells), theta); });
    };
    EXPECT_NE(refused({0, 1, 1}, paper_theta(1.0)).find("[0, 1, 1]"), std::string::npos);
    EXPECT_NE(refused({2000, 2000, 2000}, paper_theta(1.0)).find("1e+09"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, Vec3(1, 0, 1)).find("field.correlation_length = [1, 0, 1]"),
              std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, Vec3(1, std::nan(""), 1)).find("nan"), std::string::npos);
    GridSpec flat;
    flat.cell_size[1] = 0.0;
    EXPECT_NE(input_error([&] { LasGenerator(flat, paper_theta(1.0)); }).find("cell size"),
              std::string::npos);
}

}  // namespace
}  // namespace grainfield::randomfield
