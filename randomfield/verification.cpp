#include "randomfield/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <exception>
#include <limits>
#include <span>

#include "core/errors.hpp"
#include "randomfield/covariance.hpp"

namespace grainfield::randomfield {
namespace {

constexpr std::size_t bins = 20;
constexpr std::int32_t most_lags = 32;

/// Sums over realizations of numbers counted from their exact values, and of their squares.
class Tally {
  public:
    Tally() = default;
    explicit Tally(std::vector<double> exact)
        : exact_(std::move(exact)), sum_(exact_.size(), 0.0), square_(exact_.size(), 0.0) {}

    void add(std::span<const double> values) {
        for (std::size_t i = 0; i < exact_.size(); ++i) {
            const double off = values[i] - exact_[i];
            sum_[i] += off;
            square_[i] += off * off;
        }
    }
    void merge(const Tally& other) {
        for (std::size_t i = 0; i < exact_.size(); ++i) {
            sum_[i] += other.sum_[i];
            square_[i] += other.square_[i];
        }
    }
    /// Bands at false_alarm for `together` numbers, in units of 1/scale.
    [[nodiscard]] std::vector<Estimate> estimates(std::uint64_t n, std::size_t together,
                                                  double scale) const {
        const auto count = static_cast<double>(n);
        const boost::math::students_t student(count - 1.0);
        const double t =
            quantile(complement(student, 0.5 * false_alarm / static_cast<double>(together)));
        std::vector<Estimate> all;
        for (std::size_t i = 0; i < exact_.size(); ++i) {
            const double off = sum_[i] / count;
            const double variance = std::max(0.0, square_[i] / count - off * off);
            all.push_back({scale * (exact_[i] + off), scale * exact_[i],
                           scale * t * std::sqrt(variance / (count - 1.0))});
        }
        return all;
    }
    [[nodiscard]] double square(std::size_t i) const { return square_[i]; }
    [[nodiscard]] double sum(std::size_t i) const { return sum_[i]; }
    [[nodiscard]] std::size_t size() const { return exact_.size(); }

