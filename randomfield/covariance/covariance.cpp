#include "randomfield/covariance/covariance.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "randomfield/covariance/covariance_factors.hpp"
#include "randomfield/covariance/covariance_spherical.hpp"

namespace grainfield::randomfield {
namespace {

using Factors = std::array<std::vector<double>, 3>;

// table(i, j, k) += weight fx(i) fy(j) fz(k). Every entry is one sum in the same order whatever the
// number of threads.
void add_product(const Factors& f, double weight, std::vector<double>& table) {
    double* cell = table.data();
    for (const double fz : f[2]) {
        for (const double fy : f[1]) {
            const double w = weight * fz * fy;
            for (const double fx : f[0]) *cell++ += w * fx;
        }
    }
}

// Markov and Matern are mixtures of Gaussians. From K_nu's integral representation (Abramowitz &
// Stegun 9.6.24 with a change of variable), h = c r:
//   2^(1 - nu)/Gamma(nu) h^nu K_nu(h) =
//       2/Gamma(nu) int_0^inf v^(2 nu - 1) exp(-v^2) exp(-h^2/(4 v^2)) dv,
// exp(-h) at nu = 1/2, the two Matern models at 3/2 and 5/2. A Gaussian's average over two boxes
// is a product of one-dimensional averages F:
//   C = 2/Gamma(nu) int v^(2 nu - 1) exp(-v^2) prod_d F_kd(c D_d / (2 v theta_d)) dv.
// At small v the integrand changes over factors (cells against correlation lengths), at large v
// over a width of 1/3: v = log(1 + e^x) serves both, and the trapezoid rule over x converges
// geometrically, at far lags too, where the integrand is a narrow peak around v^2 = h/2.
struct Mixture {
    double nu;     ///< smoothness [-]
    double scale;  ///< c [-]
};
constexpr double kStep = 0.125;
constexpr double kFirst = -40.0;  // what lies to the left is below 1e-17
constexpr double kLast = 28.0;    // exp(-28^2) is 0

void add_mixture(const Mixture& mixture, const Vec3& cell_over_theta, Factors& f,
                 std::vector<double>& table) {
    const int points = static_cast<int>((kLast - kFirst) / kStep);
    const double norm = kStep * 2.0 / std::tgamma(mixture.nu);
    for (int p = 0; p <= points; ++p) {
        const double x = kFirst + kStep * p;
        const double v = std::log1p(std::exp(x));
        const double dv = 1.0 / (1.0 + std::exp(-x));
        const double weight = norm * dv * std::pow(v, 2.0 * mixture.nu - 1.0) * std::exp(-v * v);
        if (weight == 0.0) continue;
        bool zero = false;
        for (std::size_t d = 0; d < 3; ++d) {
            const double u = 0.5 * mixture.scale / v * cell_over_theta[static_cast<int>(d)];
            gaussian_cell_averages(u, f[d]);
            zero = zero || f[d][0] == 0.0;
        }
        if (!zero) add_product(f, weight, table);
    }
}

}  // namespace

LocalAverageCovariance::LocalAverageCovariance(const Vec3& cell_size,
                                               const CorrelationModel& correlation,
                                               const std::array<std::int32_t, 3>& lags)
    : lags_(lags), table_(static_cast<std::size_t>(lags[0]) * lags[1] * lags[2], 0.0) {
    const Vec3 ratio = cell_size.cwiseQuotient(correlation.length);
    Factors f;
    for (std::size_t d = 0; d < 3; ++d) f[d].resize(static_cast<std::size_t>(lags[d]));
    switch (correlation.kind) {
        case Correlation::markov:
            add_mixture({0.5, 2.0}, ratio, f, table_);
            break;
        case Correlation::matern32:
            add_mixture({1.5, 4.0}, ratio, f, table_);
            break;
        case Correlation::matern52:
            add_mixture({2.5, 16.0 / 3.0}, ratio, f, table_);
            break;
        case Correlation::gaussian:
            for (std::size_t d = 0; d < 3; ++d) {
                gaussian_cell_averages(ratio[static_cast<int>(d)] / std::numbers::inv_sqrtpi, f[d]);
            }
            add_product(f, 1.0, table_);
            break;
        case Correlation::separable_markov:
            for (std::size_t d = 0; d < 3; ++d) {
                const double a = 2.0 * ratio[static_cast<int>(d)];
                for (std::int32_t k = 0; k < lags[d]; ++k) {
                    f[d][static_cast<std::size_t>(k)] = exponential_cell_average(a, k);
                }
            }
            add_product(f, 1.0, table_);
            break;
        case Correlation::spherical:
            // h = 3/4 r: in units of the range.
            spherical_cell_averages(0.75 * ratio, lags, table_);
            break;
    }
}

double LocalAverageCovariance::operator()(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const auto plane = static_cast<std::size_t>(std::abs(k)) * lags_[1];
    const auto row = (plane + static_cast<std::size_t>(std::abs(j))) * lags_[0];
    return table_[row + static_cast<std::size_t>(std::abs(i))];
}

}  // namespace grainfield::randomfield
