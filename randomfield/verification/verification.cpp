#include "randomfield/verification/verification.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <exception>
#include <limits>
#include <span>

#include "core/base/errors.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/memory_limit.hpp"
#include "randomfield/verification/field_laws.hpp"
#include "randomfield/verification/verification_sums.hpp"

namespace grainfield::randomfield {
namespace {

constexpr std::size_t bins = 20;
constexpr double least_share = 0.5 / bins;  // of a bin
constexpr std::int32_t most_lags = 32;
constexpr double reach = 38.0;  // deviations beyond which nothing is

/// The mean of n realizations in its band, one of `together` numbers; all over `unit`.
Estimate estimate(double mean, const Law& law, std::uint64_t n, std::size_t together,
                  double unit = 1.0) {
    const Band band = band_of_mean(law, n, false_alarm / static_cast<double>(together));
    return {mean / unit, law.mean / unit, band.low / unit, band.high / unit};
}

VarianceMap variance_map(std::vector<double> ratio, std::uint64_t n) {
    VarianceMap map;
    const auto count = static_cast<double>(n);
    const boost::math::chi_squared chi(count);
    const auto cells = static_cast<double>(
        std::count_if(ratio.begin(), ratio.end(), [](double x) { return !std::isnan(x); }));
    const double alpha = 0.5 * false_alarm / std::max(1.0, cells);
    map.low = quantile(chi, alpha) / count;
    map.high = quantile(complement(chi, alpha)) / count;
    map.single_low = quantile(chi, 0.025) / count;
    map.single_high = quantile(complement(chi, 0.025)) / count;
    for (const double r : ratio) {
        if (r < map.low || r > map.high) ++map.outside;
        if (r < map.single_low || r > map.single_high) map.share_outside_single += 1.0 / cells;
    }
    map.ratio = std::move(ratio);
    return map;
}

/// What is expected of one field, and how it is added up.
class Checker {
  public:
    Checker(const FieldGenerator& generator, std::optional<Property> property)
        : generator_(generator), grid_(generator.grid()), property_(property) {
        for (std::size_t d = 0; d < 3; ++d) lags_[d] = std::min(grid_.cells[d], most_lags);
        if (property) marginals_ = &generator.marginals(*property);
        if (marginals_ != nullptr) {
            double below = 0.0;
            for (std::size_t b = 1; b < bins; ++b) {
                const double edge = marginals_->cell_quantile(static_cast<double>(b) / bins);
                // Where many cells have one value, edges fall together.
                const double share = marginals_->share_below(edge);
                if (share - below < least_share || 1.0 - share < least_share) continue;
                edges_.push_back(edge);
                below = share;
            }
            moments_ = marginals_->moments();
            for (std::int32_t j = 0; j < grid_.cells[1]; ++j)
                row_means_.push_back(marginals_->row(j).moments().mean);
        }
        if (const Conditioning* conditioning = generator.conditioning(); conditioning && property) {
            known_mean_ = conditioning->mean(*property);
            known_variance_ = conditioning->variance(*property);
        }
    }

    [[nodiscard]] Sums empty() const {
        const LocalAverageCovariance of_lag(grid_.cell_size, generator_.generator().correlation(),
                                            grid_.cells);
        std::vector<double> products;
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::int32_t h = 0; h < lags_[d]; ++h) {
                CellCount lag{0, 0, 0};
                lag[d] = h;
                products.push_back(of_lag(lag[0], lag[1], lag[2]));
            }
        }
        Sums sums{Tally(std::move(products)),
                  Tally(std::vector<double>(grid_.size(), 0.0)),
                  {},
                  {},
                  0.0,
                  Tally(known_mean_),
                  0.0,
                  {}};
        if (marginals_ != nullptr) {
            sums.shares = Tally(std::vector<double>(edges_.size() + 1, 0.0));
            sums.mean = Tally({moments_.mean});
        }
        if (property_ == Property::normal_stiffness &&
            generator_.options().variable == Variable::both)
            sums.cross = Tally({generator_.options().cross_correlation * generator_.gamma()});
        return sums;
    }

    void add(Sums& sums, const BlockField& field) const {
        const std::vector<double>& g = gaussian(field);
        std::vector<double> products;
        for (std::size_t d = 0; d < 3; ++d)
            for (std::int32_t h = 0; h < lags_[d]; ++h)
                products.push_back(mean_product(g, grid_, d, h));
        sums.products.add(products);
        sums.cells.add(g);
        if (marginals_ != nullptr) add_values(sums, values_of(field));
        if (sums.cross.size() == 0) return;
        double cross = 0.0;
        for (std::size_t c = 0; c < g.size(); ++c) cross += field.G[c] * field.G_stiffness[c];
        sums.cross.add(std::array{cross / static_cast<double>(g.size())});
    }

