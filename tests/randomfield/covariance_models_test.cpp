// Exact covariances of all correlation models against independent integrations: the average over
// two cells as the integral of rho over the distance, weighted by three hats,
//   C = int prod (1 - |v_d|) rho(k + v) dv over [-1, 1]^3.

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "randomfield/covariance/covariance.hpp"
#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

using Lag = std::array<std::int32_t, 3>;
using Gauss = boost::math::quadrature::gauss<double, 15>;

constexpr Correlation kAll[] = {Correlation::markov,   Correlation::separable_markov,
                                Correlation::gaussian, Correlation::spherical,
                                Correlation::matern32, Correlation::matern52};

// Distances b = |k + v| along one axis with the same hat: weight a + s b.
struct Piece {
    double low, high, a, s;
};

std::vector<Piece> pieces_of(std::int32_t k) {
    if (k == 0) return {{0.0, 1.0, 2.0, -2.0}};  // both halves of the hat
    return {{k - 1.0, 1.0 * k, 1.0 - k, 1.0}, {1.0 * k, k + 1.0, k + 1.0, -1.0}};
}

// Cut from the lower end on into lengths step, step, 2 step, 4 step, ... but none above `most`, a
// correlation length; what lies 64 of them away is nothing.
std::vector<Piece> graded(const Piece& piece, double step, double most) {
    std::vector<Piece> all;
    all.reserve(64);
    double from = piece.low;
    double length = step;
    while (from < piece.high && from - piece.low < 64.0 * most) {
        // Nothing thinner than a tenth of a step is left over.
        const double to = from + 1.1 * length < piece.high ? from + length : piece.high;
        all.push_back({from, to, piece.a, piece.s});
        if (from > piece.low) length = std::min(most, 2.0 * length);
        from = to;
    }
    return all;
}

// Tensor Gauss rules on boxes graded towards the nearest corner, none longer than a correlation
// length; at the tip of rho Duffy's transform. The mixture of Gaussians in the code under test has
// nothing in common with it. Spherical correlation has a kink inside and is integrated below.
double graded_integral(const CorrelationModel& model, const Vec3& cell, const Lag& lag) {
    const Vec3 unit = model.length.cwiseQuotient(cell);  // a correlation length in cells
    const double tip = std::min(1.0, (cell.cwiseQuotient(model.length)).minCoeff());
    std::array<std::vector<Piece>, 3> parts;
    for (std::size_t d = 0; d < 3; ++d) {
        const double theta = unit[static_cast<int>(d)];
        for (const Piece& piece : pieces_of(lag[d])) {
            // The Gaussian falls the faster the farther out.
            const bool gaussian = model.kind == Correlation::gaussian;
            const double most =
                std::min(1.0, theta / (gaussian ? std::max(1.0, piece.low / theta) : 1.0));
            const auto some = graded(piece, std::min(tip * theta, most), most);
            parts[d].insert(parts[d].end(), some.begin(), some.end());
        }
    }
    const auto rho = [&](double x, double y, double z) {
        return model(Vec3(x, y, z).cwiseProduct(cell));
    };
    double nearest = 0.0, total = 0.0;
    for (const Piece& x : parts[0])
        for (const Piece& y : parts[1])
            for (const Piece& z : parts[2]) nearest = std::max(nearest, rho(x.low, y.low, z.low));
    for (const Piece& x : parts[0]) {
        for (const Piece& y : parts[1]) {
            for (const Piece& z : parts[2]) {
                if (rho(x.low, y.low, z.low) < 1e-19 * nearest) continue;
                const auto at = [](const Piece& p, double t) {
                    return p.low + t * (p.high - p.low);
                };
                const auto f = [&](double r, double s, double t) {
                    const double bx = at(x, r), by = at(y, s), bz = at(z, t);
                    return (x.a + x.s * bx) * (y.a + y.s * by) * (z.a + z.s * bz) * rho(bx, by, bz);
                };
                const auto cube = [](const auto& g) {
                    const auto line = [](const auto& h) { return Gauss::integrate(h, 0.0, 1.0); };
                    return line([&](double r) {
                        return line(
                            [&](double s) { return line([&](double t) { return g(r, s, t); }); });
                    });
                };
                const double volume = (x.high - x.low) * (y.high - y.low) * (z.high - z.low);
                const bool at_tip = x.low + y.low + z.low == 0.0;
                total += volume * (at_tip ? cube([&](double r, double p, double q) {
                             return r * r *
                                    (f(r, r * p, r * q) + f(r * p, r, r * q) + f(r * p, r * q, r));
                         })
                                          : cube(f));
            }
        }
    }
    return total;
}

struct Setting {
    Vec3 theta;  // in cells
    std::vector<Lag> lags;
};

