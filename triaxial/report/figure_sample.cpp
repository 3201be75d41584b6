#include <fmt/format.h>

#include <algorithm>

#include "triaxial/report/box_frame.hpp"
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
void draw(const Disc& disc, const Rgb& colour, double pixel, DataBlock& discs) {
    const auto circle = [&](double x, double y, double radius, const Rgb& c) {
        discs.row(x, y, radius, c.packed());
    };
    const Rgb lit = colour.times(disc.light);
    circle(disc.x, disc.y, disc.radius, lit.mixed(black, 0.62));
    circle(disc.x, disc.y, std::max(disc.radius - 1.1 * pixel, 0.6 * disc.radius), lit);
    for (const auto& [radius, shift, share] : glows)
        circle(disc.x - 0.7 * shift * disc.radius, disc.y + 0.7 * shift * disc.radius,
               radius * disc.radius, lit.mixed(white, share * disc.light));
}

std::string picture(const Gnuplot& gnuplot, const RunFolder& run, ColourBy by, int number) {
    const Camera camera;
    const Colouring colouring(run.spheres, by);
    BoxFrame frame = box_frame(run.box, camera, colouring);
    DataBlock discs(4);
    for (const Disc& disc : visible_discs(run.spheres, run.box, camera))
        draw(disc, colouring.colour(disc.sphere), frame.pixel, discs);
    frame.variables.emplace_back("discs", discs);
    const std::string png =
        gnuplot.png("figure_sample", fmt::format("sample_{}", number), frame.size, frame.variables);
    return fmt::format(
        "<img alt=\"The final sample seen from outside, {}\" width=\"{}\" height=\"{}\" "
        "src=\"data:image/png;base64,{}\">",
        escape(colouring.in_words()), frame.size.width, frame.size.height, base64(png));
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