    void add_known(Sums& sums, const BlockField& field) const {
        if (known_mean_.empty()) return;
        sums.known.add(gaussian(field));
        // Against the file, not against what became of it on the way.
        const std::vector<double>& values = values_of(field);
        for (const CellDatum& datum : generator_.conditioning()->data())
            if (datum.property == *property_ && datum.variance == 0.0)
                sums.largest_miss =
                    std::max(sums.largest_miss, std::abs(values[datum.cell] / datum.value - 1.0));
    }

    [[nodiscard]] FieldCheck result(const Sums& sums, std::uint64_t n,
                                    std::optional<Estimate>& cross) const {
        FieldCheck check;
        check.property = property_;
        const double gamma = generator_.gamma();
        const FieldLaws laws(grid_, generator_.generator().correlation());
        std::size_t next = 0;
        for (std::size_t d = 0; d < 3; ++d)
            for (std::int32_t h = 0; h < lags_[d]; ++h, ++next)
                check.correlation[d].push_back(estimate(sums.products.mean(next, n),
                                                        laws.of_products(d, h), n,
                                                        sums.products.size(), gamma));
        if (sums.cross.size() > 0)
            cross = estimate(sums.cross.mean(0, n),
                             laws.of_cross_products(generator_.options().cross_correlation), n, 1,
                             gamma);
        std::vector<double> ratio;
        for (std::size_t c = 0; c < grid_.size(); ++c)
            ratio.push_back(sums.cells.square(c) / static_cast<double>(n) / gamma);
        check.variance = variance_map(std::move(ratio), n);
        if (marginals_ != nullptr) check.histogram = histogram(laws, sums, n);
        if (!known_mean_.empty()) check.data = data(sums, n);
        return check;
    }

  private:
    /// A cell whose value the data leave no room.
    [[nodiscard]] bool is_known(std::size_t c) const {
        return known_variance_[c] < 1e-12 * generator_.gamma();
    }

    [[nodiscard]] const std::vector<double>& gaussian(const BlockField& field) const {
        const bool second = property_ == Property::normal_stiffness && !field.G_stiffness.empty();
        return second ? field.G_stiffness : field.G;
    }

    [[nodiscard]] const std::vector<double>& values_of(const BlockField& field) const {
        return *property_ == Property::friction_angle ? field.friction_angle
                                                      : field.normal_stiffness;
    }

    void add_values(Sums& sums, std::span<const double> values) const {
        std::vector<double> shares(edges_.size() + 1, 0.0);
        const double each = 1.0 / static_cast<double>(values.size());
        double mean = 0.0, square = 0.0;
        const auto nx = static_cast<std::size_t>(grid_.cells[0]);
        const auto ny = static_cast<std::size_t>(grid_.cells[1]);
        for (std::size_t c = 0; c < values.size(); ++c) {
            const auto bin = std::upper_bound(edges_.begin(), edges_.end(), values[c]);
            shares[static_cast<std::size_t>(bin - edges_.begin())] += each;
            mean += values[c] * each;
            const double off = values[c] - row_means_[c / nx % ny];
            square += off * off * each;
        }
        sums.shares.add(shares);
        sums.mean.add(std::array{mean});
        sums.square += square;
    }

    [[nodiscard]] HistogramCheck histogram(const FieldLaws& laws, const Sums& sums,
                                           std::uint64_t n) const {
        HistogramCheck check;
        check.edges = edges_;
        check.first = marginals_->cell_quantile(1e-3);
        check.last = marginals_->cell_quantile(1.0 - 1e-3);
        const std::size_t rows = marginals_->distinct_rows();
        const double spread = std::sqrt(generator_.gamma());
        // In units of G's deviation.
        std::vector<double> from(rows, -reach), to(rows);
        for (std::size_t b = 0; b <= edges_.size(); ++b) {
            for (std::size_t j = 0; j < rows; ++j)
                to[j] =
                    b == edges_.size()
                        ? reach
                        : marginals_->row(static_cast<std::int32_t>(j)).first_not_below(edges_[b]) /
                              spread;
            check.shares.push_back(
                estimate(sums.shares.mean(b, n), laws.of_share(from, to), n, edges_.size() + 1));
            from = to;
        }
        const auto value = [&](std::size_t j, double x) {
            return marginals_->row(static_cast<std::int32_t>(j))(spread * x);
        };
        check.mean = estimate(sums.mean.mean(0, n), laws.of_cells(rows, value), n, 2);
        const Law squares = laws.of_cells(rows, [&](std::size_t j, double x) {
            const double off = value(j, x) - row_means_[j];
            return off * off;
        });
        check.deviation = deviation(estimate(sums.square / static_cast<double>(n), squares, n, 2));
        // Of a few realizations with heavy tails the band says nothing; where nearly all values are
        // at two bounds, what scatters is finer than the quadrature behind it.
        check.deviation_judged = squares.skewness / std::sqrt(static_cast<double>(n)) < 1.0 &&
                                 squares.variance > 1e-6 * squares.mean * squares.mean;
        return check;
    }