void expect_exact(Correlation kind, const std::vector<Setting>& settings) {
    int compared = 0;
    const Vec3 cell(0.25, 0.5, 0.125);
    for (const Setting& setting : settings) {
        const CorrelationModel model(setting.theta.cwiseProduct(cell), kind);
        const LocalAverageCovariance covariance(cell, model, {8, 8, 8});
        for (const Lag& lag : setting.lags) {
            const double reference = graded_integral(model, cell, lag);
            if (reference < 1e-290) continue;  // not a normal number any more, or nearly so
            ++compared;
            EXPECT_NEAR(covariance(lag[0], lag[1], lag[2]) / reference, 1.0, 1e-12)
                << name_of(kind) << ", theta in cells " << setting.theta.transpose() << ", lag "
                << lag[0] << lag[1] << lag[2] << ", C = " << reference;
        }
    }
    EXPECT_GE(compared, 8) << name_of(kind);
}

TEST(CovarianceModels, AgreeWithGradedGaussRules) {
    for (const Correlation kind : kAll) {
        if (kind == Correlation::spherical) continue;
        expect_exact(kind, {{Vec3(2.0, 1.0, 0.7), {{0, 0, 0}, {1, 0, 2}, {3, 7, 1}}},
                            {Vec3(40.0, 4.0, 40.0), {{0, 0, 0}, {0, 1, 0}, {5, 0, 7}}},
                            {Vec3(1e-3, 1e-3, 1e-3), {{0, 0, 0}, {0, 1, 0}, {1, 1, 1}}},
                            {Vec3(1e4, 1e4, 1e4), {{0, 0, 0}, {7, 7, 7}}}});
    }
}

TEST(CovarianceModels, LongRunAnyAspectAndAnyLag) {
    for (const Correlation kind : kAll) {
        if (kind == Correlation::spherical) continue;
        expect_exact(kind, {{Vec3(0.04, 0.04, 0.04), {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}}},
                            {Vec3(0.4, 0.4, 0.4), {{1, 1, 1}, {2, 3, 1}, {7, 0, 0}}},
                            {Vec3(4.0, 0.4, 4.0), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}}},
                            {Vec3(0.4, 0.04, 0.4), {{0, 0, 0}, {2, 1, 2}}},
                            {Vec3(1e4, 0.5, 1.0), {{0, 0, 0}, {7, 1, 0}, {0, 3, 2}}},
                            {Vec3(1e-3, 1e4, 1.0), {{0, 0, 0}, {0, 7, 1}, {1, 0, 0}}}});
    }
}

// Spherical: in polar coordinates. Along a ray the integrand is a polynomial between the planes
// where a hat has its kink and the end of the range; directions by adaptive Gauss-Kronrod rules.
double polar_integral(const Vec3& theta, const Lag& lag) {
    const Vec3 range = 4.0 / 3.0 * theta;            // in cells
    const auto along = [&](const Vec3& direction) {  // in units of the range, |direction| >= 1
        const double end = 1.0 / direction.norm();
        std::vector<double> knots{0.0, end};
        for (int d = 0; d < 3; ++d) {
            for (int shift = -1; shift <= 1; ++shift) {
                const double at = (lag[static_cast<std::size_t>(d)] + shift) /
                                  (range[d] * std::max(direction[d], 1e-300));
                if (at > 0.0 && at < end) knots.push_back(at);
            }
        }
        std::sort(knots.begin(), knots.end());
        double sum = 0.0;
        for (std::size_t i = 1; i < knots.size(); ++i) {
            // Degree 8: 2 + 3 of the hats + 3 of rho.
            sum += boost::math::quadrature::gauss<double, 7>::integrate(
                [&](double s) {
                    double weight = s * s;
                    for (int d = 0; d < 3; ++d) {
                        const double b = s * direction[d] * range[d];
                        const double k = lag[static_cast<std::size_t>(d)];
                        const double hat = std::max(0.0, 1.0 - std::abs(b - k));
                        weight *= k == 0.0 ? 2.0 * hat : hat;  // the other octants
                    }
                    const double h = s * direction.norm();
                    return weight * (1.0 - 1.5 * h + 0.5 * h * h * h);
                },
                knots[i - 1], knots[i]);
        }
        return sum;
    };
    using Rule = boost::math::quadrature::gauss_kronrod<double, 21>;
    const auto square = [&](const auto& f) {
        return Rule::integrate(
            [&](double p) {
                return Rule::integrate([&](double q) { return f(p, q); }, 0.0, 1.0, 12, 1e-12);
            },
            0.0, 1.0, 12, 1e-12);
    };
    return range.prod() * square([&](double p, double q) {
               return along({1.0, p, q}) + along({p, 1.0, q}) + along({p, q, 1.0});
           });
}

