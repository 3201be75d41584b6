#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "triaxial/report/colouring.hpp"
#include "triaxial/report/figures.hpp"
#include "triaxial/report/sample_view.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

constexpr Rgb black{0.09, 0.07, 0.06}, white{1, 1, 1};

/// A glow of a disc towards the light at the upper left: radius and shift over the disc's radius.
struct Glow {
    double radius, shift, white;
};
constexpr Glow glows[]{{0.72, 0.14, 0.10}, {0.46, 0.28, 0.22}, {0.22, 0.40, 0.42}};

/// Circles of one sphere from back to front: outline, body, glows.
void draw(const Disc& disc, const Rgb& colour, double pixel, std::string& rows) {
    const auto circle = [&](double x, double y, double radius, const Rgb& c) {
        fmt::format_to(std::back_inserter(rows), "{:.4f} {:.4f} {:.4f} {}\n", x, y, radius,
                       c.packed());
    };
    const Rgb lit = colour.times(disc.light);
    circle(disc.x, disc.y, disc.radius, lit.mixed(black, 0.62));
    circle(disc.x, disc.y, std::max(disc.radius - 1.1 * pixel, 0.6 * disc.radius), lit);
    for (const auto& [radius, shift, share] : glows)
        circle(disc.x - 0.7 * shift * disc.radius, disc.y + 0.7 * shift * disc.radius,
               radius * disc.radius, lit.mixed(white, share * disc.light));
}

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

std::string picture(const Gnuplot& gnuplot, const RunFolder& run, ColourBy by, int number) {
    const Camera camera;
    const Colouring colouring(run.spheres, by);
    double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
    for (const Vec3& p : corners(run.box)) {
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
    const double pixel = std::max(right - left, top - bottom) / longest;
    const int width = static_cast<int>((right - left) / pixel);
    const int height = static_cast<int>((top - bottom) / pixel);
    const int bar = colouring.has_scale() ? 150 : 0;
    const double share = static_cast<double>(width) / (width + bar);

    std::string rows;
    for (const Disc& disc : visible_discs(run.spheres, run.box, camera))
        draw(disc, colouring.colour(disc.sphere), pixel, rows);
    gnuplot.data("spheres.dat", rows);
    std::string script = edges_and_sizes(run.box, camera);
    script += fmt::format(
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
    std::string scale;
    if (colouring.has_scale()) {
        script += fmt::format(
            "set palette {}\nset cbrange [{}:{}]\n{}"
            "set cbtics out scale 0.5 {}\n"
            "set cblabel '{}' offset 0.8,0\n"
            "set colorbox user origin screen {},0.3 size screen {},0.4 noborder\n",
            Colouring::gnuplot_palette(), colouring.lowest(), colouring.highest(),
            colouring.logarithmic() ? "set logscale cb\n" : "",
            colouring.logarithmic() ? log_ticks(colouring.lowest(), colouring.highest()) : "",
            colouring.label(), share + 0.012, 20.0 / (width + bar));
        scale = fmt::format(", '+' using ({}):({}):({}) with points pt 7 ps 0.01 lc palette",
                            left - extent, bottom - extent, colouring.lowest());
    }
    script +=
        fmt::format("plot 'spheres.dat' using 1:2:3:4 with circles lc rgb variable{}\n", scale);
    const std::string png =
        gnuplot.png(fmt::format("sample_{}", number), {width + bar, height}, script);
    return fmt::format(
        "<img alt=\"The final sample seen from outside, {}\" width=\"{}\" height=\"{}\" "
        "src=\"data:image/png;base64,{}\">",
        escape(colouring.in_words()), width + bar, height, base64(png));
}

}  // namespace

Figure sample_figure(const Gnuplot& gnuplot, const RunFolder& run) {
    Figure figure;
    std::string words;
    int number = 0;
    for (const ColourBy by : colourings(run.spheres)) {
        figure.picture += picture(gnuplot, run, by, ++number);
        words += (words.empty() ? "" : "; ") + Colouring(run.spheres, by).in_words();
    }
    figure.caption = fmt::format(
        "The sample of {} spheres at the end of the test, {}. Outlines, gloss and the shade in "
        "gaps only give depth.",
        count(static_cast<double>(run.spheres.size())), escape(words));
    return figure;
}

}  // namespace grainfield::triaxial::report
