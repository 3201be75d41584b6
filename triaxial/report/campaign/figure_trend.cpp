#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Text between gnuplot's single quotes; TOML's own quotes are left out.
std::string quoted(std::string text) {
    std::erase(text, '"');
    for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\'');
    return "'" + text + "'";
}

constexpr std::array line_colours{colour::main,  colour::contrast, std::string_view("#3c7a4e"),
                                  colour::muted, colour::soft,     std::string_view("#8a5a9e")};

}  // namespace

AxisName axis_name(const std::string& key) {
    if (key == "field.stiffness.cov") return {"COV of k_n (-)"};
    if (key == "field.correlation_length") return {"Correlation length θ_y (m)"};
    if (key == "triaxial.confining_stress") return {"Confining stress σ_3 (kPa)", 1e-3};
    if (key == "particle.friction_angle") return {"Friction angle φ (rad)"};
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
                    const std::string& label, std::span<const Trend> trends,
                    const CampaignStatistics& all) {
    const Quantity& quantity = quantities[q];
    std::string means, deviations;
    double least = 1e300, most = -1e300;
    for (std::size_t t = 0; t < trends.size(); ++t) {
        std::string rows;
        bool deterministic = false;
        for (const Trend::Point& point : trends[t].points) {
            const CaseStatistics& s = all[point.case_index][q];
            const double deviation = *s.deviation;
            const auto interval =
                s.deviation_interval.value_or(statistics::Interval{deviation, deviation});
            deterministic |= s.deterministic.has_value();
            rows +=
                fmt::format("{} {} {} {} {} {} {} {}\n", point.x, *s.mean, s.mean_interval->lower,
                            s.mean_interval->upper, deviation, interval.lower, interval.upper,
                            s.deterministic ? fmt::format("{}", *s.deterministic) : "NaN");
            least = std::min(least, point.x);
            most = std::max(most, point.x);
        }
        const std::string file = fmt::format("{}-{}.dat", id, t);
        gnuplot.data(file, rows);
        const auto line = line_colours[t % line_colours.size()];
        const std::string title = trends[t].name.empty() ? "mean" : trends[t].name;
        means += fmt::format(
            "{}'{}' using 1:2:3:4 with yerrorlines pt 7 ps 0.6 lw 1.6 lc rgb '{}' title {}",
            t == 0 ? "" : ", \\\n     ", file, line, quoted(title));
        if (deterministic)
            means += fmt::format(
                ", \\\n     '{}' using 1:8 with lines dt 2 lw 1.2 lc rgb '{}' title '{}'", file,
                line, t == 0 ? "deterministic" : "");
        deviations += fmt::format(
            "{}'{}' using 1:5:6:7 with yerrorlines pt 7 ps 0.6 lw 1.6 lc rgb '{}' notitle",
            t == 0 ? "" : ", \\\n     ", file, line);
    }
    const bool wide = least > 0 && most / least > 20;
    const std::string script = fmt::format(
        R"(set multiplot layout 1,2
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
{log}
set xlabel '{label}' offset 0,0.3
set key noenhanced above left font ',11' maxrows 6
set ylabel 'Mean of {symbol} ({unit})' offset 0.5,0
plot {means}
set offsets graph 0.05, graph 0.05, graph 0.05, 0
set yrange [0:*]
set ylabel 'Standard deviation of {symbol} ({unit})' offset 0.5,0
plot {deviations}
unset multiplot
)",
        fmt::arg("log", wide ? "set logscale x" : ""), fmt::arg("label", label),
        fmt::arg("symbol", quantity.symbol), fmt::arg("unit", quantity.unit),
        fmt::arg("means", means), fmt::arg("deviations", deviations));
    return {gnuplot.svg(id, "Mean and deviation against " + label, {1000, 380}, script),
            fmt::format("Mean and standard deviation of the {} with 95 % intervals (Student’s t; "
                        "bootstrap); dashed: the deterministic runs.",
                        quantity.name)};
}

}  // namespace grainfield::triaxial::report
