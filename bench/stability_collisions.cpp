// Loose collisions without loss: spheres that burst out of a stress and fly about between still
// walls. Leapfrog keeps the energy of a contact that stays closed; one that opens and closes within
// few steps changes it each time, on average upwards.

#include <fmt/format.h>

#include <cmath>

#include "bench/stability.hpp"
#include "core/base/errors.hpp"
#include "core/drive/driver.hpp"

namespace grainfield::bench {
namespace {

constexpr const char* header =
    "friction_angle_rad,damping,safety,step_s,finite,time_s,steps,elastic_energy_at_start_J,"
    "kinetic_over_start,ledger_error_over_start\n";

}  // namespace

void collisions(const StabilityRun& run) {
    const double time = run.quick ? 0.02 : 0.4;  // [s]
    std::string csv = header;
    triaxial::report::DataBlock gains;
    for (const double friction : {0.0, run.small.spheres.friction_angle[0]})
        for (const double damping : {0.0, run.small.damping.force}) {
            gains.begin_part(fmt::format("{}-{}", friction, damping));
            for (const double safety : {0.1, 0.2, 0.4, 0.6, 0.8}) {
                core::Scene scene = run.small;
                scene.damping = {damping, damping};
                core::Simulation simulation(std::move(scene), double_kernels(),
                                            {.skin = 0, .ledger = true});
                simulation.set_friction_angle(friction);
                core::Monitor silent;
                core::Driver driver(simulation, {{}, safety, 1}, silent);
                simulation.compute_forces(true);
                const core::Energy start = simulation.energy();
                const double step = safety * core::StepControl({{}, 1, 1}).next(simulation);
                bool finite = true;
                try {
                    while (simulation.time() < time) driver.step(false, [](double) {});
                } catch (const SimulationError& error) {
                    say(error.what());
                    finite = false;
                }
                if (finite) simulation.compute_forces(true);
                const core::Energy end = simulation.energy();
                const double kinetic = (end.kinetic + end.rotational) / start.elastic_normal;
                const double gain = (end.closing() - start.closing()) / start.elastic_normal;
                csv += fmt::format("{},{},{},{:.5g},{},{:.4g},{},{:.4g},{:.4g},{:.4g}\n", friction,
                                   damping, safety, step, finite, simulation.time(),
                                   simulation.steps(), start.elastic_normal, kinetic, gain);
                gains.row(safety, std::abs(gain));
                say(
                    fmt::format("collisions: friction {}, damping {}, safety {}: kinetic {:.3g}, "
                                "ledger {:+.2g} of the start",
                                friction, damping, safety, kinetic, gain));
            }
        }
    write_results(run, "stability_collisions", csv, {900, 620}, {{"gains", gains}});
}

}  // namespace grainfield::bench
