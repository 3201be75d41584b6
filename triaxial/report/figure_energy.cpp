#include <fmt/format.h>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {

Figure energy_figure(const Gnuplot& gnuplot, const RunFolder& run) {
    std::string rows;
    for (const auto& [time, e] : run.energies) {
        rows += fmt::format("{} {} {} {} {} {}\n", time, e.external_work, e.friction_work,
                            e.damping_work, e.elastic_normal + e.elastic_shear,
                            e.kinetic + e.rotational);
    }
    gnuplot.data("energy.dat", rows);
    const double last = run.energies.back().time;
    const double error = run.summary.number("energy_closing_error");
    const double began = run.summary.optional_number("shear_began_s").value_or(0.0);
    const std::string script = fmt::format(
        R"(set lmargin at screen 0.075
set rmargin at screen 0.985
set tmargin at screen 0.95
set bmargin at screen 0.17
set xrange [0:{last}]
set yrange [0:*]
set xlabel 'Time (s)' offset 0,0.3
set ylabel 'Energy (J)' offset 0.5,0
set key at graph 0.5,graph 0.97
set arrow 1 from {began},graph 0 to {began},graph 1 nohead lw 1 dt (3,3) lc rgb '{muted}'
set label 1 'shear begins' at {began},graph 0.93 left offset 0.6,0 tc rgb '{muted}'
plot 'energy.dat' using 1:2 with lines lw 2.4 lc rgb '{ink}' title 'put in by the walls', \
     'energy.dat' using 1:3 with lines lw 2 lc rgb '{contrast}' title 'dissipated by friction', \
     'energy.dat' using 1:4 with lines lw 2 lc rgb '{main}' title 'dissipated by damping', \
     'energy.dat' using 1:5 with lines lw 2 lc rgb '{soft}' title 'elastic', \
     'energy.dat' using 1:6 with lines lw 1.4 dt (6,4) lc rgb '{muted}' title 'kinetic'
)",
        fmt::arg("last", last), fmt::arg("began", began), fmt::arg("ink", colour::ink),
        fmt::arg("contrast", colour::contrast), fmt::arg("main", colour::main),
        fmt::arg("soft", colour::soft), fmt::arg("muted", colour::muted));
    return {gnuplot.svg("energy", "Work of the walls and where it went", {1000, 340}, script),
            fmt::format("The energy ledger from the start of the isotropic stage, in which loose "
                        "spheres are slowed (counted as damping). The sum closes to {} % of the "
                        "work put in.",
                        significant(100 * error, 2))};
}

}  // namespace grainfield::triaxial::report
