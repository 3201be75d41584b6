#include <fmt/format.h>

#include <cmath>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {

Figure energy_figure(const Gnuplot& gnuplot, const RunFolder& run) {
    DataBlock energies;
    for (const auto& [time, e] : run.energies)
        energies.row(time, e.external_work, e.friction_work, e.damping_work,
                     e.elastic_normal + e.elastic_shear, e.kinetic + e.rotational);
    const double error = run.summary.number("energy_closing_error");
    const std::string picture =
        gnuplot.svg("figure_energy", "energy", "Work of the walls and where it went", {1000, 340},
                    {{"energies", energies},
                     {"last", run.energies.back().time},
                     {"began", run.summary.optional_number("shear_began_s").value_or(NAN)}});
    return {picture,
            fmt::format("The energy ledger from the start of the isotropic stage, in which loose "
                        "spheres are slowed (counted as damping). The sum closes to {} % of the "
                        "work put in.",
                        significant(100 * error, 2))};
}

}  // namespace grainfield::triaxial::report
