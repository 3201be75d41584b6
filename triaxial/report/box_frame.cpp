#include "triaxial/report/box_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;  // corners of the box
constexpr Pair front_edges[]{{4, 5}, {5, 1}, {6, 7}, {7, 3}, {3, 2},
                             {2, 6}, {4, 6}, {5, 7}, {1, 3}};
constexpr Pair sized_edges[]{{4, 5}, {4, 6}, {5, 1}};  // along x, y and z

/// Ticks at 1, 2 and 5 of each decade; decades alone where there are many.
DataBlock log_ticks(double lowest, double highest) {
    const double decades = std::log10(highest / lowest);
    DataBlock ticks;
    for (double power = std::pow(10, std::floor(std::log10(lowest))); power <= highest;
         power *= 10) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            if ((decades > 3 && digit != 1.0) || digit * power < lowest || digit * power > highest)
                continue;
            ticks.row(digit * power);
        }
    }
    return ticks;
}

}  // namespace

BoxFrame box_frame(const core::Box& box, const Camera& camera, const Colouring& colouring) {
    const auto corner = corners(box);
    double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
    for (const Vec3& p : corner) {
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

    DataBlock edges(5), middles(5);
    const auto add = [&](DataBlock& rows, const Vec3& p) {
        rows.add(camera.right(p));
        rows.add(camera.up(p));
    };
    for (const auto& [from, to] : front_edges) {
        add(edges, corner[from]);
        add(edges, corner[to]);
        edges.end_row();
    }
    for (const auto& [from, to] : sized_edges) {
        add(middles, 0.5 * (corner[from] + corner[to]));
        middles.end_row();
    }
    const double lowest = colouring.lowest(), highest = colouring.highest();
    const Vec3 size = box.size();
    frame.variables = {
        {"edges", edges},
        {"middles", middles},
        {"size_x", significant(size.x(), 3)},
        {"size_y", significant(size.y(), 3)},
        {"size_z", significant(size.z(), 3)},
        {"left", left},
        {"right", right},
        {"bottom", bottom},
        {"top", top},
        {"share", share},
        {"has_scale", colouring.has_scale()},
        {"palette", Colouring::palette()},
        {"lowest", lowest},
        {"highest", highest},
        {"logarithmic", colouring.logarithmic()},
        {"ticks", colouring.logarithmic() ? log_ticks(lowest, highest) : DataBlock()},
        {"quantity", colouring.label()},
        {"bar_width", 20.0 / (width + bar)}};
    return frame;
}

}  // namespace grainfield::triaxial::report
