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
    simulation.scale_velocities(0);
    return simulation;
}

namespace {

/// The sample brought to the stress, then stopped.
core::Simulation compressed(const core::Scene& scene) {
    core::Simulation simulation(scene, double_kernels());
    core::Monitor silent;
    core::Driver driver(simulation, {}, silent);
    packing::compress_isotropically(driver, confining_stress);
    simulation.scale_velocities(0);
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
            .contacts = simulation.touching_contacts(),
            .position = simulation.spheres().position};
}

/// Spheres that are no rattlers: with four contacts or more.
std::vector<std::size_t> held(const core::Simulation& simulation) {
    std::vector<int> contacts(simulation.size(), 0);
    for (const core::TouchingContact& contact : simulation.touching())
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

/// Leaves a copy of the sample alone on these kernels; CSV rows, and the picture's data.
std::string leave_alone(const core::Simulation& still, const std::string& name,
                        const NamedKernels& kernels, std::int64_t most_steps,
                        triaxial::report::DataBlock& rests) {
    constexpr double looks_per_decade = 10;
    const double alpha = still.scene().damping.force;
    core::Simulation simulation = copy_of(still, *kernels.table);
    const double step = core::StepControl({}).next(simulation);
    const State start = state(simulation);
    const std::vector<std::size_t> spheres = held(simulation);
    std::string csv;
    rests.begin_part(fmt::format("{}-{}-{}", name, kernels.name, alpha));
    State now;
    double change = 0;
    const auto note = [&] {
        now = state(simulation);
        change = now.stress / start.stress - 1;
        csv += fmt::format("{},{},{},{},{:.5g},{},{:.4g},{:.6g},{:.8g},{:.4g},{:.4g},{}\n", name,
                           kernels.name, kernels.table->isa, alpha, step, simulation.steps(),
                           now.kinetic, now.elastic, now.stress, change, drift(start, now, spheres),
                           now.contacts);
        if (simulation.steps() > 0)
            rests.row(simulation.steps(), std::max(1e-30, now.kinetic) / start.elastic,
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
    std::string csv = header;
    triaxial::report::DataBlock rests;
    for (const NamedKernels& kernels : compared_kernels()) {
        // The reference is slow; what it shows, it shows early.
        const std::int64_t steps = kernels.name == "reference" ? most_steps / 10 : most_steps;
        csv += leave_alone(early, "compressed", kernels, steps / 10, rests);
        for (const core::Damping damping : {run.small.damping, core::Damping{}}) {
            still.set_damping(damping);
            csv += leave_alone(still, "settled", kernels, steps, rests);
        }
    }
    write_results(run, "stability_rest", csv, {1300, 700}, {{"rests", rests}});
}

}  // namespace grainfield::bench