    /// From the square within rows to the deviation of all cells.
    [[nodiscard]] Estimate deviation(const Estimate& square) const {
        double between = 0.0;  // of the rows' means
        for (const double mean : row_means_)
            between += (mean - moments_.mean) * (mean - moments_.mean) /
                       static_cast<double>(row_means_.size());
        const auto root = [&](double x) { return std::sqrt(std::max(0.0, x) + between); };
        return {root(square.estimate), root(square.exact), root(square.low), root(square.high)};
    }

    [[nodiscard]] DataCheck data(const Sums& sums, std::uint64_t n) const {
        DataCheck check;
        const auto count = static_cast<double>(n);
        for (const CellDatum& datum : generator_.conditioning()->data())
            if (datum.property == *property_) {
                ++check.cells;
                check.exact += datum.variance == 0.0 ? 1 : 0;
            }
        std::vector<double> ratio;
        for (std::size_t c = 0; c < grid_.size(); ++c) {
            if (is_known(c)) {
                ratio.push_back(std::numeric_limits<double>::quiet_NaN());
                continue;
            }
            ratio.push_back(sums.known.square(c) / count / known_variance_[c]);
            check.mean_off = std::max(check.mean_off, std::abs(sums.known.sum(c)) /
                                                          std::sqrt(count * known_variance_[c]));
        }
        check.largest_miss = sums.largest_miss;
        check.mean_allowed = quantile(complement(
            boost::math::normal(), 0.5 * false_alarm / static_cast<double>(grid_.size())));
        check.variance = variance_map(std::move(ratio), n);
        return check;
    }

    const FieldGenerator& generator_;
    GridSpec grid_;
    std::optional<Property> property_;
    std::array<std::int32_t, 3> lags_{};
    const RowMarginals* marginals_ = nullptr;
    std::vector<double> edges_, row_means_;
    Moments moments_;
    std::vector<double> known_mean_, known_variance_;
};

std::vector<Checker> checkers_of(const FieldGenerator& generator) {
    std::vector<Checker> checkers;
    for (const Property property : {Property::friction_angle, Property::normal_stiffness})
        if (generator.options().random(property)) checkers.emplace_back(generator, property);
    if (checkers.empty()) checkers.emplace_back(generator, std::nullopt);
    return checkers;
}

}  // namespace

double Estimate::of_band() const {
    const double off = estimate - exact, side = off > 0.0 ? high - exact : low - exact;
    return side != 0.0 ? off / side : 0.0;
}

Verification verify(const FieldGenerator& generator, std::uint64_t realizations) {
    core::Monitor nobody;
    return verify(generator, realizations, nobody);
}

Verification verify(const FieldGenerator& generator, std::uint64_t realizations,
                    core::Monitor& monitor) {
    return verify(generator,
                  {[&](std::uint64_t k) { return generator.draw_unconditional(k); },
                   [&](std::uint64_t k) { return generator.draw(k); }},
                  realizations, monitor);
}

Verification verify(const FieldGenerator& generator, const FieldSource& source,
                    std::uint64_t realizations, core::Monitor& monitor) {
    if (realizations < least_realizations)
        throw InputError(fmt::format("--realizations = {}: a verification needs at least {}",
                                     realizations, least_realizations));
    const std::vector<Checker> checkers = checkers_of(generator);
    // Sums of parts in a fixed order: the same result on any number of threads.
    constexpr std::uint64_t parts = 16;
    // Three columns a tally of cells and part, two tallies a field, and a realization a thread.
    require_memory(
        generator.grid(),
        (6.0 * parts * static_cast<double>(checkers.size()) + 8.0 * omp_get_max_threads()) *
            static_cast<double>(generator.grid().size()) * sizeof(double),
        "--verify");
    std::vector<std::vector<Sums>> sums(parts);
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic)
    for (std::uint64_t part = 0; part < parts; ++part) {
        try {
            for (const Checker& checker : checkers) sums[part].push_back(checker.empty());
            for (std::uint64_t k = part; k < realizations; k += parts) {
                if (monitor.stop_requested())
                    throw Interrupted("interrupted: the verification was not finished");
                if (omp_get_thread_num() == 0)
                    monitor.progress(static_cast<double>(k) / static_cast<double>(realizations), -1,
                                     "");
                const BlockField plain = source.plain(k);
                for (std::size_t f = 0; f < checkers.size(); ++f)
                    checkers[f].add(sums[part][f], plain);
                if (generator.conditioning() == nullptr) continue;
                const BlockField known = source.known(k);
                for (std::size_t f = 0; f < checkers.size(); ++f)
                    checkers[f].add_known(sums[part][f], known);
            }
        } catch (...) {
#pragma omp critical
            failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
    Verification result;
    result.realizations = realizations;
    result.gamma = generator.gamma();
    for (std::size_t f = 0; f < checkers.size(); ++f) {
        Sums total = checkers[f].empty();
        for (const auto& part : sums) total.merge(part[f]);
        result.fields.push_back(checkers[f].result(total, realizations, result.cross_correlation));
    }
    if (generator.grid().size() <= max_error_cells)
        result.covariance_error = covariance_error(generator.generator());
    return result;
}

}  // namespace grainfield::randomfield
