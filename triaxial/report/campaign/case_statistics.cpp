#include "triaxial/report/campaign/case_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "triaxial/statistics/bootstrap.hpp"
#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial::report {

CaseStatistics case_statistics(const CaseData& one, const Quantity& quantity) {
    const std::vector<double> values = values_of(one, quantity);
    CaseStatistics s;
    s.count = values.size();
    if (one.deterministic) s.deterministic = (*one.deterministic).*quantity.value * quantity.scale;
    s.mean = statistics::mean(values);
    s.deviation = statistics::standard_deviation(values);
    s.mean_interval = statistics::interval_of_mean(values);
    s.skewness = statistics::skewness(values);
    // E50 and strength are above zero; what is not would be a broken run.
    const bool positive = std::ranges::all_of(values, [](double v) { return v > 0; });
    if (!positive || !s.deviation || *s.deviation == 0) return s;
    s.variation = statistics::coefficient_of_variation(values);
    s.deviation_interval = statistics::bootstrap_interval_of_deviation(values);
    s.variation_interval = statistics::bootstrap_interval_of_variation(values);
    if (values.size() < least_fitted) return s;
    s.fits = statistics::fits(values);
    const statistics::Fit* lognormal = fit_of(s, statistics::Family::lognormal);
    s.chi_square = statistics::chi_square_test(values, *lognormal);
    s.kolmogorov_smirnov =
        statistics::kolmogorov_smirnov_test(statistics::Family::lognormal, values);
    s.anderson_darling = statistics::anderson_darling_test(statistics::Family::lognormal, values);
    return s;
}

const statistics::Fit* fit_of(const CaseStatistics& s, statistics::Family family) {
    const auto at = std::ranges::find(s.fits, family, &statistics::Fit::family);
    return at == s.fits.end() ? nullptr : &*at;
}

CampaignStatistics campaign_statistics(const CampaignData& data) {
    CampaignStatistics all;
    for (const CaseData& one : data.cases) {
        auto& of_case = all.emplace_back();
        for (std::size_t q = 0; q < std::size(quantities); ++q)
            of_case[q] = case_statistics(one, quantities[q]);
    }
    return all;
}

std::string statistics_csv(const CampaignData& data, const CampaignStatistics& all) {
    std::string text =
        "case,quantity,unit,realizations,failed,deterministic,mean,mean_low,mean_high,deviation,"
        "deviation_low,deviation_high,cov,cov_low,cov_high,skewness,best_fit,chi2_p,ks_p,ad_p\n";
    const auto number = [](const std::optional<double>& v) {
        return v ? fmt::format("{}", *v) : std::string();
    };
    const auto ends = [](const std::optional<statistics::Interval>& i) {
        return i ? fmt::format("{},{}", i->lower, i->upper) : std::string(",");
    };
    const auto p = [](const auto& test) {
        return test ? fmt::format("{}", test->p_value) : std::string();
    };
    for (std::size_t c = 0; c < all.size(); ++c)
        for (std::size_t q = 0; q < std::size(quantities); ++q) {
            const CaseData& one = data.cases[c];
            const Quantity& quantity = quantities[q];
            const CaseStatistics& s = all[c][q];
            text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", one.name,
                                quantity.id, quantity.unit, s.count, one.failed,
                                number(s.deterministic), number(s.mean), ends(s.mean_interval),
                                number(s.deviation), ends(s.deviation_interval),
                                number(s.variation), ends(s.variation_interval), number(s.skewness),
                                s.fits.empty() ? "" : statistics::name(s.fits.front().family),
                                p(s.chi_square), p(s.kolmogorov_smirnov), p(s.anderson_darling));
        }
    return text;
}

}  // namespace grainfield::triaxial::report
