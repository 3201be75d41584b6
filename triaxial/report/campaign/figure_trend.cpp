#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "core/files/text_file.hpp"
#include "triaxial/report/campaign/campaign_figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

/// The number that a key's value stands for: itself, or the second of three.
std::optional<double> axis_value(const std::string& toml) {
    std::string_view text = toml;
    double value = 0;
    if (core::parse_number(text, value)) return value;
    if (text.size() < 2 || text.front() != '[' || text.back() != ']') return std::nullopt;
    text = text.substr(1, text.size() - 2);
    core::next_field(text, ',');
    const std::string_view second = core::trim(core::next_field(text, ','));
    if (!core::parse_number(second, value) || text.empty()) return std::nullopt;
    return value;
}

std::string short_name(const std::string& key) {
    return key.substr(key.rfind('.') + 1);
}

}  // namespace

AxisName axis_name(const std::string& key) {
    const auto known = [](Markup markup, double scale = 1) -> AxisName {
        return {std::string(markup.text), scale, markup};
    };
    if (key == "field.stiffness.cov") return known("COV of k_n (-)");
    if (key == "field.correlation_length") return known("Correlation length θ_y (m)");
    if (key == "triaxial.confining_stress") return known("Confining stress σ_3 (kPa)", 1e-3);
    if (key == "particle.friction_angle") return known("Friction angle φ (rad)");
    std::string text = key;
    std::replace(text.begin(), text.end(), '_', ' ');
    return {text};
}

std::vector<Trend> trends_over(const CampaignData& data, const std::string& key) {
    std::map<std::string, Trend> lines;
    for (std::size_t c = 0; c < data.cases.size(); ++c) {
        const CaseData& one = data.cases[c];
        const auto at = one.values.find(key);
        const auto x = at == one.values.end() ? std::nullopt : axis_value(at->second);
        if (!x || one.rows.size() < 2) continue;
        std::string others;
        for (const std::string& other : data.varying) {
            if (other == key) continue;
            const auto value = one.values.find(other);
            others += fmt::format("{}{} = {}", others.empty() ? "" : ", ", short_name(other),
                                  value == one.values.end() ? "not set" : value->second);
        }
        Trend& line = lines[others];
        line.name = others;
        line.points.push_back({*x * axis_name(key).scale, c});
    }
    std::vector<Trend> trends;
    for (auto& [name, line] : lines) {
        if (line.points.size() < 2) continue;
        std::ranges::sort(line.points, {}, &Trend::Point::x);
        trends.push_back(std::move(line));
    }
    return trends;
}

Figure trend_figure(const Gnuplot& gnuplot, const std::string& id, std::size_t q,
                    const AxisName& axis, std::span<const Trend> trends,
                    const CampaignStatistics& all) {
    const Quantity& quantity = quantities[q];
    DataBlock rows;
    std::vector<std::string> names;
    double least = 1e300, most = -1e300;
    bool deterministic = false;
    for (const Trend& trend : trends) {
        for (const Trend::Point& point : trend.points) {
            const CaseStatistics& s = all[point.case_index][q];
            const double deviation = *s.deviation;
            const auto interval =
                s.deviation_interval.value_or(statistics::Interval{deviation, deviation});
            deterministic |= s.deterministic.has_value();
            rows.row(point.x, *s.mean, s.mean_interval->lower, s.mean_interval->upper, deviation,
                     interval.lower, interval.upper,
                     s.deterministic.value_or(std::numeric_limits<double>::quiet_NaN()));
            least = std::min(least, point.x);
            most = std::max(most, point.x);
        }
        rows.end_part();
        std::string name = trend.name.empty() ? "mean" : trend.name;
        std::erase(name, '"');  // TOML's own
        names.push_back(std::move(name));
    }
    const bool wide = least > 0 && most / least > 20;
    return {gnuplot.svg("figure_trend", id, "Mean and deviation against " + axis.text, {1000, 380},
                        {{"trends", rows},
                         {"name", names},
                         {"has_deterministic", deterministic},
                         {"wide", wide},
                         axis.markup ? GnuplotVariable("axis", *axis.markup)
                                     : GnuplotVariable("axis", axis.text),
                         {"symbol", quantity.symbol},
                         {"unit", quantity.unit}}),
            fmt::format("Mean and standard deviation of the {} with 95 % intervals (Student’s t; "
                        "bootstrap); dashed: the deterministic runs.",
                        quantity.name)};
}

}  // namespace grainfield::triaxial::report
