#include "bench/speed_picture.hpp"

#include <fmt/format.h>

#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {

namespace colour = triaxial::report::colour;

std::string rate_picture(const std::vector<SpeedPoint>& points) {
    const triaxial::report::Gnuplot gnuplot;
    std::string data;
    double place = 0;
    std::string before;
    for (const SpeedPoint& p : points) {
        const std::string kind = p.isa + "\\n" + p.precision;
        if (kind != before) place += before.empty() ? 0 : 1;
        // The second of two bars carries the name of both.
        data += fmt::format("{} {} {} \"{}\"\n", place + (p.threads == 1 ? -0.17 : 0.17),
                            1e-3 * p.spheres / p.milliseconds, p.threads,
                            kind == before ? kind : std::string());
        before = kind;
    }
    gnuplot.data("rates.dat", data);
    return gnuplot.png("rates", {.width = 900, .height = 460},
                       fmt::format(R"(
set boxwidth 0.3
set style fill solid 1 noborder
set yrange [0:*]
set xrange [-0.6:{last}+0.6]
unset grid
set grid ytics lc rgb '{grid}'
set bmargin 4
set ylabel '10^6 sphere-steps a second'
set key top left Left reverse
set xtics () scale 0
plot 'rates.dat' using 1:($3 == 1 ? $2 : NaN) with boxes lc rgb '{soft}' title '1 thread', \
     'rates.dat' using 1:($3 == 2 ? $2 : NaN) with boxes lc rgb '{main}' title '2 threads', \
     'rates.dat' using ($1 - 0.17):(NaN):xticlabels(4) notitle, \
     'rates.dat' using 1:2:(sprintf('%.1f', $2)) with labels offset 0,0.6 font ',11' \
         textcolor rgb '{ink}' notitle
)",
                                   fmt::arg("last", place), fmt::arg("grid", colour::grid),
                                   fmt::arg("soft", colour::soft), fmt::arg("main", colour::main),
                                   fmt::arg("ink", colour::ink)));
}

std::string size_picture(const std::vector<SpeedPoint>& points) {
    const triaxial::report::Gnuplot gnuplot;
    std::string data;
    for (const SpeedPoint& p : points)
        data += fmt::format("{} {} {}\n", p.spheres, 1e6 * p.milliseconds / p.spheres,
                            p.memory_per_sphere);
    gnuplot.data("sizes.dat", data);
    return gnuplot.png("sizes", {.width = 900, .height = 400},
                       fmt::format(R"(
set multiplot
set logscale x
set xrange [3e3:2e6]
set format x '10^{{%T}}'
set xlabel 'Spheres (-)'
set yrange [0:*]
set grid lc rgb '{grid}'
unset key
set lmargin at screen 0.10
set rmargin at screen 0.48
set ylabel 'Time a sphere-step (ns)' offset 1,0
plot 'sizes.dat' using 1:2 with linespoints pt 7 ps 1.4 lw 2 lc rgb '{main}'
set lmargin at screen 0.60
set rmargin at screen 0.98
set ylabel 'Memory a sphere (B)' offset 1,0
plot 'sizes.dat' using 1:3 with linespoints pt 5 ps 1.4 lw 2 lc rgb '{contrast}'
unset multiplot
)",
                                   fmt::arg("grid", colour::grid), fmt::arg("main", colour::main),
                                   fmt::arg("contrast", colour::contrast)));
}

}  // namespace grainfield::bench
