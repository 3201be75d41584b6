// Conditioning on known values by exact algebra: it is affine in the fields and the errors, so the
// mean and the covariance of what it makes follow without sampling.

#include "randomfield/conditioning/conditioning.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "randomfield/verification/field_error.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Known {
    GridSpec grid{{3, 4, 2}, Vec3(0.25, 0.25, 0.25)};
    double theta_y = 0.5;
    double rho = 0.6;
    std::vector<CellDatum> data{{friction, 3, 1.1, 0.0},
                                {friction, 20, -0.4, 0.05},
                                {stiffness, 3, -0.8, 0.3},
                                {stiffness, 17, 2.0, 0.0}};

    [[nodiscard]] Conditioning conditioning() const {
        return {grid, LocalAverageCovariance(grid.cell_size, paper_theta(theta_y), grid.cells), rho,
                data};
    }
    [[nodiscard]] Eigen::Index row(const CellDatum& datum) const {
        return static_cast<Eigen::Index>(datum.cell +
                                         (datum.property == stiffness ? grid.size() : 0));
    }
    /// Covariance of both fields in one vector, friction first.
    [[nodiscard]] MatrixXd joint() const {
        const MatrixXd c = exact_covariance(grid, paper_theta(theta_y));
        const Eigen::Index n = c.rows();
        MatrixXd k(2 * n, 2 * n);
        k << c, rho * c, rho * c, c;
        return k;
    }
};

VectorXd applied(const Conditioning& conditioning, const VectorXd& fields, const VectorXd& errors) {
    VectorXd result = fields;
    const auto n = static_cast<std::size_t>(fields.size() / 2);
    conditioning.apply({result.data(), n}, {result.data() + n, n},
                       {errors.data(), static_cast<std::size_t>(errors.size())});
    return result;
}

/// G_c = offset + of_fields G + of_errors e.
struct Affine {
    VectorXd offset;
    MatrixXd of_fields, of_errors;

    Affine(const Conditioning& conditioning, Eigen::Index size) {
        const auto m = static_cast<Eigen::Index>(conditioning.data().size());
        const VectorXd none = VectorXd::Zero(size), exact = VectorXd::Zero(m);
        offset = applied(conditioning, none, exact);
        of_fields.resize(size, size);
        of_errors.resize(size, m);
        for (Eigen::Index c = 0; c < size; ++c)
            of_fields.col(c) = applied(conditioning, VectorXd::Unit(size, c), exact) - offset;
        for (Eigen::Index c = 0; c < m; ++c)
            of_errors.col(c) = applied(conditioning, none, VectorXd::Unit(m, c)) - offset;
    }
};

// Against the joint normal distribution in closed form, with matrices made independently:
//   mean K A^T S^-1 d, covariance K - K A^T S^-1 A K, S = A K A^T + R.
TEST(Conditioning, MeanAndCovarianceAreThoseOfTheJointNormal) {
    for (const double rho : {0.6, -0.95, 0.0}) {
        Known known;
        known.rho = rho;
        const MatrixXd k = known.joint();
        const auto m = static_cast<Eigen::Index>(known.data.size());
        MatrixXd a = MatrixXd::Zero(m, k.rows());
        VectorXd d(m), r(m);
        for (Eigen::Index i = 0; i < m; ++i) {
            const CellDatum& datum = known.data[static_cast<std::size_t>(i)];
            a(i, known.row(datum)) = 1.0;
            d[i] = datum.score;
            r[i] = datum.variance;
        }
        const MatrixXd s = a * k * a.transpose() + MatrixXd(r.asDiagonal());
        const MatrixXd gain = k * a.transpose() * s.inverse();
        const VectorXd mean = gain * d;
        const MatrixXd covariance = k - gain * a * k;

        const Conditioning conditioning = known.conditioning();
        const Affine map(conditioning, k.rows());
        // Sums of some tens of numbers of size 1.
        EXPECT_LT((map.offset - mean).cwiseAbs().maxCoeff(), 1e-13);
        const MatrixXd sampled = map.of_fields * k * map.of_fields.transpose() +
                                 map.of_errors * map.of_errors.transpose();
        EXPECT_LT((sampled - covariance).cwiseAbs().maxCoeff(), 1e-13);

        for (const Property property : {friction, stiffness}) {
            const Eigen::Index first = property == friction ? 0 : k.rows() / 2;
            const std::vector<double> means = conditioning.mean(property);
            const std::vector<double> variances = conditioning.variance(property);
            for (std::size_t c = 0; c < means.size(); ++c) {
                const auto at = first + static_cast<Eigen::Index>(c);
                EXPECT_NEAR(means[c], mean[at], 1e-13);
                EXPECT_NEAR(variances[c], covariance(at, at), 1e-13);
            }
        }
        // A datum on one property informs the other where they are correlated, and only then.
        const double other = std::abs(mean[known.row({stiffness, 20, 0.0, 0.0})]);
        if (rho == 0.0) known.data = {{friction, 3, 1.1, 0.0}};
        const std::vector<double> alone = known.conditioning().mean(stiffness);
        if (rho == 0.0) {
            for (const double x : alone) EXPECT_EQ(x, 0.0);
        } else {
            EXPECT_GT(other, 0.01);
        }
    }
}

