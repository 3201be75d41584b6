#include "triaxial/report/campaign/campaign_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/files/atomic_file.hpp"
#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/campaign/case_statistics.hpp"
#include "triaxial/report/page.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial {
namespace {

using namespace report;

constexpr const char* missing = "–";
constexpr std::size_t least_drawn = 3;  // runs of a case: two are one point of a running mean

std::string text(const std::optional<double>& value, int digits = 4) {
    return value ? significant(*value, digits) : missing;
}
std::string text(const std::optional<statistics::Interval>& interval, int digits) {
    if (!interval) return missing;
    // Blanks that do not break: the two ends stay in one line.
    return fmt::format("{}\u00a0…\u00a0{}", significant(interval->lower, digits),
                       significant(interval->upper, digits));
}
template <class Test>
std::string p_text(const std::optional<Test>& test) {
    if (!test) return missing;
    return test->p_value < 1e-3 ? "&lt;\u00a00.001" : significant(test->p_value, 2);
}

void add_moments(Page& page, const CampaignData& data, const CampaignStatistics& all,
                 std::size_t q) {
    const Quantity& quantity = quantities[q];
    const std::vector<std::string> header{"case",          "runs", "failed", "no peak",
                                          "deterministic", "mean", "95 %",   "deviation",
                                          "95 %",          "COV",  "95 %"};
    std::vector<std::vector<std::string>> rows;
    for (std::size_t c = 0; c < all.size(); ++c) {
        const CaseStatistics& s = all[c][q];
        rows.push_back({escape(data.cases[c].name), count(static_cast<double>(s.count)),
                        count(static_cast<double>(data.cases[c].failed)),
                        count(static_cast<double>(data.cases[c].without_peak)),
                        text(s.deterministic), text(s.mean), text(s.mean_interval, 4),
                        text(s.deviation, 3), text(s.deviation_interval, 3), text(s.variation, 3),
                        text(s.variation_interval, 3)});
    }
    page.columns(fmt::format("{}, {}", quantity.name, quantity.unit), header, rows);
}

/// False where no case has runs enough.
bool add_fits(Page& page, const CampaignData& data, const CampaignStatistics& all, std::size_t q) {
    const std::vector<std::string> header{"case",      "best by AIC", "lognormal",
                                          "normal",    "gamma",       "Weibull",
                                          "χ²\u00a0p", "KS\u00a0p",   "AD\u00a0p"};
    std::vector<std::vector<std::string>> rows;
    for (std::size_t c = 0; c < all.size(); ++c) {
        const CaseStatistics& s = all[c][q];
        if (s.fits.empty()) continue;
        std::vector<std::string> row{escape(data.cases[c].name),
                                     std::string(name(s.fits.front().family))};
        for (const auto family : {statistics::Family::lognormal, statistics::Family::normal,
                                  statistics::Family::gamma, statistics::Family::weibull}) {
            const statistics::Fit* fit = fit_of(s, family);
            row.push_back(fit == nullptr
                              ? missing
                              : fmt::format("{:+.1f}", fit->aic() - s.fits.front().aic()));
        }
        for (const std::string& p :
             {p_text(s.chi_square), p_text(s.kolmogorov_smirnov), p_text(s.anderson_darling)})
            row.push_back(p);
        rows.push_back(std::move(row));
    }
    if (rows.empty()) return false;
    page.columns(fmt::format("{}: AIC above the best fit, and tests of the lognormal distribution",
                             quantities[q].name),
                 header, rows);
    return true;
}

void add_distributions(Page& page, const CampaignData& data, const CampaignStatistics& all) {
    page.section("Distributions");
    bool any = false;
    for (std::size_t q = 0; q < std::size(quantities); ++q) any |= add_fits(page, data, all, q);
    if (any)
        page.paragraph(
            "Fits by maximum likelihood. χ²: bins of equal probability; KS: Kolmogorov–Smirnov "
            "with estimated parameters, p by parametric bootstrap; AD: Anderson–Darling with "
            "estimated parameters (Stephens). A small p speaks against the lognormal distribution.",
            "note");
    else
        page.paragraph(fmt::format("Distributions are fitted to {} runs of a case or more, whose "
                                   "results differ and are above zero: no case has them.",
                                   least_fitted),
                       "note");
}

void add_trends(Page& page, const Gnuplot& gnuplot, const CampaignData& data,
                const CampaignStatistics& all) {
    std::vector<Figure> figures;
    for (std::size_t k = 0; k < data.varying.size(); ++k) {
        const std::vector<Trend> trends = trends_over(data, data.varying[k]);
        if (trends.empty()) continue;
        for (std::size_t q = 0; q < std::size(quantities); ++q)
            figures.push_back(trend_figure(gnuplot, fmt::format("trend{}{}", k, quantities[q].id),
                                           q, axis_name(data.varying[k]), trends, all));
    }
    const bool all_begun =
        std::ranges::all_of(data.cases, [](const CaseData& one) { return one.rows.size() >= 2; });
    if (figures.empty() && (all_begun || data.varying.empty())) return;
    page.section("Over the cases");
    page.figures(figures, "wide");
    if (!all_begun)
        page.paragraph(
            "Cases of which fewer than two runs are done have no deviation and are left out.",
            "note");
}

void add_case(Page& page, const Gnuplot& gnuplot, const CaseData& one, std::size_t c,
              const std::array<CaseStatistics, std::size(quantities)>& statistics) {
    page.section(fmt::format("Case {}", escape(one.name)));
    if (one.rows.size() < least_drawn) {
        page.paragraph(fmt::format("Figures of a case are drawn from {} runs on; done: {}.",
                                   least_drawn, one.rows.size()),
                       "note");
        return;
    }
    for (std::size_t q = 0; q < std::size(quantities); ++q) {
        const Quantity& quantity = quantities[q];
        const CaseStatistics& s = statistics[q];
        const std::vector<double> values = values_of(one, quantity);
        if (s.deviation == 0.0) {
            page.paragraph(fmt::format("All runs gave the same {}.", quantity.name), "note");
            continue;
        }
        const std::string id = fmt::format("c{}{}", c, quantity.id);
        page.figures(
            std::array{convergence_figure(gnuplot, id + "run", quantity, values, s.deterministic)},
            "wide");
        if (s.fits.empty()) {
            if (one.rows.size() >= least_fitted)
                page.paragraph(
                    fmt::format("Not every {} is above zero: nothing is fitted.", quantity.name),
                    "note");
            continue;
        }
        page.figures(std::array{histogram_figure(gnuplot, id + "bins", quantity, values, s.fits),
                                probability_figure(gnuplot, id + "pp", quantity, values,
                                                   *fit_of(s, statistics::Family::lognormal))});
    }
    if (one.rows.size() < least_fitted)
        page.paragraph(fmt::format("Histograms and P–P plots are drawn from {} runs on; done: {}.",
                                   least_fitted, one.rows.size()),
                       "note");
}

std::string lead(const CampaignData& data) {
    std::size_t done = 0, failed = 0;
    for (const CaseData& one : data.cases) {
        done += one.rows.size();
        failed += one.failed;
    }
    return fmt::format("{} realization{} over {} case{} {} done, {} failed; {} of computing time.",
                       count(static_cast<double>(done)), done == 1 ? "" : "s", data.cases.size(),
                       data.cases.size() == 1 ? "" : "s", done == 1 ? "is" : "are", failed,
                       duration(data.wall_seconds));
}

/// Runs without a peak bias the statistics, and so may what runs warn of: they are counted where
/// nobody can miss it.
void add_warnings(Page& page, const CampaignData& data) {
    std::size_t done = 0, without_peak = 0, with_warnings = 0, not_quasi_static = 0;
    for (const CaseData& one : data.cases) {
        done += one.rows.size();
        without_peak += one.without_peak;
        with_warnings += one.with_warnings;
        not_quasi_static += one.not_quasi_static;
    }
    if (with_warnings > 0)
        page.paragraph(
            fmt::format(
                "{} of {} runs carry a warning (<code>warnings.csv</code>); {} of them "
                "are not quasi-static.",
                count(static_cast<double>(with_warnings)), count(static_cast<double>(done)),
                not_quasi_static == 0 ? "none" : count(static_cast<double>(not_quasi_static))),
            "warning");
    if (without_peak == 0) return;
    page.paragraph(
        fmt::format("No peak was found in {} of {} runs: they ended before <i>q</i> had fallen for "
                    "good or levelled off. Their peak is the largest <i>q</i> up to the strain at "
                    "which they ended and may be too low (column <code>failure</code> of "
                    "<code>results.csv</code>).",
                    count(static_cast<double>(without_peak)), count(static_cast<double>(done))),
        "warning");
}

std::string campaign_page(const CampaignData& data, const CampaignStatistics& all) {
    const Gnuplot gnuplot;
    const std::string folder =
        escape(std::filesystem::weakly_canonical(data.path).filename().string());
    Page page(fmt::format("Grainfield report · campaign “{}”", folder), "Monte Carlo campaign",
              lead(data));
    add_warnings(page, data);
    page.section("Results");
    for (std::size_t q = 0; q < std::size(quantities); ++q) add_moments(page, data, all, q);
    page.paragraph(
        "Intervals of the mean are Student’s, those of deviation and coefficient of variation "
        "(COV) bootstrap intervals (BCa, 10,000 resamples). The deterministic run has no random "
        "field. What a single run scatters by is in all of this; <code>triaxial --repeats</code> "
        "tells "
        "it.",
        "note");
    add_distributions(page, data, all);
    add_trends(page, gnuplot, data, all);
    for (std::size_t c = 0; c < data.cases.size(); ++c)
        add_case(page, gnuplot, data.cases[c], c, all[c]);
    if (!data.failures.empty()) {
        page.section("Runs that failed");
        std::string list;
        for (const std::string& line : data.failures) list += line + '\n';
        page.listing(list);
    }
    if (!data.warnings.empty()) {
        constexpr std::size_t shown = 20;
        page.section("Warnings");
        std::string list;
        for (std::size_t k = 0; k < std::min(shown, data.warnings.size()); ++k)
            list += data.warnings[k] + '\n';
        if (data.warnings.size() > shown)
            list += fmt::format("and {} more: warnings.csv\n", data.warnings.size() - shown);
        page.listing(list);
    }
    page.section("Settings");
    page.paragraph(fmt::format("Grainfield {}. Keys that vary: {}. Every other key is the same in "
                               "all cases; the first case with all of its keys:",
                               escape(data.version),
                               data.varying.empty()
                                   ? "none"
                                   : escape(fmt::format("{}", fmt::join(data.varying, ", ")))),
                   "note");
    if (!data.cases.empty()) {
        page.listing(data.cases.front().config);
        page.values({{"kernels", data.cases.front().kernels},
                     {"computed on", fmt::format("{}", fmt::join(data.machines, "; "))}});
    }
    return page.html();
}

}  // namespace

std::filesystem::path write_campaign_report(const std::filesystem::path& dir) {
    const CampaignData data = read_campaign_data(dir);
    const CampaignStatistics all = campaign_statistics(data);
    core::write_file_atomically(dir / "statistics.csv", statistics_csv(data, all));
    const std::filesystem::path path = dir / "report.html";
    core::write_file_atomically(path, campaign_page(data, all));
    return path;
}

}  // namespace grainfield::triaxial
