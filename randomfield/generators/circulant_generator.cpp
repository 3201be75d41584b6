#include "randomfield/generators/circulant_generator.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/memory_limit.hpp"

namespace grainfield::randomfield {
namespace {

// FFTW's planner is the one part of it that is not safe from many threads.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

struct FreePlan {
    void operator()(fftw_plan_s* plan) const {
        const std::lock_guard lock(planner());
        fftw_destroy_plan(plan);
    }
};
using PlanPointer = std::unique_ptr<fftw_plan_s, FreePlan>;

namespace {

struct Free {
    void operator()(double* memory) const { fftw_free(memory); }
};
using Buffer = std::unique_ptr<double[], Free>;

constexpr double longest_period = 12.0;  // correlation lengths

// Smallest even number of at least n with no prime factors but 2, 3 and 5: fast to transform.
std::int32_t fast_size(std::int32_t n) {
    for (std::int32_t size = n + n % 2;; size += 2) {
        std::int32_t rest = size;
        for (const std::int32_t prime : {2, 3, 5}) {
            while (rest % prime == 0) rest /= prime;
        }
        if (rest == 1) return size;
    }
}

// At least 2 (n - 1), so that all lags of the grid are on it, and a number of correlation lengths,
// so that little is left of the correlation half way round; 1 where n = 1.
CellCount period_of(const GridSpec& grid, const Vec3& theta, double lengths) {
    CellCount period{};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto a = static_cast<Eigen::Index>(d);
        const double least = std::max(2.0 * (grid.cells[d] - 1.0),
                                      std::ceil(lengths * theta[a] / grid.cell_size[a]));
        period[d] =
            grid.cells[d] == 1 ? 1 : fast_size(static_cast<std::int32_t>(std::min(1e9, least)));
    }
    return period;
}

double cells_of(const CellCount& n) {
    return 1.0 * n[0] * n[1] * n[2];
}

std::size_t half_row(const CellCount& period) {
    return static_cast<std::size_t>(period[0] / 2 + 1);
}

// The covariances around a torus and their Fourier transform, which is real: half the spectrum.
std::vector<double> eigenvalues_of(const GridSpec& grid, const CorrelationModel& correlation,
                                   const CellCount& m) {
    const LocalAverageCovariance of_lag(grid.cell_size, correlation,
                                        {m[0] / 2 + 1, m[1] / 2 + 1, m[2] / 2 + 1});
    const std::size_t row = 2 * half_row(m);  // in place: room for the spectrum
    const std::size_t rows = static_cast<std::size_t>(m[1]) * static_cast<std::size_t>(m[2]);
    const Buffer data(fftw_alloc_real(row * rows));
    PlanPointer plan;
    {
        const std::lock_guard lock(planner());
        plan.reset(fftw_plan_dft_r2c_3d(m[2], m[1], m[0], data.get(),
                                        reinterpret_cast<fftw_complex*>(data.get()),
                                        FFTW_ESTIMATE));
    }
    const auto around = [](std::int32_t i, std::int32_t n) { return std::min(i, n - i); };
    double* out = data.get();
    for (std::int32_t k = 0; k < m[2]; ++k) {
        for (std::int32_t j = 0; j < m[1]; ++j, out += row) {
            for (std::int32_t i = 0; i < m[0]; ++i) {
                out[i] = of_lag(around(i, m[0]), around(j, m[1]), around(k, m[2]));
            }
        }
    }
    fftw_execute(plan.get());
    std::vector<double> eigenvalues(row * rows / 2);
    for (std::size_t e = 0; e < eigenvalues.size(); ++e) eigenvalues[e] = data[2 * e];
    return eigenvalues;
}

// What clipping the negative ones would add to every variance, which no covariance exceeds.
struct Negative {
    double least = 0.0;   ///< in units of the largest eigenvalue [-]
    double effect = 0.0;  ///< in units of gamma [-]
};

Negative negative_part(std::span<const double> eigenvalues, const CellCount& m, double gamma) {
    Negative negative;
    double largest = 0.0, sum = 0.0;
    for (std::size_t e = 0; e < eigenvalues.size(); ++e) {
        const double value = eigenvalues[e];
        largest = std::max(largest, value);
        negative.least = std::min(negative.least, value);
        // Modes inside the half spectrum stand for two.
        const std::size_t i = e % half_row(m);
        const bool single = i == 0 || 2 * i == static_cast<std::size_t>(m[0]);
        if (value < 0.0) sum -= (single ? 1.0 : 2.0) * value;
    }
    negative.least /= largest;
    negative.effect = sum / cells_of(m) / gamma;
    return negative;
}

InputError too_large(const GridSpec& grid, const CellCount& period, double most_cells) {
    return InputError(fmt::format(
        "random field: {} x {} x {} cells with field.method = \"circulant\" need a period of {} x "
        "{} x {} cells or more: at most {:.0f} are allowed; lower packing.blocks, or use "
        "field.method = \"las\"",
        grid.cells[0], grid.cells[1], grid.cells[2], period[0], period[1], period[2], most_cells));
}

/// Correlation lengths of the same ratios whose longest period is just allowed: there is none
/// longer that could do.
Vec3 longest_that_fits(const GridSpec& grid, const Vec3& theta, double most_cells) {
    double fits = 0.0, too_long = 1.0;
    for (int step = 0; step < 50; ++step) {
        const double middle = 0.5 * (fits + too_long);
        const bool good = cells_of(period_of(grid, middle * theta, longest_period)) <= most_cells;
        (good ? fits : too_long) = middle;
    }
    return fits * theta;
}

}  // namespace

struct CirculantGenerator::Plan {
    PlanPointer backward;
};

CirculantGenerator::CirculantGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                                       double most_cells)
    : Generator(grid, correlation) {
    std::optional<Negative> best;
    std::optional<CellCount> too_many;
    CellCount best_period{}, tried{};
    for (const double lengths :
         {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, longest_period}) {
        const CellCount m = period_of(grid, correlation.length, lengths);
        if (best && m == tried) continue;
        tried = m;
        if (cells_of(m) > most_cells) {
            if (!best) throw too_large(grid, m, most_cells);
            too_many = m;
            break;
        }
        require_memory(grid, 40.0 * cells_of(m), "field.method = \"circulant\"");
        const std::vector<double> eigenvalues = eigenvalues_of(grid, correlation, m);
        const Negative negative = negative_part(eigenvalues, m, gamma());
        if (negative.effect <= round_off) {
            period_ = m;
            set_amplitudes(eigenvalues);
            return;
        }
        if (!best || negative.effect < best->effect) {
            best = negative;
            best_period = m;
        }
    }
    const Vec3& theta = correlation.length;
    std::string hint;
    if (too_many) {
        const Vec3 fits = longest_that_fits(grid, theta, most_cells);
        hint = fmt::format(
            "the next period, {} x {} x {}, has more than the {:.0f} cells that are allowed; "
            "periods "
            "of {:g} correlation lengths fit up to about [{:.3g}, {:.3g}, {:.3g}] m; ",
            (*too_many)[0], (*too_many)[1], (*too_many)[2], most_cells, longest_period, fits[0],
            fits[1], fits[2]);
    }
    throw InputError(fmt::format(
        "field.method = \"circulant\" with field.correlation = \"{}\" and "
        "field.correlation_length = [{}, {}, {}] m: no period is allowed for {} x {} x {} cells "
        "whose eigenvalues are not negative; with {} x {} x {} the most negative one is {:.2e} of "
        "the largest, and clipping would change covariances by up to {:.2e} gamma (at most {:.0e} "
        "is allowed); {}use field.method = \"cholesky\" or \"las\"",
        name_of(correlation.kind), theta[0], theta[1], theta[2], grid.cells[0], grid.cells[1],
        grid.cells[2], best_period[0], best_period[1], best_period[2], best->least, best->effect,
        round_off, hint));
}

