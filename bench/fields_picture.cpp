#include "bench/fields_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {
namespace {

namespace colour = triaxial::report::colour;

struct Style {
    const char* method;
    std::string_view colour;
    int point;          // gnuplot's point type
    double exact;       // where errors of round-off are drawn: one method above the other
    const char* place;  // of the labels, so that those of different methods keep apart
};
constexpr Style styles[] = {{"las-classic", colour::contrast, 5, 1e-4, "right offset -1.6,0"},
                            {"las", colour::main, 7, 1e-4, "left offset 1.6,0"},
                            {"cholesky", colour::ink, 9, 1e-4, "left offset 1.6,0"},
                            {"circulant", colour::soft, 13, 4e-5, "left offset 1.6,0"}};

/// Correlation lengths beside the points; of the Cholesky factor, which does not care, once.
std::string label(const FieldPoint& point, bool first) {
    if (point.method != "cholesky") return fmt::format("{:g}", point.theta_y);
    return first ? "any" : "";
}

}  // namespace

std::string fields_picture(const std::vector<FieldPoint>& points) {
    std::vector<randomfield::CellCount> grids;
    for (const FieldPoint& p : points) {
        const bool known = std::find(grids.begin(), grids.end(), p.cells) != grids.end();
        if (p.error && p.method == "las" && !known) grids.push_back(p.cells);
    }
    const triaxial::report::Gnuplot gnuplot;
    const int panels = static_cast<int>(grids.size());
    std::string script = fmt::format(R"(
set multiplot layout 1,{}
set logscale xy
set xrange [3:3e5]
set yrange [2e-5:2]
set format x '10^{{%T}}'
set ytics ('exact' 1e-4, '0.001' 1e-3, '0.01' 1e-2, '0.1' 1e-1, '1' 1)
set grid lc rgb '{}'
set xlabel 'Time a cell, normals included (ns)'
set ylabel 'Largest covariance error (γ)'
set key at graph 0.98,0.72 right top
)",
                                     panels, colour::grid);
    for (std::size_t g = 0; g < grids.size(); ++g) {
        std::string plot;
        for (const Style& style : styles) {
            std::string data;
            for (const FieldPoint& p : points) {
                if (p.cells != grids[g] || p.method != style.method || !p.error) continue;
                const double cells = 1.0 * p.cells[0] * p.cells[1] * p.cells[2];
                data += fmt::format("{} {} \"{}\"\n", 1e9 * p.field / cells,
                                    std::max(*p.error, style.exact), label(p, data.empty()));
            }
            if (data.empty()) continue;
            const std::string file = fmt::format("{}-{}.dat", style.method, g);
            gnuplot.data(file, data);
            plot += fmt::format(
                "{}'{}' using 1:2 with points pt {} ps 1.6 lc rgb '{}' title '{}', '{}' using "
                "1:2:3 with labels {} font ',9' textcolor rgb '{}' notitle",
                plot.empty() ? "plot " : ", ", file, style.point, style.colour, style.method, file,
                style.place, colour::muted);
        }
        script += fmt::format("set title '{} x {} x {} cells; labels: {{/Symbol q}}_y in m'\n{}\n",
                              grids[g][0], grids[g][1], grids[g][2], plot);
    }
    script += "unset multiplot\n";
    return gnuplot.png("fields", {.width = 620 * panels, .height = 460}, script);
}

}  // namespace grainfield::bench
