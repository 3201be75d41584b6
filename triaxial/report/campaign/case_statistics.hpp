#pragma once
// What is said of one quantity of one case, for the tables and the CSV.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "triaxial/report/campaign/campaign_data.hpp"
#include "triaxial/statistics/distributions.hpp"
#include "triaxial/statistics/goodness_of_fit.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::report {

/// Runs of a case from which on distributions are fitted [-].
inline constexpr std::size_t least_fitted = 8;

/// Empty where there are too few values (see statistics/).
struct CaseStatistics {
    std::size_t count = 0;                                       ///< values [-]
    std::optional<double> mean, deviation, variation, skewness;  ///< variation, skewness [-]
    std::optional<statistics::Interval> mean_interval, deviation_interval, variation_interval;
    std::optional<double> deterministic;
    std::vector<statistics::Fit> fits;  ///< best first; none below least_fitted values
    // Of the lognormal distribution.
    std::optional<statistics::ChiSquareTest> chi_square;
    std::optional<statistics::DistanceTest> kolmogorov_smirnov, anderson_darling;
};

CaseStatistics case_statistics(const CaseData& one, const Quantity& quantity);

/// The fit of a family among them; null if there is none.
const statistics::Fit* fit_of(const CaseStatistics& statistics, statistics::Family family);

/// Of every case of a campaign and every quantity, in their order.
using CampaignStatistics = std::vector<std::array<CaseStatistics, std::size(quantities)>>;
CampaignStatistics campaign_statistics(const CampaignData& data);

/// A row a case and quantity, with header; numbers in the quantities' units.
std::string statistics_csv(const CampaignData& data, const CampaignStatistics& all);

}  // namespace grainfield::triaxial::report
