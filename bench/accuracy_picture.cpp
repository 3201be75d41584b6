#include "bench/accuracy_picture.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace grainfield::bench {
namespace {

using triaxial::report::DataBlock;

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

/// Time, error, point type and mass scaling, a row a case; a blank row between groups that a line
/// connects: cases that differ in safety alone.
void add_points(std::span<const Case> cases, Deviation Case::*result, double lowest,
                DataBlock& rows) {
    const Case* before = nullptr;
    for (const Case& c : cases) {
        if (c.runs.empty()) continue;
        if (before) {
            Setting s = before->setting;
            s.safety = c.setting.safety;
            if (s != c.setting) rows.end_row();
        }
        rows.row(c.cpu_seconds, std::max((c.*result).one_run, lowest), point_type(c.setting),
                 c.setting.mass_scaling);
        before = &c;
    }
    rows.end_part();
}

/// The front as stairs that go on to the right edge. What lies below the floor lies there by chance
/// and counts as on it.
void add_front(const Panel& panel, Deviation Case::*result, double floor, double last,
               DataBlock& rows) {
    std::vector<Point> points;
    for (const Case& c : panel.cases)
        if (!c.runs.empty() && c.setting != panel.noise->setting)
            points.push_back({c.cpu_seconds, std::max((c.*result).one_run, floor)});
    const std::vector<Point> front = pareto_front(std::move(points));
    for (const Point& p : front) rows.row(p.seconds, p.error);
    if (!front.empty()) rows.row(last, front.back().error);
    rows.end_part();
}

const Case* find(std::span<const Case> cases, const Setting& setting) {
    for (const Case& c : cases)
        if (c.setting == setting && !c.runs.empty()) return &c;
    return nullptr;
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

std::string accuracy_picture(std::span<const Panel> panels) {
    const Axes axes = axes_of(panels);
    std::vector<std::string> series;
    DataBlock rows, points, fronts;
    for (const Panel& panel : panels) {
        const Case* shown = find(panel.cases, default_setting);
        for (const auto result : {&Case::peak, &Case::E50}) {
            const Deviation& noise = panel.noise->*result;
            for (const double number :
                 {static_cast<double>(series.size()), result == &Case::E50 ? 1.0 : 0.0,
                  noise.scatter, panel.noise->cpu_seconds, noise.one_run})
                rows.add(number);
            if (shown != nullptr) {
                rows.add(shown->cpu_seconds);
                rows.add(std::max((shown->*result).one_run, axes.lowest));
            }
            rows.end_row();
            add_points(panel.cases, result, axes.lowest, points);
            add_front(panel, result, noise.scatter, axes.last, fronts);
        }
        series.push_back(panel.series->name);
    }
    return triaxial::report::Gnuplot(gnuplot_templates())
        .png("accuracy_picture", "accuracy", {1500, 1250},
             {{"series", series},
              {"panels", rows},
              {"points", points},
              {"fronts", fronts},
              {"first_time", axes.first},
              {"last_time", axes.last},
              {"lowest", axes.lowest},
              {"highest", axes.highest}});
}

}  // namespace grainfield::bench
