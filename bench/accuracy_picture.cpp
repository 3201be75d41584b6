#include "bench/accuracy_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace grainfield::bench {
namespace {

namespace colour = triaxial::report::colour;

std::string_view rate_colour(double rate) {
    return rate < 0.03    ? colour::ink
           : rate < 0.075 ? colour::muted
           : rate < 0.15  ? colour::main
           : rate < 0.3   ? colour::soft
                          : colour::contrast;
}

/// gnuplot's point type: circle, triangle, square by mass scaling; filled in mixed precision, open
/// in double; the reference kernels have a cross.
int point_type(const Setting& s) {
    if (s.reference_kernels) return 2;
    const int filled = s.mass_scaling < 1.5 ? 7 : s.mass_scaling < 3 ? 9 : 5;
    return s.precision == core::Precision::mixed ? filled : filled - 1;
}

struct Axes {
    double first, last;      ///< time [s]
    double lowest, highest;  ///< error; smaller ones are drawn on the axis [%]
};

struct Point {
    double seconds, error;
};

/// Points that no other beats in both, from the fastest on.
std::vector<Point> pareto_front(std::vector<Point> points) {
    std::ranges::sort(points, [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
    std::vector<Point> front;
    for (const Point& p : points)
        if (front.empty() || p.error < front.back().error) front.push_back(p);
    return front;
}

/// Columns: time, error, point type, colour, a line a case; a blank line between groups that a line
/// connects: cases that differ in safety alone.
std::string points_data(std::span<const Case> cases, Deviation Case::*result, double lowest) {
    std::string rows;
    const Case* before = nullptr;
    for (const Case& c : cases) {
        if (c.runs.empty()) continue;
        if (before) {
            Setting s = before->setting;
            s.safety = c.setting.safety;
            if (s != c.setting) rows += "\n";
        }
        rows += fmt::format("{} {} {} 0x{}\n", c.cpu_seconds, std::max((c.*result).one_run, lowest),
                            point_type(c.setting), rate_colour(c.setting.strain_rate).substr(1));
        before = &c;
    }
    return rows;
}

/// The front as stairs that go on to the right edge. What lies below the floor lies there by chance
/// and counts as on it.
std::string front_data(const Panel& panel, Deviation Case::*result, double floor, double last) {
    std::vector<Point> points;
    for (const Case& c : panel.cases)
        if (!c.runs.empty() && c.setting != panel.noise->setting)
            points.push_back({c.cpu_seconds, std::max((c.*result).one_run, floor)});
    std::string rows;
    const std::vector<Point> front = pareto_front(std::move(points));
    for (const Point& p : front) rows += fmt::format("{} {}\n", p.seconds, p.error);
    return front.empty() ? rows : rows + fmt::format("{} {}\n", last, front.back().error);
}

const Case* find(std::span<const Case> cases, const Setting& setting) {
    for (const Case& c : cases)
        if (c.setting == setting && !c.runs.empty()) return &c;
    return nullptr;
}

/// One panel of the picture, between those parts of the screen.
std::string panel_script(const triaxial::report::Gnuplot& gnuplot, const Panel& panel,
                         const std::string& name, Deviation Case::*result, const Axes& axes,
                         std::array<double, 4> screen, bool left, bool bottom) {
    const double floor = (panel.noise->*result).scatter;
    gnuplot.data(name + ".dat", points_data(panel.cases, result, axes.lowest));
    gnuplot.data(name + "_front.dat", front_data(panel, result, floor, axes.last));
    std::string script = fmt::format(
        R"(set lmargin at screen {}
set rmargin at screen {}
set bmargin at screen {}
set tmargin at screen {}
set xrange [{first}:{last}]
set yrange [{lowest}:{top}]
unset label
unset arrow
unset object
set object 1 rectangle from {first},{lowest} to {last},{floor} fc rgb '{grid}' fs solid noborder behind
set label 1 'noise floor: scatter of one reference run, {floor:.1f} %' at graph 0.02, graph 0.04 left tc rgb '{muted}'
set label 2 '{series}: {what}' at graph 0.98, graph 0.95 right tc rgb '{ink}'
set xlabel '{xlabel}'
set ylabel '{ylabel}' offset 1,0
set format x '{xformat}'
set format y '{yformat}'
)",
        screen[0], screen[1], screen[2], screen[3], fmt::arg("first", axes.first),
        fmt::arg("last", axes.last), fmt::arg("lowest", axes.lowest), fmt::arg("top", axes.highest),
        fmt::arg("floor", floor), fmt::arg("grid", colour::grid), fmt::arg("muted", colour::muted),
        fmt::arg("ink", colour::ink), fmt::arg("series", panel.series->name),
        fmt::arg("what", result == &Case::peak ? "peak deviator stress" : "{/:Italic E}_{50}"),
        fmt::arg("xlabel", bottom ? "Time of a realization on one core (s)" : ""),
        fmt::arg("ylabel", left ? "Error of one run (%)" : ""),
        fmt::arg("xformat", bottom ? "%g" : ""), fmt::arg("yformat", left ? "%g" : ""));
    script +=
        fmt::format("set label 3 'reference' at {},{} right offset 1.5,-1 tc rgb '{}' front\n",
                    panel.noise->cpu_seconds, (panel.noise->*result).one_run, colour::muted);
    if (const Case* c =
            find(panel.cases, default_setting))  // faster runs do worse: room below left
        script += fmt::format(
            "set label 4 'default' at graph 0.03,0.33 left tc rgb '{2}' front\n"
            "set arrow 1 from graph 0.155,0.345 to {0},{1} nohead lw 1.2 lc rgb '{2}' back\n"
            "set label 5 '' at {0},{1} point pt 6 ps 3.4 lw 2.5 lc rgb '{2}' front\n",
            c->cpu_seconds, std::max((c->*result).one_run, axes.lowest), colour::ink);
    script += fmt::format(
        "plot '{0}_front.dat' using 1:2 with steps lw 2 dt (6,4) lc rgb '{1}' notitle, \\\n"
        "     '{0}.dat' using 1:2:4 with lines lw 1 lc rgb variable notitle, \\\n"
        "     '{0}.dat' using 1:2:(1.5):3:4 with points ps variable pt variable lw 1.6 lc rgb "
        "variable notitle\n",
        name, colour::muted);
    return script;
}

/// One row of the legend, drawn as a plot without axes.
std::string legend_script() {
    struct Entry {
        double x, y;
        int type;
        std::string_view colour;
        std::string_view text;
    };
    const std::array<Entry, 13> entries{{
        {0.02, 0.75, 7, rate_colour(0.02), "rate 0.02/s"},
        {0.15, 0.75, 7, rate_colour(0.05), "0.05/s"},
        {0.235, 0.75, 7, rate_colour(0.1), "0.1/s"},
        {0.31, 0.75, 7, rate_colour(0.2), "0.2/s"},
        {0.385, 0.75, 7, rate_colour(0.4), "0.4/s"},
        {0.45, 0.75, 0, colour::ink, "lines: other safety, 0.2 to 0.95 of the limit"},
        {0.88, 0.75, 0, colour::ink, "Pareto front"},
        {0.02, 0.25, 7, colour::ink, "mixed precision"},
        {0.19, 0.25, 6, colour::ink, "double precision"},
        {0.365, 0.25, 2, colour::ink, "reference kernels"},
        {0.55, 0.25, 7, colour::ink, "real masses"},
        {0.69, 0.25, 9, colour::ink, "mass scaling 2"},
        {0.85, 0.25, 5, colour::ink, "mass scaling 4"},
    }};
    std::string rows, labels;
    int tag = 10;
    for (const Entry& e : entries) {
        if (e.type != 0)
            rows += fmt::format("{} {} {} 0x{}\n", e.x, e.y, e.type, e.colour.substr(1));
        labels += fmt::format("set label {} '{}' at {},{} left offset 1.4,0 tc rgb '{}'\n", tag++,
                              e.text, e.x, e.y, colour::ink);
    }
    return fmt::format(
        "$legend << EOD\n{}EOD\n"
        "set lmargin at screen 0.08\nset rmargin at screen 0.99\n"
        "set bmargin at screen 0.005\nset tmargin at screen 0.075\n"
        "unset logscale\nunset border\nunset tics\nunset grid\nunset label\nunset object\n"
        "unset arrow\nset xlabel ''\nset ylabel ''\nset xrange [0:1]\nset yrange [0:1]\n{}"
        "set arrow 1 from 0.845,0.75 to 0.885,0.75 nohead lw 2 dt (6,4) lc rgb '{}'\n"
        "plot $legend using 1:2:(1.5):3:4 with points ps variable pt variable lw 1.6 lc rgb "
        "variable notitle\n",
        rows, labels, colour::muted);
}

Axes axes_of(std::span<const Panel> panels) {
    Axes axes{.first = 1e9, .last = 0, .lowest = 1e9, .highest = 0};
    for (const Panel& panel : panels) {
        for (const Deviation& noise : {panel.noise->peak, panel.noise->E50})
            axes.lowest = std::min(axes.lowest, std::max(0.4 * noise.scatter, 0.01));
        for (const Case& c : panel.cases) {
            if (c.runs.empty()) continue;
            axes.first = std::min(axes.first, c.cpu_seconds / 1.25);
            axes.last = std::max(axes.last, c.cpu_seconds * 1.25);
            axes.highest = std::max({axes.highest, 1.6 * c.peak.one_run, 1.6 * c.E50.one_run});
        }
    }
    return axes;
}

}  // namespace

std::string accuracy_script(const triaxial::report::Gnuplot& gnuplot,
                            std::span<const Panel> panels) {
    const Axes axes = axes_of(panels);
    std::string script =
        "set multiplot\nset logscale xy\n"
        "set xtics (0.2,0.5,1,2,5,10,20,50,100,200,500)\n"
        "set ytics (0.1,0.2,0.5,1,2,5,10,20,50,100)\n";
    const double height = (0.985 - 0.15) / static_cast<double>(panels.size());
    for (std::size_t row = 0; row < panels.size(); ++row) {
        const double top = 0.985 - static_cast<double>(row) * height;
        const bool bottom = row + 1 == panels.size();
        for (const bool left : {true, false})
            script += panel_script(
                gnuplot, panels[row], fmt::format("{}_{}", left ? "peak" : "E50", row),
                left ? &Case::peak : &Case::E50, axes,
                {left ? 0.075 : 0.545, left ? 0.52 : 0.99, top - height + 0.02, top}, left, bottom);
    }
    return script + legend_script() + "unset multiplot\n";
}

}  // namespace grainfield::bench
