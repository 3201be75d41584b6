#include "bench/speed_picture.hpp"

#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {

using triaxial::report::DataBlock;
using triaxial::report::Gnuplot;

std::string rate_picture(const std::vector<SpeedPoint>& points) {
    DataBlock bars;
    std::vector<std::string> isa, precision;
    for (const SpeedPoint& p : points) {
        if (isa.empty() || isa.back() != p.isa || precision.back() != p.precision) {
            isa.push_back(p.isa);
            precision.push_back(p.precision);
        }
        const double place = static_cast<double>(isa.size() - 1);
        bars.row(place + (p.threads == 1 ? -0.17 : 0.17), 1e-3 * p.spheres / p.milliseconds,
                 p.threads);
    }
    return Gnuplot(gnuplot_templates())
        .png("speed_rates", "rates", {.width = 900, .height = 460},
             {{"bars", bars}, {"isa", isa}, {"precision", precision}});
}

std::string size_picture(const std::vector<SpeedPoint>& points) {
    DataBlock sizes;
    for (const SpeedPoint& p : points)
        sizes.row(p.spheres, 1e6 * p.milliseconds / p.spheres, p.memory_per_sphere);
    return Gnuplot(gnuplot_templates())
        .png("speed_sizes", "sizes", {.width = 900, .height = 400}, {{"sizes", sizes}});
}

}  // namespace grainfield::bench
