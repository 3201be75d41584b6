#include "triaxial/campaign/stopping.hpp"

#include <algorithm>
#include <cmath>

#include "triaxial/statistics/bootstrap.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial {
namespace {

constexpr std::int64_t first_look = 20, look_interval = 10;

/// True if both ends of the interval are within the share `target` of the estimate.
bool within(const std::optional<statistics::Interval>& interval, double estimate, double target) {
    return interval && std::max(interval->upper - estimate, estimate - interval->lower) <=
                           target * std::abs(estimate);
}

bool narrow(const std::vector<double>& values, const MonteCarloOptions& options) {
    if (values.size() < 2) return false;
    if (options.target_mean_error && !within(statistics::interval_of_mean(values),
                                             *statistics::mean(values), *options.target_mean_error))
        return false;
    return !options.target_sd_error ||
           within(statistics::bootstrap_interval_of_deviation(values, 0.95, {.resamples = 2000}),
                  *statistics::standard_deviation(values), *options.target_sd_error);
}

}  // namespace

Stopping::Stopping(const std::vector<CampaignCase>& cases) {
    for (const CampaignCase& one : cases) {
        CaseState state;
        state.options = one.config.montecarlo;
        state.needed = state.options.realizations;
        state.next_look = first_look;
        if (!state.options.target_mean_error && !state.options.target_sd_error)
            state.next_look = state.needed;  // never
        cases_.push_back(std::move(state));
    }
}

void Stopping::add(const RowPlace& place, const Row& row) {
    CaseState& state = cases_[place.case_index];
    if (place.realization < 0 || place.realization >= state.needed) return;
    const auto k = static_cast<std::size_t>(place.realization);
    if (state.known.size() <= k) {
        state.known.resize(k + 1);
        state.rows.resize(k + 1);
    }
    state.known[k] = true;
    if (!row.failed) state.rows[k] = Values{row.peak_deviator_stress, row.E50};
    while (static_cast<std::size_t>(state.whole) < state.known.size() &&
           state.known[static_cast<std::size_t>(state.whole)])
        ++state.whole;
    for (; state.next_look <= state.whole && state.next_look < state.needed;
         state.next_look += look_interval)
        if (narrow(state, state.next_look)) state.needed = state.next_look;
}

bool Stopping::narrow(const CaseState& state, std::int64_t realizations) {
    std::vector<double> peaks, moduli;
    for (std::size_t k = 0; k < static_cast<std::size_t>(realizations); ++k)
        if (const auto& values = state.rows[k]) {
            peaks.push_back(values->peak);
            moduli.push_back(values->E50);
        }
    return triaxial::narrow(peaks, state.options) && triaxial::narrow(moduli, state.options);
}

}  // namespace grainfield::triaxial
