#include "triaxial/report/box_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

/// The nine edges of the box in front, and its three sizes along them.
std::string edges_and_sizes(const core::Box& box, const Camera& camera) {
    constexpr std::pair<std::size_t, std::size_t> edges[]{{4, 5}, {5, 1}, {6, 7}, {7, 3}, {3, 2},
                                                          {2, 6}, {4, 6}, {5, 7}, {1, 3}};
    const auto corner = corners(box);
    const auto at = [&](const Vec3& p) {
        return fmt::format("{:.5f},{:.5f}", camera.right(p), camera.up(p));
    };
    std::string script;
    for (const auto& [from, to] : edges)
        script += fmt::format("set arrow from {} to {} nohead front lw 1 lc rgb '#80384048'\n",
                              at(corner[from]), at(corner[to]));
    const Vec3 size = box.size();
    const auto label = [&](std::size_t from, std::size_t to, char axis, double length,
                           std::string_view place) {
        const Vec3 middle = 0.5 * (corner[from] + corner[to]);
        script += fmt::format("set label '{{/:Italic {}}}  {} m' at {} {} tc rgb '{}'\n", axis,
                              significant(length, 3), at(middle), place, colour::ink);
    };
    label(4, 5, 'x', size.x(), "right offset -0.2,-1.1");
    label(4, 6, 'y', size.y(), "center rotate by 90 offset -1.4,0");
    label(5, 1, 'z', size.z(), "left offset 0.6,-1.1");
    return script;
}

/// Ticks at 1, 2 and 5 of each decade; decades alone where there are many.
std::string log_ticks(double lowest, double highest) {
    const double decades = std::log10(highest / lowest);
    std::string ticks;
    for (double power = std::pow(10, std::floor(std::log10(lowest))); power <= highest;
         power *= 10) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            if ((decades > 3 && digit != 1.0) || digit * power < lowest || digit * power > highest)
                continue;
            ticks += fmt::format("{}{}", ticks.empty() ? "" : ", ", digit * power);
        }
    }
    return ticks.empty() ? "" : fmt::format("({})", ticks);
}

}  // namespace

BoxFrame box_frame(const core::Box& box, const Camera& camera, const Colouring& colouring) {
    double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
    for (const Vec3& p : corners(box)) {
        left = std::min(left, camera.right(p));
        right = std::max(right, camera.right(p));
        bottom = std::min(bottom, camera.up(p));
        top = std::max(top, camera.up(p));
    }
    const double extent = std::max(right - left, top - bottom);
    left -= 0.035 * extent;
    right += 0.015 * extent;
    bottom -= 0.02 * extent;
    top += 0.015 * extent;

    // The plot's pixels are square in metres; the scale's bar stands to the right of it.
    constexpr int longest = 1120;
    BoxFrame frame;
    frame.pixel = std::max(right - left, top - bottom) / longest;
    const int width = static_cast<int>((right - left) / frame.pixel);
    const int bar = colouring.has_scale() ? 150 : 0;
    frame.size = {width + bar, static_cast<int>((top - bottom) / frame.pixel)};
    const double share = static_cast<double>(width) / (width + bar);

    frame.script = edges_and_sizes(box, camera);
    frame.script += fmt::format(
        R"(unset border
unset tics
unset grid
unset key
set lmargin at screen 0
set rmargin at screen {share}
set tmargin at screen 1
set bmargin at screen 0
set xrange [{left}:{right}]
set yrange [{bottom}:{top}]
set style fill solid noborder
)",
        fmt::arg("share", share), fmt::arg("left", left), fmt::arg("right", right),
        fmt::arg("bottom", bottom), fmt::arg("top", top));
    if (!colouring.has_scale()) return frame;
    frame.script += fmt::format(
        "set palette {}\nset cbrange [{}:{}]\n{}"
        "set cbtics out scale 0.5 {}\n"
        "set cblabel '{}' offset 0.8,0\n"
        "set colorbox user origin screen {},0.3 size screen {},0.4 noborder\n",
        Colouring::gnuplot_palette(), colouring.lowest(), colouring.highest(),
        colouring.logarithmic() ? "set logscale cb\n" : "",
        colouring.logarithmic() ? log_ticks(colouring.lowest(), colouring.highest()) : "",
        colouring.label(), share + 0.012, 20.0 / (width + bar));
    frame.scale = fmt::format("'+' using ({}):({}):({}) with points pt 7 ps 0.01 lc palette",
                              left - extent, bottom - extent, colouring.lowest());
    return frame;
}

}  // namespace grainfield::triaxial::report
