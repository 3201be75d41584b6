#include "triaxial/report/field/field_verdicts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "triaxial/report/field/field_figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

using randomfield::Estimate;
using randomfield::FieldCheck;

Verdict correlation_verdict(const FieldCheck& check, const std::string& name) {
    std::size_t lags = 0, outside = 0;
    double worst = 0, error = 0;  // by the band
    std::string where;
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t h = 0; h < check.correlation[d].size(); ++h) {
            const Estimate& one = check.correlation[d][h];
            ++lags;
            if (!one.inside()) ++outside;
            if (one.of_band() < worst) continue;
            worst = one.of_band();
            error = one.estimate - one.exact;
            where = fmt::format("{} lag {}", "xyz"[d], h);
        }
    }
    return {
        "correlation" + name,
        fmt::format("{} of {} lags outside the 99 % band; furthest {:+.4f} at {}, {:.2f} of the "
                    "band",
                    outside, lags, error, where, worst),
        outside == 0};
}

Verdict variance_verdict(const randomfield::VarianceMap& map, const std::string& name) {
    return {name,
            fmt::format("{} of {} cells outside {:.3f} ... {:.3f} of the exact (99 %, all "
                        "together); {:.1f} % outside the 95 % band of one cell",
                        map.outside, map.ratio.size(), map.low, map.high,
                        100 * map.share_outside_single),
            map.outside == 0};
}

void add_histogram(std::vector<Verdict>& all, const FieldCheck& check, const std::string& name) {
    const randomfield::HistogramCheck& histogram = *check.histogram;
    std::size_t outside = 0;
    for (const Estimate& share : histogram.shares) outside += share.inside() ? 0 : 1;
    all.push_back({"histogram" + name,
                   fmt::format("{} of {} bins outside the 99 % band of the predicted distribution",
                               outside, histogram.shares.size()),
                   outside == 0});
    const DisplayUnit unit = display_unit(check.property);
    const auto text = [&](double value) { return significant(value / unit.size, 5); };
    const auto add = [&](const std::string& what, const Estimate& one, bool judged) {
        all.push_back(
            {what + name,
             fmt::format(
                 "{} {}, predicted {}, {}", text(one.estimate), unit.name, text(one.exact),
                 judged ? fmt::format("band {} ... {} (99 % with the other of "
                                      "mean and deviation)",
                                      text(one.low), text(one.high))
                        : "not judged: too heavy tails for so few realizations, or none at all"),
             !judged || one.inside()});
    };
    add("mean", histogram.mean, true);
    add("deviation", histogram.deviation, histogram.deviation_judged);
}

void add_data(std::vector<Verdict>& all, const randomfield::DataCheck& data,
              const std::string& name) {
    all.push_back(
        {"data" + name,
         fmt::format("{} cells with data, {} exact{}", data.cells, data.exact,
                     data.exact == 0 ? ""
                                     : fmt::format(": missed by {:.1e} of the value at most",
                                                   data.largest_miss)),
         data.largest_miss < 1e-9});
    all.push_back(
        {"conditional mean" + name,
         fmt::format("furthest of all cells {:.2f} standard errors, {:.2f} allowed (99 %)",
                     data.mean_off, data.mean_allowed),
         data.mean_off <= data.mean_allowed});
    all.push_back(variance_verdict(data.variance, "conditional variance" + name));
}

}  // namespace

std::vector<Verdict> verdicts(const randomfield::FieldGenerator& generator,
                              const randomfield::Verification& verification) {
    std::vector<Verdict> all;
    if (verification.covariance_error) {
        const double error = verification.covariance_error->covariance;
        const bool exact = generator.generator().exact();
        const double allowed = generator.generator().stated_error();
        all.push_back(
            {"covariance error",
             fmt::format("{:.2e} of gamma at most, by algebra: {} (documented: {:g})", error,
                         exact ? "an exact method" : "an approximating method", allowed),
             error <= allowed});
    }
    for (const FieldCheck& check : verification.fields) {
        const std::string name = ", " + property_name(check.property);
        all.push_back(correlation_verdict(check, name));
        all.push_back(variance_verdict(check.variance, "variance" + name));
        if (check.histogram) add_histogram(all, check, name);
        if (check.data) add_data(all, *check.data, name);
    }
    if (const auto& cross = verification.cross_correlation)
        all.push_back({"cross-correlation",
                       fmt::format("{:.4f}, asked for {:.4f}, band {:.4f} ... {:.4f} (99 %)",
                                   cross->estimate, cross->exact, cross->low, cross->high),
                       cross->inside()});
    return all;
}

}  // namespace grainfield::triaxial::report
