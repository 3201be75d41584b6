#include "triaxial/report/repeats/figure_repeats.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grainfield::triaxial::report {
namespace {

// Of all curves together: more make the page slow, and cannot be told apart. Each curve has some.
constexpr std::size_t most_points = 40'000, least_points = 200;

void add_curve(const Curve& curve, std::size_t points, DataBlock& rows) {
    const std::size_t stride = curve.size() / points + 1;
    for (std::size_t i = 0; i < curve.size(); ++i)
        if (i % stride == 0 || i + 1 == curve.size())
            rows.row(100 * curve.axial_strain[i], 1e-3 * curve.deviator_stress[i]);
    rows.end_part();
}

}  // namespace

Figure repeats_figure(const Gnuplot& gnuplot, const RepeatsData& data) {
    const std::size_t points = std::max(least_points, most_points / data.repeats.size());
    DataBlock curves(4), peaks(4);
    double last = 1e-4, lowest = 0, highest = 0;
    for (const Repeat& repeat : data.repeats) {
        add_curve(repeat.curve, points, curves);
        peaks.row(100 * repeat.results.axial_strain_at_peak,
                  1e-3 * repeat.results.peak_deviator_stress);
        last = std::max(last, 100 * std::ranges::max(repeat.curve.axial_strain));
        lowest = std::min(lowest, 1e-3 * std::ranges::min(repeat.curve.deviator_stress));
        highest = std::max(highest, 1e-3 * repeat.results.peak_deviator_stress);
    }
    const std::string picture =
        gnuplot.svg("figure_repeats", "repeats", "Deviator stress over axial strain of all repeats",
                    {1000, 460},
                    {{"curves", curves},
                     {"peaks", peaks},
                     {"repeats", data.repeats.size()},
                     {"last", last},
                     {"lowest", 1.1 * lowest},
                     {"highest", 1.1 * highest}});
    return {picture,
            fmt::format("Deviator stress over axial strain of the {} repeats. Each has its "
                        "largest <i>q</i> marked.",
                        data.repeats.size())};
}

}  // namespace grainfield::triaxial::report