CirculantGenerator::~CirculantGenerator() = default;

std::optional<double> CirculantGenerator::known_error() const {
    // The transform of the amplitudes' squares is the covariance around the period.
    const Buffer data(fftw_alloc_real(2 * amplitude_.size()));
    for (std::size_t e = 0; e < amplitude_.size(); ++e) {
        data[2 * e] = amplitude_[e] * amplitude_[e];
        data[2 * e + 1] = 0.0;
    }
    fftw_execute_dft_c2r(plan_->backward.get(), reinterpret_cast<fftw_complex*>(data.get()),
                         data.get());
    const CellCount& n = grid().cells;
    const LocalAverageCovariance of_lag(grid().cell_size, correlation(), n);
    double worst = 0.0;
    for (std::int32_t k = 0; k < n[2]; ++k) {
        for (std::int32_t j = 0; j < n[1]; ++j) {
            const auto row = static_cast<std::size_t>(k) * static_cast<std::size_t>(period_[1]) +
                             static_cast<std::size_t>(j);
            for (std::int32_t i = 0; i < n[0]; ++i) {
                const double value = data[2 * half_row(period_) * row + i];
                worst = std::max(worst, std::abs(value - of_lag(i, j, k)));
            }
        }
    }
    return worst / gamma();
}

void CirculantGenerator::set_amplitudes(std::span<const double> eigenvalues) {
    amplitude_.resize(eigenvalues.size());
    for (std::size_t e = 0; e < eigenvalues.size(); ++e) {
        amplitude_[e] = std::sqrt(std::max(0.0, eigenvalues[e]) / cells_of(period_));
    }
    const Buffer data(fftw_alloc_real(2 * amplitude_.size()));
    auto plan = std::make_unique<Plan>();
    const std::lock_guard lock(planner());
    plan->backward.reset(fftw_plan_dft_c2r_3d(period_[2], period_[1], period_[0],
                                              reinterpret_cast<fftw_complex*>(data.get()),
                                              data.get(), FFTW_ESTIMATE));
    plan_ = std::move(plan);
}

