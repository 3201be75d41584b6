// From measurements to what is known of G (field_data.hpp, cell_data()).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "randomfield/conditioning/field_data.hpp"
#include "randomfield/conditioning/site_matching.hpp"
#include "randomfield/generators/lower_factor.hpp"
#include "randomfield/marginals/property_limits.hpp"

namespace grainfield::randomfield {
namespace {

/// Measurements of one property in one cell.
struct Pool {
    const Marginal* marginal = nullptr;
    std::vector<const Measurement*> all;
    const Measurement* exact = nullptr;

    /// Those with errors as one, which has the same likelihood: sum of ((T - v_i)/e_i)^2 =
    /// ((T - v)/e)^2 and what does not depend on T. In units of the least error: squares of any
    /// errors would overflow.
    [[nodiscard]] NoisyValue combined() const {
        const double least = (*std::min_element(all.begin(), all.end(), [](auto* a, auto* b) {
                                 return a->error < b->error;
                             }))->error;
        const double first = all.front()->value;
        double weights = 0.0, off = 0.0;
        for (const Measurement* m : all) {
            const double weight = (least / m->error) * (least / m->error);
            weights += weight;
            off += weight * (m->value - first);
        }
        return {marginal, first + off / weights, least / std::sqrt(weights)};
    }
};

using Pools = std::map<std::pair<Property, std::size_t>, Pool>;

/// Checks measurements one by one and sorts them by cell.
class Sorter {
  public:
    /// gamma: variance of a cell's G [-].
    Sorter(const std::filesystem::path& path, const GridSpec& grid, double gamma, double furthest)
        : path_(path), grid_(grid), deviation_(std::sqrt(gamma)), furthest_(furthest) {}

    void add(const Measurement& m, const RowMarginals* rows) {
        const PropertyLimits limits = limits_of(m.property);
        if (rows == nullptr)
            fail(m,
                 fmt::format("property = {}: field.variable does not make it random", limits.name));
        const std::size_t cell = grid_.index_at(m.position);
        const auto nx = static_cast<std::size_t>(grid_.cells[0]);
        const auto ny = static_cast<std::size_t>(grid_.cells[1]);
        Pool& pool = pools_[{m.property, cell}];
        pool.marginal = &rows->row(static_cast<std::int32_t>(cell / nx % ny));
        pool.all.push_back(&m);
        m.error > 0.0 ? check_error(m, *pool.marginal) : add_exact(m, pool);
        check_distance(m, *pool.marginal);
    }
    [[nodiscard]] const Pools& pools() const { return pools_; }

    [[noreturn]] void fail(const Measurement& m, const std::string& message) const {
        core::throw_at_line(path_, m.line, message);
    }

  private:
    /// A value in other units is a possible one as well, but a very unlikely one. One with an error
    /// may lie as many of those nearer.
    void check_distance(const Measurement& m, const Marginal& marginal) const {
        if (!std::isfinite(furthest_)) return;
        const double reach = furthest_ * deviation_, median = marginal(0.0);
        const double low = marginal(-reach), high = marginal(reach);
        const double within = furthest_ * m.error;
        const double nearest = m.value < median ? std::min(m.value + within, median)
                                                : std::max(m.value - within, median);
        if (nearest >= low && nearest <= high) return;
        const PropertyLimits limits = limits_of(m.property);
        const double score = std::abs(marginal.score(m.value)) / deviation_;
        fail(m,
             fmt::format(
                 "value = {:.6g}: {} standard deviations from the distribution of {} here, "
                 "whose median is {:.4g} {}; allowed are {:g}, which end at {:.4g} and "
                 "{:.4g} {}: is it in {}? If it is meant, give field.data_deviations",
                 m.value, std::isfinite(score) ? fmt::format("{:.3g}", score) : "more than 38",
                 limits.key, median, limits.unit, furthest_, low, high, limits.unit, limits.unit));
    }

    void check_error(const Measurement& m, const Marginal& marginal) const {
        const double least = least_error(marginal, m.value);
        if (m.error < least)
            fail(m, fmt::format("error = {}: too small to be told from 0 in double precision: 0 "
                                "for an exact value, or at least {:.2g} {}",
                                m.error, least, limits_of(m.property).unit));
    }

