#include "randomfield/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace grainfield::randomfield {
namespace {

// The covariance of two cells is the average of Eq. (10) over both:
//   C = avg exp(-sqrt s),  s = sum_d (2 tau_d / theta_d)^2.
// exp(-sqrt s) is a mixture of Gaussians in tau (Laplace transform of the Levy density),
//   exp(-sqrt s) = int_0^inf t^(-3/2) / (2 sqrt pi) exp(-1/(4t)) exp(-s t) dt,
// and a Gaussian's average over a box is a product of one-dimensional averages F:
//   C = int_0^inf t^(-3/2) / (2 sqrt pi) exp(-1/(4t)) prod_d F_kd(2 sqrt(t) D_d / theta_d) dt.
// With t = e^x the integrand is smooth and dies at both ends: the trapezoid rule converges
// geometrically. Left of kFirst the factor exp(-1/(4t)) is below exp(-745); right of kLast the
// integral of t^(-3/2) / (2 sqrt pi) is below 3e-18, whatever the correlation length.
constexpr double kStep = 0.25;
constexpr double kFirst = -8.0;
constexpr double kLast = 80.0;

const double kSqrtPi = std::sqrt(std::acos(-1.0));

// Gauss-Legendre on [0, 1], half of 12 symmetric points.
constexpr double kNode[6] = {0.1252334085114689154724, 0.3678314989981801937527,
                             0.5873179542866174472967, 0.7699026741943046870369,
                             0.9041172563704748566785, 0.9815606342467192506906};
constexpr double kWeight[6] = {0.2491470458134027850006, 0.2334925365383548087608,
                               0.2031674267230659217491, 0.1600783285433462263347,
                               0.1069393259953184309603, 0.0471753363865118271946};

// F'' with respect to the argument is the Gaussian: h'' = exp(-z^2), h -> 0 for z -> infinity.
double double_antiderivative(double z) {
    return 0.5 * std::exp(-z * z) - 0.5 * kSqrtPi * z * std::erfc(z);
}

}  // namespace

double gaussian_cell_average(double u, std::int32_t lag) {
    const double k = std::abs(lag);
    if (u < 0.5) {
        // The closed forms are differences of nearly equal numbers here; the integrand is smooth.
        double sum = 0.0;
        for (int i = 0; i < 6; ++i) {
            for (const double sign : {-1.0, 1.0}) {
                const double v = 0.5 * (1.0 + sign * kNode[i]);
                const double a = u * (k + v);
                const double b = u * (k - v);
                sum += 0.5 * kWeight[i] * (1.0 - v) * (std::exp(-a * a) + std::exp(-b * b));
            }
        }
        return sum;
    }
    // Divided twice by u instead of once by u^2, which may overflow.
    if (lag == 0) return (kSqrtPi * std::erf(u) + std::expm1(-u * u) / u) / u;
    const double second_difference = double_antiderivative(u * (k - 1.0)) -
                                     2.0 * double_antiderivative(u * k) +
                                     double_antiderivative(u * (k + 1.0));
    return second_difference / u / u;
}

LocalAverageCovariance::LocalAverageCovariance(const Vec3& cell_size,
                                               const CorrelationModel& correlation,
                                               const std::array<std::int32_t, 3>& lags)
    : lags_(lags), table_(static_cast<std::size_t>(lags[0]) * lags[1] * lags[2], 0.0) {
    std::array<std::vector<double>, 3> factor;
    const int points = static_cast<int>((kLast - kFirst) / kStep) + 1;
    for (int p = 0; p < points; ++p) {
        const double x = kFirst + kStep * p;
        const double root_t = std::exp(0.5 * x);
        // t^(-3/2) dt = t^(-1/2) dx.
        const double weight =
            kStep / (2.0 * kSqrtPi * root_t) * std::exp(-0.25 / (root_t * root_t));
        for (std::size_t d = 0; d < 3; ++d) {
            const auto axis = static_cast<Eigen::Index>(d);
            const double u = 2.0 * root_t * (cell_size[axis] / correlation.length[axis]);
            factor[d].resize(static_cast<std::size_t>(lags[d]));
            for (std::int32_t k = 0; k < lags[d]; ++k) {
                factor[d][static_cast<std::size_t>(k)] = gaussian_cell_average(u, k);
            }
        }
        double* cell = table_.data();
        for (const double fz : factor[2]) {
            for (const double fy : factor[1]) {
                const double w = weight * fz * fy;
                for (const double fx : factor[0]) *cell++ += w * fx;
            }
        }
    }
}

double LocalAverageCovariance::operator()(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const auto plane = static_cast<std::size_t>(std::abs(k)) * lags_[1];
    const auto row = (plane + static_cast<std::size_t>(std::abs(j))) * lags_[0];
    return table_[row + static_cast<std::size_t>(std::abs(i))];
}

}  // namespace grainfield::randomfield
