#include "randomfield/verification/field_laws.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace grainfield::randomfield {
namespace {

constexpr std::size_t orders = 60;

/// Of pairs of cells along an axis, how many are d apart, over all pairs.
double pairs_apart(std::int32_t cells, std::int32_t d) {
    const double all = static_cast<double>(cells) * cells;
    return (d == 0 ? cells : 2.0 * (cells - d)) / all;
}

double density(double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

/// Hermite polynomials of order 0 ... orders, orthonormal under the normal density.
std::array<double, orders + 1> hermite(double x) {
    std::array<double, orders + 1> h{1.0, x};
    for (std::size_t k = 1; k < orders; ++k)
        h[k + 1] = (x * h[k] - std::sqrt(static_cast<double>(k)) * h[k - 1]) /
                   std::sqrt(static_cast<double>(k + 1));
    return h;
}

/// Skewness of the product of two standard normals with correlation rho: sqrt(8) for a square.
double product_skewness(double rho) {
    return (6.0 * rho + 2.0 * rho * rho * rho) / std::pow(1.0 + rho * rho, 1.5);
}

/// Quantile of the standardized type III distribution, upper or lower tail.
double standard_quantile(double skewness, double tail, bool upper) {
    if (skewness < 0.0) return -standard_quantile(-skewness, tail, !upper);
    if (skewness < 1e-4) {
        const double z = quantile(complement(boost::math::normal(), tail));
        return upper ? z : -z;
    }
    const double shape = 4.0 / (skewness * skewness);
    const boost::math::gamma_distribution<> gamma(shape);
    const double value = upper ? quantile(complement(gamma, tail)) : quantile(gamma, tail);
    return (value - shape) / std::sqrt(shape);
}

}  // namespace

Band band_of_mean(const Law& law, std::uint64_t n, double alpha) {
    const auto count = static_cast<double>(n);
    const double deviation = std::sqrt(law.variance / count);
    const double skewness = law.skewness / std::sqrt(count);
    const double rounding = 1e-12 * std::abs(law.mean);
    return {law.mean + deviation * standard_quantile(skewness, 0.5 * alpha, false) - rounding,
            law.mean + deviation * standard_quantile(skewness, 0.5 * alpha, true) + rounding};
}

/// Of a function in one row of cells.
struct FieldLaws::Coefficients {
    std::array<double, orders + 1> a{};
    double variance = 0.0, third = 0.0;  ///< central moments of a single cell
};

FieldLaws::FieldLaws(const GridSpec& grid, const CorrelationModel& correlation)
    : grid_(grid),
      covariance_(grid.cell_size, correlation, grid.cells),
      powers_(orders + 1, std::vector<double>(static_cast<std::size_t>(grid.cells[1]), 0.0)) {
    // No structured binding: Clang gives none to the threads of a parallel region.
    const std::int32_t nx = grid.cells[0], ny = grid.cells[1], nz = grid.cells[2];
#pragma omp parallel for schedule(static)
    for (std::int32_t j = 0; j < ny; ++j) {
        for (std::int32_t k = 0; k < nz; ++k) {
            for (std::int32_t i = 0; i < nx; ++i) {
                const double r = std::min(1.0, covariance_(i, j, k) / covariance_.gamma());
                double term = pairs_apart(nx, i) * pairs_apart(nz, k);
                for (std::size_t order = 0; order <= orders; ++order, term *= r)
                    powers_[order][static_cast<std::size_t>(j)] += term;
            }
        }
    }
}

Law FieldLaws::of_products(std::size_t axis, std::int32_t lag) const {
    CellCount cells = grid_.cells, apart{0, 0, 0};
    cells[axis] -= lag;
    apart[axis] = lag;
    const auto at = [&](const CellCount& d) { return covariance_(d[0], d[1], d[2]); };
    const double gamma = covariance_.gamma(), covariance = at(apart);
    double variance = 0.0;
    for (std::int32_t k = 0; k < cells[2]; ++k) {
        for (std::int32_t j = 0; j < cells[1]; ++j) {
            for (std::int32_t i = 0; i < cells[0]; ++i) {
                CellCount ahead{i, j, k}, behind = ahead;
                ahead[axis] += lag;
                behind[axis] -= lag;
                // Isserlis: cov(ab, cd) = C_ac C_bd + C_ad C_bc.
                const double same = covariance_(i, j, k);
                variance += pairs_apart(cells[0], i) * pairs_apart(cells[1], j) *
                            pairs_apart(cells[2], k) * (same * same + at(ahead) * at(behind));
            }
        }
    }
    const double rho = covariance / gamma;
    const double single = gamma * gamma * (1.0 + rho * rho);
    return {covariance, variance, product_skewness(rho) * std::sqrt(variance / single)};
}

Law FieldLaws::of_cross_products(double rho) const {
    const double gamma = covariance_.gamma();
    double mean_square = 0.0;  // of the correlation, over all pairs of cells
    for (std::int32_t j = 0; j < grid_.cells[1]; ++j)
        mean_square += pairs_apart(grid_.cells[1], j) * powers_[2][static_cast<std::size_t>(j)];
    return {rho * gamma, gamma * gamma * (1.0 + rho * rho) * mean_square,
            product_skewness(rho) * std::sqrt(mean_square)};
}

Law FieldLaws::law(const std::vector<Coefficients>& rows) const {
    const std::size_t n = rows.size();
    const auto ny = static_cast<std::size_t>(grid_.cells[1]);
    // Of the mean of the power over pairs of cells, one in row p and one in row q; with one row for
    // all, over all pairs.
    std::vector<double> all(orders + 1, 0.0);
    for (std::size_t k = 0; k <= orders; ++k)
        for (std::size_t d = 0; d < ny; ++d)
            all[k] += powers_[k][d] * pairs_apart(grid_.cells[1], static_cast<std::int32_t>(d));
    Law result;
    double single = 0.0, third = 0.0;
    std::vector<double> rest;  // deviation that the coefficients leave
    for (const Coefficients& row : rows) {
        result.mean += row.a[0] / static_cast<double>(n);
        single += row.variance / static_cast<double>(n);
        third += row.third / static_cast<double>(n);
        double known = 0.0;
        for (std::size_t k = 1; k <= orders; ++k) known += row.a[k] * row.a[k];
        rest.push_back(std::sqrt(std::max(0.0, row.variance - known)));
    }
    for (std::size_t p = 0; p < n; ++p) {
        for (std::size_t q = 0; q < n; ++q) {
            const std::size_t d = p < q ? q - p : p - q;
            const auto power = [&](std::size_t k) { return n == 1 ? all[k] : powers_[k][d]; };
            double sum = rest[p] * rest[q] * power(orders);
            for (std::size_t k = 1; k <= orders; ++k) sum += rows[p].a[k] * rows[q].a[k] * power(k);
            result.variance += sum / static_cast<double>(n * n);
        }
    }
    // As if the realization were so many independent cells.
    if (single > 0.0)
        result.skewness = third / std::pow(single, 1.5) * std::sqrt(result.variance / single);
    return result;
}

Law FieldLaws::of_cells(std::size_t rows, const OfRow& function) const {
    constexpr int points = 1400;  // either side; the midpoint rule, exact for smooth functions
    constexpr double step = 0.01;
    std::vector<Coefficients> all(rows);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t row = 0; row < rows; ++row) {
        Coefficients& one = all[row];
        std::vector<double> values;
        for (int i = -points; i < points; ++i) {
            const double x = step * (i + 0.5), weight = step * density(x);
            values.push_back(function(row, x));
            const auto h = hermite(x);
            for (std::size_t k = 0; k <= orders; ++k) one.a[k] += weight * values.back() * h[k];
        }
        for (int i = -points; i < points; ++i) {
            const double off =
                values[static_cast<std::size_t>(std::ptrdiff_t{i} + points)] - one.a[0];
            const double weight = step * density(step * (i + 0.5));
            one.variance += weight * off * off;
            one.third += weight * off * off * off;
        }
    }
    return law(all);
}

Law FieldLaws::of_share(const std::vector<double>& from, const std::vector<double>& to) const {
    std::vector<Coefficients> all(from.size());
    for (std::size_t row = 0; row < from.size(); ++row) {
        Coefficients& one = all[row];
        // Of the probability below, by the tail that keeps its digits.
        const double p = from[row] > 0.0 ? normal_cdf(-from[row]) - normal_cdf(-to[row])
                                         : normal_cdf(to[row]) - normal_cdf(from[row]);
        one.a[0] = p;
        one.variance = p * (1.0 - p);
        one.third = one.variance * (1.0 - 2.0 * p);
        const auto low = hermite(std::clamp(from[row], -38.0, 38.0));
        const auto high = hermite(std::clamp(to[row], -38.0, 38.0));
        for (std::size_t k = 1; k <= orders; ++k)
            one.a[k] = (low[k - 1] * density(from[row]) - high[k - 1] * density(to[row])) /
                       std::sqrt(static_cast<double>(k));
    }
    return law(all);
}

}  // namespace grainfield::randomfield