    void add_exact(const Measurement& m, Pool& pool) const {
        const PropertyLimits limits = limits_of(m.property);
        const Interval range = pool.marginal->range();
        const bool inside = m.value > range.low && m.value < range.high &&
                            std::isfinite(pool.marginal->score(m.value));
        if (!inside)
            fail(m, fmt::format("value = {}: exact, but outside what {}.marginal allows here, "
                                "which is between {:.6g} and {:.6g} {}, neither included: give it "
                                "an error, or change the distribution",
                                m.value, limits.key, range.low, range.high, limits.unit));
        if (pool.exact == nullptr) pool.exact = &m;
        if (pool.exact->value != m.value)
            fail(m, fmt::format("value = {}: exact, and so is the value {} of line {} in the same "
                                "block: give one of them an error, or leave one out",
                                m.value, pool.exact->value, pool.exact->line));
    }

    const std::filesystem::path& path_;
    const GridSpec& grid_;
    double deviation_, furthest_;
    Pools pools_;
};

/// Prior covariance of G in all cells with data.
std::vector<double> prior_of(const std::vector<CellDatum>& data, const GridSpec& grid,
                             const LocalAverageCovariance& covariance, double correlation) {
    std::vector<double> prior;
    prior.reserve(data.size() * data.size());
    for (const CellDatum& b : data) {
        const CellCount q = grid.cell_at(b.cell);
        for (const CellDatum& a : data) {
            const CellCount p = grid.cell_at(a.cell);
            prior.push_back((a.property == b.property ? 1.0 : correlation) *
                            covariance(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
    }
    return prior;
}

}  // namespace

std::vector<CellDatum> cell_data(const std::filesystem::path& path,
                                 const std::vector<Measurement>& measurements, const GridSpec& grid,
                                 const LocalAverageCovariance& covariance, double correlation,
                                 const std::function<const RowMarginals*(Property)>& marginals,
                                 double furthest) {
    Sorter sorter(path, grid, covariance.gamma(), furthest);
    for (const Measurement& m : measurements) sorter.add(m, marginals(m.property));
    std::vector<CellDatum> data;
    std::vector<CellKnowledge> cells;
    for (const auto& [where, pool] : sorter.pools()) {
        CellDatum datum{where.first, where.second, 0.0, 0.0, 0.0, pool.all.front()->line};
        CellKnowledge cell;
        if (pool.exact != nullptr) {
            datum.value = pool.exact->value;
            datum.line = pool.exact->line;
            datum.score = pool.marginal->score(datum.value);
            cell.exact = datum.score;
        } else {
            cell.measured = pool.combined();
            datum.value = cell.measured.value;
            if (!moments_given(cell.measured, {0.0, covariance.gamma()})) {
                const PropertyLimits limits = limits_of(where.first);
                const Interval range = pool.marginal->range();
                sorter.fail(*pool.all.front(),
                            fmt::format("value = {:.6g} with an error of {:.3g}: so far from what "
                                        "{}.marginal allows here, between {:.6g} and {:.6g} {}, "
                                        "that it has no probability in double precision: give it a "
                                        "larger error, or change the distribution",
                                        datum.value, cell.measured.error, limits.key, range.low,
                                        range.high, limits.unit));
            }
        }
        data.push_back(datum);
        cells.push_back(cell);
    }
    if (data.size() > LowerFactor::max_size)
        throw InputError(fmt::format("{}: values in {} cells: at most {} cells are allowed",
                                     path.string(), data.size(), LowerFactor::max_size));
    const bool all_exact = std::all_of(cells.begin(), cells.end(),
                                       [](const CellKnowledge& cell) { return cell.exact; });
    if (all_exact) return data;
    const auto sites = match_sites(cells, prior_of(data, grid, covariance, correlation));
    for (std::size_t i = 0; i < data.size(); ++i) {
        if (cells[i].exact) continue;
        data[i].score = sites[i].weighted / sites[i].precision;
        data[i].variance = 1.0 / sites[i].precision;
    }
    return data;
}

}  // namespace grainfield::randomfield