TEST(Conditioning, ExactValuesComeBackToRoundOff) {
    // Down a whole column of Tran et al.'s blocks, from nearly independent to nearly the same.
    const GridSpec grid;
    for (const double theta_y : {0.01, 0.5, 10.0, 1000.0}) {
        std::vector<CellDatum> data;
        for (std::int32_t j = 0; j < 12; ++j)
            data.push_back({friction, grid.index(2, j, 3), std::sin(j), 0.0});
        const Conditioning conditioning(
            grid, LocalAverageCovariance(grid.cell_size, paper_theta(theta_y), grid.cells), 0.0,
            data);
        std::vector<double> field(grid.size());
        for (std::size_t c = 0; c < field.size(); ++c)
            field[c] = std::cos(0.7 * static_cast<double>(c));
        const std::vector<double> errors(data.size(), 9.0);  // exact values have none
        conditioning.apply(field, {}, errors);
        const std::vector<double> variance = conditioning.variance(friction);
        for (const CellDatum& datum : data) {
            EXPECT_NEAR(field[datum.cell], datum.score, 1e-12) << theta_y;
            EXPECT_LT(variance[datum.cell], 1e-12) << theta_y;
        }
    }
}

// What exact values of a column do to all other cells, from nearly independent to nearly the same:
// mean and covariance are those of the Schur complement, by Eigen. apply() sets the known cells
// themselves, so they say nothing here.
TEST(Conditioning, ExactValuesInformTheOtherCellsByTheSchurComplement) {
    const GridSpec grid{{3, 4, 2}, Vec3(0.25, 0.25, 0.25)};
    for (const double theta_y : {0.01, 0.5, 10.0, 1000.0}) {
        std::vector<CellDatum> data;
        std::vector<Eigen::Index> known, others;
        for (std::int32_t j = 0; j < 4; ++j)
            data.push_back({friction, grid.index(1, j, 1), std::sin(j), 0.0});
        for (const CellDatum& datum : data) known.push_back(static_cast<Eigen::Index>(datum.cell));
        for (Eigen::Index c = 0; c < 24; ++c)
            if (std::find(known.begin(), known.end(), c) == known.end()) others.push_back(c);
        const MatrixXd k = exact_covariance(grid, paper_theta(theta_y));
        VectorXd d(4);
        for (Eigen::Index i = 0; i < 4; ++i) d[i] = data[static_cast<std::size_t>(i)].score;
        const Eigen::LLT<MatrixXd> factor(MatrixXd(k(known, known)));
        const MatrixXd gain = factor.solve(MatrixXd(k(known, others))).transpose();
        const VectorXd mean = gain * d;
        const MatrixXd covariance = k(others, others) - gain * k(known, others);

        const Conditioning conditioning(
            grid, LocalAverageCovariance(grid.cell_size, paper_theta(theta_y), grid.cells), 0.0,
            data);
        // G_c = offset + map G, of the friction alone.
        const auto made = [&](const VectorXd& field) {
            VectorXd result = field;
            const std::vector<double> none(data.size(), 0.0);
            conditioning.apply({result.data(), 24}, {}, none);
            return result;
        };
        const VectorXd offset = made(VectorXd::Zero(24));
        MatrixXd map(24, 24);
        for (Eigen::Index c = 0; c < 24; ++c) map.col(c) = made(VectorXd::Unit(24, c)) - offset;
        const MatrixXd drawn = map * k * map.transpose();
        // Round-off of two factors of a matrix whose condition number grows with theta: 4e4 at
        // 1,000 m.
        const double tolerance = theta_y > 100.0 ? 1e-10 : 1e-12;
        EXPECT_LT((offset(others) - mean).cwiseAbs().maxCoeff(), tolerance) << theta_y;
        EXPECT_LT((drawn(others, others) - covariance).cwiseAbs().maxCoeff(), tolerance) << theta_y;
        const std::vector<double> means = conditioning.mean(friction);
        const std::vector<double> variances = conditioning.variance(friction);
        for (std::size_t i = 0; i < others.size(); ++i) {
            const auto c = static_cast<std::size_t>(others[i]);
            const auto at = static_cast<Eigen::Index>(i);
            EXPECT_NEAR(means[c], mean[at], tolerance) << theta_y;
            EXPECT_NEAR(variances[c], covariance(at, at), tolerance) << theta_y;
        }
    }
}

// With one datum of error variance r the field there has variance C r / (C + r) and mean
// C d / (C + r): known without any matrix.
TEST(Conditioning, OneDatumIsWeighedByItsError) {
    Known known;
    const double c = known.joint()(0, 0);
    for (const double r : {1e-6, 0.3, 1e6}) {
        known.data = {{friction, 7, 1.5, r}};
        const Conditioning conditioning = known.conditioning();
        EXPECT_NEAR(conditioning.mean(friction)[7], c * 1.5 / (c + r), 1e-14);
        EXPECT_NEAR(conditioning.variance(friction)[7], c * r / (c + r), 1e-14);
        EXPECT_NEAR(conditioning.mean(stiffness)[7], 0.6 * c * 1.5 / (c + r), 1e-14);
    }
}

TEST(Conditioning, RefusesWhatFollowsFromOtherValues) {
    Known known;
    known.rho = 1.0;
    known.data = {{friction, 3, 0.2, 0.0, 0.5, 2},
                  {friction, 7, 1.5, 0.0, 0.8, 3},
                  {stiffness, 7, 1.4, 0.0, 9e8, 4},
                  {stiffness, 9, 1.0, 0.0, 8e8, 5}};
    EXPECT_EQ(input_error([&] {
                  (void)known.conditioning();
              }).find("field.data:4: value = 900000000: follows from other values"),
              0u);
    known.data = {{friction, 7, 1.5, 0.0}, {stiffness, 7, 1.4, 0.0}};
    known.data[1].variance = 0.01;  // an error makes room for both
    EXPECT_NEAR(known.conditioning().mean(stiffness)[7], 1.5, 1e-12);
}

}  // namespace
}  // namespace grainfield::randomfield
