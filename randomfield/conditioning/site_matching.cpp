#include "randomfield/conditioning/site_matching.hpp"

#include <algorithm>
#include <cmath>

namespace grainfield::randomfield {
namespace {

constexpr int most_sweeps = 60;
constexpr int sweeps_in_full = 10;  // then by halves, where sites of neighbours swing
constexpr double settled = 1e-9;    // change of a site that no longer counts, of all precision
constexpr double no_room = 1e-10;   // share of the prior variance below which nothing is left

/// The joint normal distribution of G in the cells with data, given what was added so far.
class Posterior {
  public:
    explicit Posterior(std::vector<double> covariance, std::size_t size)
        : size_(size), covariance_(std::move(covariance)), mean_(size, 0.0) {}

    [[nodiscard]] GaussianMoments of(std::size_t i) const {
        return {mean_[i], covariance_[i * (size_ + 1)]};
    }
    /// Adds a direct measurement of a cell's G; `site` may be a change of one that is in already.
    void add(std::size_t i, const GaussianSite& site) {
        const GaussianMoments here = of(i);
        const double scale = 1.0 / (1.0 + site.precision * here.variance);
        update(i, (site.weighted - site.precision * here.mean) * scale, site.precision * scale);
    }
    void add_exact(std::size_t i, double score) {
        const GaussianMoments here = of(i);
        update(i, (score - here.mean) / here.variance, 1.0 / here.variance);
    }

  private:
    /// mean += C_i step, C -= C_i C_i^T drop, C_i the column of cell i.
    void update(std::size_t i, double step, double drop) {
        const std::vector<double> column(
            covariance_.begin() + static_cast<std::ptrdiff_t>(i * size_),
            covariance_.begin() + static_cast<std::ptrdiff_t>((i + 1) * size_));
        for (std::size_t a = 0; a < size_; ++a) mean_[a] += step * column[a];
        for (std::size_t b = 0; b < size_; ++b) {
            double* const to = covariance_.data() + b * size_;
            const double factor = drop * column[b];
            for (std::size_t a = 0; a < size_; ++a) to[a] -= factor * column[a];
        }
    }

    std::size_t size_;
    std::vector<double> covariance_, mean_;
};

}  // namespace

std::vector<GaussianSite> match_sites(std::span<const CellKnowledge> cells,
                                      std::vector<double> covariance) {
    const std::size_t n = cells.size();
    std::vector<double> prior;
    for (std::size_t i = 0; i < n; ++i) prior.push_back(covariance[i * (n + 1)]);
    const int sweeps = n <= most_matched_cells ? most_sweeps : 0;
    Posterior posterior(std::move(covariance), n);
    const auto has_room = [&](std::size_t i) {
        return posterior.of(i).variance > no_room * prior[i];
    };
    for (std::size_t i = 0; i < n && sweeps > 0; ++i)
        if (cells[i].exact && has_room(i)) posterior.add_exact(i, *cells[i].exact);

    std::vector<GaussianSite> sites(n);
    const auto matched = [&](std::size_t i) -> std::optional<GaussianSite> {
        const GaussianMoments now = posterior.of(i);
        // Without its own site. Where that holds nearly all that is known, the difference would
        // be round-off: such a site was right when it came in.
        const double others = 1.0 / now.variance - sites[i].precision;
        if (!has_room(i) || !(others > 1e-6 / now.variance)) return std::nullopt;
        const GaussianMoments before{(now.mean / now.variance - sites[i].weighted) / others,
                                     1.0 / others};
        const auto after = moments_given(cells[i].measured, before);
        if (!after) return std::nullopt;
        return site_between(before, *after);
    };
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        bool changed = false;
        for (std::size_t i = 0; i < n; ++i) {
            if (cells[i].exact) continue;
            const auto site = matched(i);
            if (!site) continue;
            const double share = sweep < sweeps_in_full ? 1.0 : 0.5;
            const GaussianSite change{share * (site->precision - sites[i].precision),
                                      share * (site->weighted - sites[i].weighted)};
            const double all = 1.0 / posterior.of(i).variance;
            if (std::abs(change.precision) < settled * all &&
                std::abs(change.weighted) < settled * std::max(std::sqrt(all), all))
                continue;
            posterior.add(i, change);
            sites[i].precision += change.precision;
            sites[i].weighted += change.weighted;
            changed = true;
        }
        if (!changed) break;
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (cells[i].exact || sites[i].precision > 0.0) continue;
        const GaussianMoments before{0.0, prior[i]};
        sites[i] = site_between(before, moments_given(cells[i].measured, before).value());
    }
    return sites;
}

}  // namespace grainfield::randomfield