void CirculantGenerator::apply(std::span<const double> normals, std::span<double> field) const {
    // Aligned as the plan was made for; kept from field to field.
    thread_local Buffer buffer;
    thread_local std::size_t room = 0;
    if (room < normals.size()) {
        buffer.reset();
        buffer.reset(fftw_alloc_real(normals.size()));
        room = normals.size();
    }
    double* const mode = buffer.get();
    const auto row = half_row(period_);
    const auto m0 = static_cast<std::size_t>(period_[0]);
    const auto m1 = static_cast<std::size_t>(period_[1]), m2 = static_cast<std::size_t>(period_[2]);
    const double half = std::sqrt(0.5);
#pragma omp parallel for schedule(static) if (normals.size() >= 65536)
    for (std::size_t r = 0; r < m1 * m2; ++r) {
        const double* s = amplitude_.data() + r * row;
        const double* u = normals.data() + 2 * r * row;
        double* out = mode + 2 * r * row;
        // A mode and its mirror image are conjugate: each half of the variance.
        for (std::size_t i = 0; i < row; ++i) {
            out[2 * i] = half * s[i] * u[2 * i];
            out[2 * i + 1] = half * s[i] * u[2 * i + 1];
        }
        // In these columns the mirror image is in the same column.
        const std::size_t j = r % m1, k = r / m1;
        const std::size_t mirror = (m1 - j) % m1 + m1 * ((m2 - k) % m2);
        for (const std::size_t i : {std::size_t{0}, m0 / 2}) {
            if (2 * i != 0 && 2 * i != m0) continue;
            if (mirror == r) {  // its own: real
                out[2 * i] = s[i] * u[2 * i];
                out[2 * i + 1] = 0.0;
            } else if (mirror < r) {
                const double* other = normals.data() + 2 * (mirror * row + i);
                out[2 * i] = half * s[i] * other[0];
                out[2 * i + 1] = -half * s[i] * other[1];
            }
        }
    }
    fftw_execute_dft_c2r(plan_->backward.get(), reinterpret_cast<fftw_complex*>(mode), mode);
    const auto [nx, ny, nz] = grid().cells;
    for (std::int32_t k = 0; k < nz; ++k) {
        for (std::int32_t j = 0; j < ny; ++j) {
            std::copy_n(mode + 2 * row * (static_cast<std::size_t>(k) * m1 + j), nx,
                        field.data() + grid().index(0, j, k));
        }
    }
}

}  // namespace grainfield::randomfield
