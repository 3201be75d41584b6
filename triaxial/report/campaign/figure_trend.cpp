#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/natural_order.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

constexpr int trend_width = 1000;            ///< of the figure [px]
constexpr std::size_t legend_letters = 140;  ///< of a name in the legend: they fill a row

/// The range of an axis, with room at both ends.
struct TrendAxis {
    bool logarithmic;
    double span;       ///< of the values, or of their logarithms
    double low, high;  ///< with the room

    TrendAxis(double least, double most, double room, bool log)
        : logarithmic(log),
          span(log            ? std::log(most / least)
               : most > least ? most - least
                              : 1.0),
          low(shifted(least, -room)),
          high(shifted(most, room)) {}
    /// By a share of the axis.
    double shifted(double x, double share) const {
        return logarithmic ? x * std::exp(share * span) : x + share * span;
    }
};

/// From the least to the greatest of some values.
class ValueRange {
  public:
    void take(double value) {
        if (!std::isfinite(value)) return;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    /// With some room, which does not go below zero where no value does.
    std::pair<double, double> with_room() const {
        if (low_ > high_) return {0, 1};
        const double span = high_ > low_ ? high_ - low_ : std::max(std::abs(high_), 1e-300);
        const double low = low_ - 0.06 * span;
        return {low_ >= 0 ? std::max(low, 0.0) : low, high_ + 0.06 * span};
    }

  private:
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

/// Columns and height of a legend. gnuplot gives it the columns that fit over one panel; a single
/// one may be as wide as the figure.
struct TrendLegend {
    std::size_t columns = 1;
    double height = 0;  ///< [px]

    TrendLegend(const std::vector<std::string>& names, bool deterministic) {
        constexpr double letter = 7, sample = 50, row = 16, panel = 410;  // [px]
        std::size_t longest = deterministic ? std::string_view("deterministic").size() : 0;
        for (const std::string& name : names) longest = std::max(longest, characters(name));
        const double column = letter * static_cast<double>(longest) + sample;
        const std::size_t entries = names.size() + (deterministic ? 1 : 0);
        columns = std::clamp<std::size_t>(static_cast<std::size_t>(panel / column), 1, entries);
        height = row * static_cast<double>((entries + columns - 1) / columns) + 8;
    }
};

}  // namespace

std::vector<Trend> trends_over(const CampaignData& data, const std::string& key) {
    std::map<std::string, Trend> lines;  // by the exact values of the other keys
    for (std::size_t c = 0; c < data.cases.size(); ++c) {
        const CaseData& one = data.cases[c];
        const auto at = one.values.find(key);
        const auto x = at == one.values.end() ? std::nullopt : axis_value(at->second);
        if (!x || one.rows.size() < 2) continue;
        std::string others, name;
        for (const std::string& other : data.varying) {
            if (other == key) continue;
            const auto value = one.values.find(other);
            const auto toml =
                value == one.values.end() ? std::nullopt : std::optional(value->second);
            others += toml.value_or("") + "\n";
            name += (name.empty() ? "" : ", ") + value_in_words(other, toml);
        }
        Trend& line = lines[others];
        line.name = name;
        line.points.push_back({*x * axis_name(key).scale, c});
    }
    std::vector<Trend> trends;
    for (auto& [others, line] : lines) {
        if (line.points.size() < 2) continue;
        std::ranges::sort(line.points, {}, &Trend::Point::x);
        trends.push_back(std::move(line));
    }
    std::ranges::sort(trends, natural_less, &Trend::name);
    return trends;
}

Figure trend_figure(const Gnuplot& gnuplot, const std::string& id, std::size_t q,
                    const AxisName& axis, std::span<const Trend> trends,
                    const CampaignStatistics& all) {
    const Quantity& quantity = quantities[q];
    DataBlock rows;
    std::vector<std::string> names;
    std::vector<double> x;
    for (const Trend& trend : trends)
        for (const Trend::Point& point : trend.points) x.push_back(point.x);
    const auto [least, most] = std::ranges::minmax(x);
    const bool wide = least > 0 && most / least > 20;
    const TrendAxis across(least, most, 0.06, wide);
    ValueRange means, deviations;
    deviations.take(0);
    bool deterministic = false;
    for (std::size_t t = 0; t < trends.size(); ++t) {
        // Side by side: intervals of several cases at one value hide each other.
        const double pace = std::min(0.012, 0.06 / static_cast<double>(trends.size()));
        const double shift =
            pace * (static_cast<double>(t) - 0.5 * static_cast<double>(trends.size() - 1));
        for (const Trend::Point& point : trends[t].points) {
            const CaseStatistics& s = all[point.case_index][q];
            const double deviation = *s.deviation;
            const auto interval =
                s.deviation_interval.value_or(statistics::Interval{deviation, deviation});
            rows.row(across.shifted(point.x, shift), *s.mean, s.mean_interval->lower,
                     s.mean_interval->upper, deviation, interval.lower, interval.upper,
                     s.deterministic.value_or(std::numeric_limits<double>::quiet_NaN()));
            for (const double mean : {s.mean_interval->lower, s.mean_interval->upper})
                means.take(mean);
            deviations.take(interval.upper);
            if (s.deterministic) {
                means.take(*s.deterministic);
                deterministic = true;
            }
        }
        rows.end_part();
        names.push_back(trends[t].name.empty() ? "mean"
                                               : shortened(trends[t].name, legend_letters));
    }
    const TrendLegend legend(names, deterministic);
    const double height = 340 + legend.height;
    const auto [low, high] = means.with_room();
    return {gnuplot.svg("figure_trend", id, "Mean and deviation against " + axis.text,
                        {trend_width, static_cast<int>(height)},
                        {{"trends", rows},
                         {"name", names},
                         {"columns", legend.columns},
                         {"upper", 1 - (10 + legend.height) / height},
                         {"lower", 62 / height},
                         {"has_deterministic", deterministic},
                         {"wide", wide},
                         {"left", across.low},
                         {"right", across.high},
                         {"low", low},
                         {"high", high},
                         {"most", deviations.with_room().second},
                         axis.markup ? GnuplotVariable("axis", *axis.markup)
                                     : GnuplotVariable("axis", axis.text),
                         {"symbol", quantity.symbol},
                         {"unit", quantity.unit}}),
            fmt::format("Mean and standard deviation of the {} with 95 % intervals (Student’s t; "
                        "bootstrap); dashed: the deterministic runs.",
                        quantity.name)};
}

}  // namespace grainfield::triaxial::report