  private:
    std::vector<double> exact_, sum_, square_;
};

/// Mean over all pairs of cells `lag` apart along an axis of the product of their G.
double mean_product(std::span<const double> g, const GridSpec& grid, std::size_t axis,
                    std::int32_t lag) {
    std::size_t stride = 1;  // from a cell to the next along the axis
    for (std::size_t d = 0; d < axis; ++d) stride *= static_cast<std::size_t>(grid.cells[d]);
    const std::size_t line = stride * static_cast<std::size_t>(grid.cells[axis]);
    const std::size_t ahead = stride * static_cast<std::size_t>(lag);
    double sum = 0.0;
    for (std::size_t first = 0; first < g.size(); first += line)
        for (std::size_t i = first; i + ahead < first + line; ++i) sum += g[i] * g[i + ahead];
    return sum / static_cast<double>(g.size() / line * (line - ahead));
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

/// The sums of one field.
struct Sums {
    Tally products;       ///< of all axes and lags
    Tally cells;          ///< G of every cell
    Tally shares, mean;   ///< of the property
    double square = 0.0;  ///< mean over cells of squared distances from the row's mean
    Tally known;          ///< conditional G of every cell
    double largest_miss = 0.0;
    Tally cross;

    void merge(const Sums& other) {
        products.merge(other.products);
        cells.merge(other.cells);
        shares.merge(other.shares);
        mean.merge(other.mean);
        square += other.square;
        known.merge(other.known);
        largest_miss = std::max(largest_miss, other.largest_miss);
        cross.merge(other.cross);
    }
};

/// What is expected of one field, and how it is added up.
class Checker {
  public:
    Checker(const FieldGenerator& generator, std::optional<Property> property)
        : generator_(generator), grid_(generator.grid()), property_(property) {
        for (std::size_t d = 0; d < 3; ++d) lags_[d] = std::min(grid_.cells[d], most_lags);
        if (property) marginals_ = &generator.marginals(*property);
        if (marginals_ != nullptr) {
            for (std::size_t b = 1; b < bins; ++b)
                edges_.push_back(marginals_->cell_quantile(static_cast<double>(b) / bins));
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
            sums.shares = Tally(std::vector<double>(bins, 1.0 / bins));
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
        if (marginals_ != nullptr)
            add_values(sums, *property_ == Property::friction_angle ? field.friction_angle
                                                                    : field.normal_stiffness);
        if (sums.cross.size() == 0) return;
        double cross = 0.0;
        for (std::size_t c = 0; c < g.size(); ++c) cross += field.G[c] * field.G_stiffness[c];
        sums.cross.add(std::array{cross / static_cast<double>(g.size())});
    }

    void add_known(Sums& sums, const BlockField& field) const {
        if (known_mean_.empty()) return;
        const std::vector<double>& g = gaussian(field);
        sums.known.add(g);
        for (std::size_t c = 0; c < g.size(); ++c)
            if (is_known(c))
                sums.largest_miss = std::max(sums.largest_miss, std::abs(g[c] - known_mean_[c]));
    }

    [[nodiscard]] FieldCheck result(const Sums& sums, std::uint64_t n) const {
        FieldCheck check;
        check.property = property_;
        const double gamma = generator_.gamma();
        const auto all = sums.products.estimates(n, sums.products.size(), 1.0 / gamma);
        auto next = all.begin();
        for (std::size_t d = 0; d < 3; ++d) {
            check.correlation[d].assign(next, next + lags_[d]);
            next += lags_[d];
        }
        std::vector<double> ratio;
        for (std::size_t c = 0; c < grid_.size(); ++c)
            ratio.push_back(sums.cells.square(c) / static_cast<double>(n) / gamma);
        check.variance = variance_map(std::move(ratio), n);
        if (marginals_ != nullptr) check.histogram = histogram(sums, n);
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

    void add_values(Sums& sums, std::span<const double> values) const {
        std::vector<double> shares(bins, 0.0);
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

    [[nodiscard]] HistogramCheck histogram(const Sums& sums, std::uint64_t n) const {
        HistogramCheck check;
        check.edges = edges_;
        check.first = marginals_->cell_quantile(1e-3);
        check.last = marginals_->cell_quantile(1.0 - 1e-3);
        check.shares = sums.shares.estimates(n, bins, 1.0);
        check.mean = sums.mean.estimates(n, 1, 1.0).front();
        check.deviation = moments_.deviation;
        double between = 0.0;  // of the rows' means, in the predicted deviation
        for (const double mean : row_means_)
            between += (mean - moments_.mean) * (mean - moments_.mean);
        check.sampled_deviation = std::sqrt(sums.square / static_cast<double>(n) +
                                            between / static_cast<double>(row_means_.size()));
        return check;
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

bool Estimate::inside() const {
    return std::abs(estimate - exact) <= half_width;
}

Verification verify(const FieldGenerator& generator, std::uint64_t realizations) {
    if (realizations < least_realizations)
        throw InputError(fmt::format("--realizations = {}: a verification needs at least {}",
                                     realizations, least_realizations));
    const std::vector<Checker> checkers = checkers_of(generator);
    // Sums of parts in a fixed order: the same result on any number of threads.
    constexpr std::uint64_t parts = 16;
    std::vector<std::vector<Sums>> sums(parts);
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic)
    for (std::uint64_t part = 0; part < parts; ++part) {
        try {
            for (const Checker& checker : checkers) sums[part].push_back(checker.empty());
            for (std::uint64_t k = part; k < realizations; k += parts) {
                const BlockField plain = generator.draw_unconditional(k);
                for (std::size_t f = 0; f < checkers.size(); ++f)
                    checkers[f].add(sums[part][f], plain);
                if (generator.conditioning() == nullptr) continue;
                const BlockField known = generator.draw(k);
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
        result.fields.push_back(checkers[f].result(total, realizations));
        if (total.cross.size() > 0)
            result.cross_correlation =
                total.cross.estimates(realizations, 1, 1.0 / generator.gamma()).front();
    }
    if (generator.grid().size() <= max_error_cells)
        result.covariance_error = covariance_error(generator.generator());
    return result;
}

}  // namespace grainfield::randomfield
