#include "triaxial/report/repeats/repeats_report.hpp"

#include <fmt/format.h>

#include <array>

#include "core/files/atomic_file.hpp"
#include "triaxial/realization/failure.hpp"
#include "triaxial/report/page.hpp"
#include "triaxial/report/repeats/figure_repeats.hpp"
#include "triaxial/report/repeats/repeats_data.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial {
namespace {

using namespace report;

std::string range(const statistics::Interval& interval, double scale, int digits) {
    return significant(scale * interval.lower, digits) + " … " +
           significant(scale * interval.upper, digits);
}

void add_scatter(Page& page, const RepeatsData& data) {
    const std::vector<std::string> header{"quantity", "mean",   "95 %", "deviation",
                                          "95 %",     "COV, %", "95 %"};
    std::vector<std::vector<std::string>> rows;
    for (const RepeatedQuantity& q : repeated_quantities) {
        const Scatter s = scatter_of(data, q);
        rows.push_back({fmt::format("{}, {}", q.name, q.unit), significant(q.scale * s.mean),
                        range(s.mean_interval, q.scale, 4), significant(q.scale * s.deviation, 3),
                        range(s.deviation_interval, q.scale, 3), significant(100 * s.variation, 3),
                        range(s.variation_interval, 100, 3)});
    }
    page.columns("What a run scatters by", header, rows);
    page.paragraph(
        "Deviation: standard deviation over <i>n</i> − 1; COV: deviation over mean. Intervals hold "
        "95 % for normal values: of the mean Student’s <i>t</i>, of the deviation chi-square; that "
        "of the COV is the deviation’s over the mean.",
        "note");
}

void add_repeats(Page& page, const RepeatsData& data) {
    const std::vector<std::string> header{"repeat",        "largest <i>q</i>, kPa",
                                          "at, %",         "<i>E</i><sub>50</sub>, MPa",
                                          "φ, degrees",    "it is a",
                                          "ended because", "steps",
                                          "state hash"};
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < data.repeats.size(); ++k) {
        const Repeat& r = data.repeats[k];
        std::vector<std::string> row{fmt::format("{}", k)};
        for (const std::size_t q : {0, 3, 1, 2})
            row.push_back(significant(repeated_quantities[q].scale *
                                      r.results.*repeated_quantities[q].value));
        row.emplace_back(failure_name(r.results.failure));
        row.push_back(escape(end_in_words(r.end_reason)));
        row.push_back(count(static_cast<double>(r.steps)));
        row.push_back(fmt::format("<code>{}</code>", escape(r.state_hash)));
        rows.push_back(std::move(row));
    }
    page.columns("The repeats", header, rows);
}

std::string repeats_page(const RepeatsData& data) {
    const Gnuplot gnuplot;
    const Scatter peak = scatter_of(data, repeated_quantities[0]);
    const Scatter modulus = scatter_of(data, repeated_quantities[1]);
    const std::string folder =
        escape(std::filesystem::weakly_canonical(data.path).filename().string());
    Page page(
        fmt::format("Grainfield report · repeats “{}”", folder),
        data.case_words.empty()
            ? "Repeats of a triaxial test"
            : fmt::format("Repeats of a triaxial test: {}", escape(data.case_words)),
        fmt::format(
            "{} tests of one sample, whose start positions differ by 10<sup>−12</sup> m at most, "
            "scatter by <b>{} %</b> of the largest deviator stress (mean {} kPa) and by "
            "<b>{} %</b> of <i>E</i><sub>50</sub> (mean {} MPa): one standard deviation.",
            data.repeats.size(), significant(100 * peak.variation, 2),
            significant(1e-3 * peak.mean), significant(100 * modulus.variation, 2),
            significant(1e-6 * modulus.mean)));
    if (data.without_peak > 0)
        page.paragraph(
            fmt::format("No peak was found in {} of {} repeats: they ended before <i>q</i> had "
                        "fallen for good or levelled off. Their largest <i>q</i> is that up to the "
                        "strain at which they ended and may be too low.",
                        data.without_peak, data.repeats.size()),
            "warning");
    page.section("Results");
    add_scatter(page, data);
    page.section("Stress and strain");
    page.figures(std::array{repeats_figure(gnuplot, data)}, "wide");
    page.section("Each repeat");
    add_repeats(page, data);
    page.paragraph(
        "Repeat <i>K</i> has its files in the folder <code>repeatK</code>; <code>grainfield report "
        "DIR/repeatK</code> makes its own page. Repeat 0 starts from the sample as it is: it is "
        "the run that the same command makes without <code>--repeats</code>.",
        "note");
    page.section("Parameters");
    page.listing(data.config);
    return page.html();
}

}  // namespace

std::filesystem::path write_repeats_report(const std::filesystem::path& dir) {
    const RepeatsData data = read_repeats(dir);
    const std::filesystem::path path = dir / "report.html";
    core::write_file_atomically(path, repeats_page(data));
    return path;
}

}  // namespace grainfield::triaxial