TEST(CovarianceModels, SphericalAgreesWithPolarIntegration) {
    const Vec3 cell(0.25, 0.5, 0.125);
    struct Row {
        Vec3 theta;  // in cells
        Lag lag;
    };
    for (const Row& row :
         {Row{Vec3(2.0, 2.0, 2.0), {0, 0, 0}}, Row{Vec3(2.0, 2.0, 2.0), {1, 2, 1}},
          Row{Vec3(2.0, 1.0, 0.7), {0, 1, 0}}, Row{Vec3(0.4, 0.4, 0.4), {0, 0, 0}},
          Row{Vec3(3.0, 0.5, 3.0), {2, 1, 0}}, Row{Vec3(1e-3, 1e-3, 1e-3), {0, 0, 0}},
          Row{Vec3(0.04, 0.04, 0.04), {0, 0, 0}}, Row{Vec3(40.0, 4.0, 40.0), {0, 0, 0}},
          Row{Vec3(40.0, 4.0, 40.0), {3, 2, 1}}, Row{Vec3(1e4, 1e4, 1e4), {0, 0, 0}},
          Row{Vec3(1e4, 1e4, 1e4), {3, 3, 3}}, Row{Vec3(1e3, 0.5, 1.0), {0, 0, 0}},
          Row{Vec3(0.01, 1.0, 100.0), {0, 0, 0}}}) {
        const LocalAverageCovariance covariance(
            cell, {row.theta.cwiseProduct(cell), Correlation::spherical}, {4, 4, 4});
        const double reference = polar_integral(row.theta, row.lag);
        EXPECT_NEAR(covariance(row.lag[0], row.lag[1], row.lag[2]) / reference, 1.0, 1e-12)
            << row.theta.transpose() << " lag " << row.lag[0] << row.lag[1] << row.lag[2];
    }
}

// The hats of all lags add up to one, so the covariances of all lags add up to the integral of
// rho, which every model has in closed form: all of the table at once.
TEST(CovarianceModels, SumOverAllLagsIsTheIntegralOfTheCorrelation) {
    constexpr double pi = std::numbers::pi;
    struct Row {
        Correlation kind;
        double integral;  // over space, in units of the product of the correlation lengths
    };
    for (const Row& row :
         {Row{Correlation::markov, pi}, Row{Correlation::separable_markov, 1.0},
          Row{Correlation::gaussian, 1.0}, Row{Correlation::spherical, pi / 6.0 * 64.0 / 27.0},
          Row{Correlation::matern32, 32.0 * pi / 64.0},
          Row{Correlation::matern52, 64.0 * pi * 27.0 / 4096.0}}) {
        for (const Vec3& theta : {Vec3(1.3, 1.3, 1.3), Vec3(2.0, 0.7, 1.1), Vec3(0.3, 1.7, 0.01),
                                  Vec3(1.5, 0.1, 0.1)}) {
            const std::int32_t n = 36;  // exp(-2 n / theta) < 1e-15
            const LocalAverageCovariance covariance(Vec3(1, 1, 1), {theta, row.kind}, {n, n, n});
            double sum = 0.0;
            for (std::int32_t k = 0; k < n; ++k) {
                for (std::int32_t j = 0; j < n; ++j) {
                    for (std::int32_t i = 0; i < n; ++i) {
                        const int mirrors = (i > 0) + (j > 0) + (k > 0);
                        sum += (1 << mirrors) * covariance(i, j, k);
                    }
                }
            }
            EXPECT_NEAR(sum / (row.integral * theta.prod()), 1.0, 2e-13)
                << name_of(row.kind) << " " << theta.transpose();
        }
    }
}

// theta is the scale of fluctuation: the integral of rho along an axis.
TEST(CovarianceModels, ThetaIsTheScaleOfFluctuation) {
    for (const Correlation kind : kAll) {
        const CorrelationModel model(Vec3(0.7, 2.0, 5.0), kind);
        for (int d = 0; d < 3; ++d) {
            const double theta = model.length[d];
            double sum = 0.0;
            for (int piece = 0; piece < 180; ++piece) {  // the spherical range ends at one of them
                sum += Gauss::integrate(
                    [&](double t) {
                        Vec3 tau = Vec3::Zero();
                        tau[d] = t * theta;
                        return 2.0 * model(tau);
                    },
                    piece / 9.0, (piece + 1) / 9.0);
            }
            EXPECT_NEAR(sum, 1.0, 1e-13) << name_of(kind);
        }
    }
}

// Conservation of variance for every model: the mean of eight cells is the cell of twice the size.
TEST(CovarianceModels, ParentsAreMeansOfTheirChildren) {
    const Vec3 cell(0.25, 0.5, 0.125);
    for (const Correlation kind : kAll) {
        for (const double theta : {0.01, 0.3, 1.0, 30.0, 3e4}) {
            const CorrelationModel model(Vec3(theta, 0.3 * theta, theta), kind);
            const LocalAverageCovariance child(cell, model, {4, 4, 4});
            const LocalAverageCovariance parent(2.0 * cell, model, {2, 2, 2});
            for (int shift : {0, 1}) {
                double sum = 0.0;
                for (int a = 0; a < 8; ++a) {
                    for (int b = 0; b < 8; ++b) {
                        sum += child((a & 1) - (b & 1), (a >> 1 & 1) - (b >> 1 & 1) - 2 * shift,
                                     (a >> 2) - (b >> 2) + 2 * shift);
                    }
                }
                const double expected = parent(0, shift, shift);
                EXPECT_NEAR(sum / 64.0, expected, 1e-12 * expected + 1e-300)
                    << name_of(kind) << " " << theta << " " << shift;
            }
        }
    }
}

}  // namespace
}  // namespace grainfield::randomfield
