// A sample under isotropic stress between still walls, left alone for a million steps.
//
// With the default damping nothing may move. The sample as the isotropic stage leaves it, at an
// unbalanced force ratio of 1e-3, is not at rest yet: it creeps and loses stress, whatever the step
// and the kernels. Brought to the stress again and again it stays, undamped too; mixed precision
// then adds noise, whose energy grows in proportion to the steps.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/stability.hpp"
#include "core/drive/box.hpp"
#include "core/drive/driver.hpp"
#include "core/drive/measures.hpp"
#include "packing/isotropic.hpp"

namespace grainfield::bench {

core::Simulation settled(const core::Scene& scene) {
    constexpr int most_rounds = 50, hold = 40'000;  // steps between still walls [-]
    constexpr double lost = 1e-3;                   // of the stress, meanwhile [-]
    core::Simulation simulation(scene, double_kernels());
    core::Monitor silent;
    core::Driver driver(simulation, {}, silent);
    for (int round = 1; round <= most_rounds; ++round) {
        packing::compress_isotropically(driver, confining_stress);
        for (int k = 0; k < hold; ++k) driver.step(false, [](double) {});
        simulation.compute_forces(true);
        const double stress = core::axis_stress(simulation, 1);
        say(fmt::format("rest: round {}, stress {:.6g} Pa, unbalanced force ratio {:.2g}", round,
                        stress, simulation.unbalanced_force_ratio()));
        if (std::abs(stress / confining_stress - 1) < lost + 2e-3) break;
    }
    simulation.change().scale_velocities(0);
    return simulation;
}

namespace {

/// The sample brought to the stress, then stopped.
core::Simulation compressed(const core::Scene& scene) {
    core::Simulation simulation(scene, double_kernels());
    core::Monitor silent;
    core::Driver driver(simulation, {}, silent);
    packing::compress_isotropically(driver, confining_stress);
    simulation.change().scale_velocities(0);
    return simulation;
}

struct State {
    double kinetic = 0, elastic = 0;  // energies [J]
    double stress = 0;                // mean of the principal ones [Pa]
    std::int64_t contacts = 0;        // [-]
    core::Vec3Column position;        // [m]
};

State state(core::Simulation& simulation) {
    simulation.compute_forces(true);
    const core::Energy energy = simulation.energy();
    const double volume = core::box_dimensions(simulation).prod();
    return {.kinetic = energy.kinetic + energy.rotational,
            .elastic = energy.elastic_normal + energy.elastic_shear,
            .stress = core::mean_stress(simulation, volume).trace() / 3,
            .contacts = simulation.contacts().count(),
            .position = simulation.spheres().position};
}

/// Spheres that are no rattlers: with four contacts or more.
std::vector<std::size_t> held(const core::Simulation& simulation) {
    std::vector<int> contacts(simulation.size(), 0);
    for (const core::TouchingContact& contact : simulation.contacts().touching())
        for (const std::int32_t i : {contact.i, contact.j})
            if (i >= 0) ++contacts[static_cast<std::size_t>(i)];
    std::vector<std::size_t> spheres;
    for (std::size_t i = 0; i < contacts.size(); ++i)
        if (contacts[i] >= 4) spheres.push_back(i);
    return spheres;
}

double drift(const State& from, const State& to, const std::vector<std::size_t>& spheres) {
    double sum = 0;
    for (const std::size_t i : spheres) sum += (to.position[i] - from.position[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(spheres.size()));
}

constexpr const char* header =
    "state,precision,isa,damping,step_s,steps,kinetic_energy_J,elastic_energy_J,mean_stress_Pa,"
    "stress_change,position_drift_rms_m,contacts\n";

constexpr const char* picture = R"(
set multiplot
set logscale xy
set format y '10^{{%T}}'
set xrange [1:1.2e6]
set xtics ('1' 1, '10' 10, '10^2' 100, '10^3' 1e3, '10^4' 1e4, '10^5' 1e5, '10^6' 1e6)
set xlabel 'Steps (-)'
set tmargin at screen 0.96
set bmargin at screen 0.14

set lmargin at screen 0.11
set rmargin at screen 0.48
set yrange [1e-32:1]
set ylabel 'Kinetic over elastic energy at the start (-)' offset 1,0
set key bottom left Left reverse samplen 1.2
plot {lines} \
     NaN with lines lw 6 lc rgb '#d9dcdf' title 'pale: reference', \
     NaN with lines lw 1.8 dt 2 lc rgb '#66727c' title 'dashed: mixed'

set lmargin at screen 0.61
set rmargin at screen 0.98
set yrange [1e-11:1]
set ylabel 'Change of the mean stress (-)' offset 0,0
unset key
plot {changes} NaN notitle
unset multiplot
)";

/// The lines of one panel: `column` of the data.
std::string plots(int column) {
    namespace colour = triaxial::report::colour;
    struct Series {
        std::string_view file, title, rgb, pale;
    };
    const Series all[] = {{"compressed-{}-0.2", "as compressed", colour::ink, "#d9dcdf"},
                          {"settled-{}-0", "undamped", colour::contrast, "#f0d3bb"},
                          {"settled-{}-0.2", "damped", colour::main, "#c3d5e2"}};
    std::string text;
    const auto add = [&](const Series& s, std::string_view kernels, std::string_view style,
                         std::string_view title) {
        text += fmt::format("'{}.dat' using 1:{} with lines {} title '{}', ",
                            fmt::format(fmt::runtime(s.file), kernels), column, style, title);
    };
    for (const Series& s : all) add(s, "reference", fmt::format("lw 6 lc rgb '{}'", s.pale), "");
    for (const Series& s : all) add(s, "double", fmt::format("lw 1.8 lc rgb '{}'", s.rgb), s.title);
    for (const Series& s : all) add(s, "mixed", fmt::format("lw 1.8 dt 2 lc rgb '{}'", s.rgb), "");
    return text;
}

/// Leaves a copy of the sample alone on these kernels; CSV rows, and the picture's data.
std::string leave_alone(const core::Simulation& still, const std::string& name,
                        const NamedKernels& kernels, std::int64_t most_steps,
                        const triaxial::report::Gnuplot& gnuplot) {
    constexpr double looks_per_decade = 10;
    const double alpha = still.scene().damping.force;
    core::Simulation simulation = copy_of(still, *kernels.table);
    const double step = core::StepControl({}).next(simulation);
    const State start = state(simulation);
    const std::vector<std::size_t> spheres = held(simulation);
    std::string csv, points;
    State now;
    double change = 0;
    const auto note = [&] {
        now = state(simulation);
        change = now.stress / start.stress - 1;
        csv += fmt::format("{},{},{},{},{:.5g},{},{:.4g},{:.6g},{:.8g},{:.4g},{:.4g},{}\n", name,
                           kernels.name, kernels::name(kernels.table->isa), alpha, step,
                           simulation.steps(), now.kinetic, now.elastic, now.stress, change,
                           drift(start, now, spheres), now.contacts);
        if (simulation.steps() > 0)
            points += fmt::format("{} {} {}\n", simulation.steps(),
                                  std::max(1e-30, now.kinetic) / start.elastic,
                                  std::max(1e-16, std::abs(change)));
    };
    note();
    std::int64_t next = 1;
    while (simulation.steps() < most_steps) {
        simulation.step(step, [] {});
        if (simulation.steps() < next) continue;
        note();
        const double later = static_cast<double>(next) * std::pow(10, 1 / looks_per_decade);
        next = std::min(std::max(next + 1, static_cast<std::int64_t>(later)), most_steps);
    }
    gnuplot.data(fmt::format("{}-{}-{}.dat", name, kernels.name, alpha), points);
    say(
        fmt::format("rest: {}, {}, damping {}: kinetic {:.2g} J, stress {:+.2g}, drift {:.2g} m, "
                    "contacts {} -> {}",
                    name, kernels.name, alpha, now.kinetic, change, drift(start, now, spheres),
                    start.contacts, now.contacts));
    return csv;
}

}  // namespace

void long_rest(const StabilityRun& run) {
    const std::int64_t most_steps = run.quick ? 10'000 : 1'000'000;
    const core::Simulation early = compressed(run.small);
    core::Simulation still = settled(run.small);
    const triaxial::report::Gnuplot gnuplot;
    std::string csv = header;
    for (const NamedKernels& kernels : compared_kernels()) {
        // The reference is slow; what it shows, it shows early.
        const std::int64_t steps = kernels.name == "reference" ? most_steps / 10 : most_steps;
        csv += leave_alone(early, "compressed", kernels, steps / 10, gnuplot);
        for (const core::Damping damping : {run.small.damping, core::Damping{}}) {
            still.change().set_damping(damping);
            csv += leave_alone(still, "settled", kernels, steps, gnuplot);
        }
    }
    write_results(run, "rest", csv, gnuplot, {1300, 700},
                  fmt::format(fmt::runtime(picture), fmt::arg("lines", plots(2)),
                              fmt::arg("changes", plots(3))));
}

}  // namespace grainfield::bench
