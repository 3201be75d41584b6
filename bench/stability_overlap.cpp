// Spheres that overlap far too much at the start: what the automatic step makes of the burst.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/stability.hpp"
#include "core/base/errors.hpp"
#include "core/drive/driver.hpp"

namespace grainfield::bench {
namespace {

constexpr double room = 0.05;  // the walls stand back by this share of the box on every side [-]

/// The sample with radii grown so that equal spheres that touched overlap by `overlap` radii [-],
/// and walls that leave it room to burst.
core::Scene inflated(core::Scene scene, double overlap) {
    for (double& r : scene.spheres.radius) r *= 1 + 0.5 * overlap;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        core::Wall &low = scene.walls[2 * axis], &high = scene.walls[2 * axis + 1];
        const Vec3 back = room * (high.point - low.point);
        low.point -= back;
        high.point += back;
    }
    return scene;
}

struct Burst {
    bool finite = true;
    std::int64_t steps = 0;   // [-]
    double elastic = 0;       // energy at the start [J]
    double closing = 0;       // largest change of what should be constant [J]
    double speed = 0;         // largest of a sphere [m/s]
    double step = 0;          // the first [s]
    double kinetic_left = 0;  // energy at the end [J]
};

Burst burst(const core::Scene& scene, const kernels::KernelTable& kernels, double safety,
            double time) {
    constexpr int look_interval = 10;
    core::Simulation simulation(scene, kernels, {.skin = 0, .ledger = true});
    core::Monitor silent;
    core::Driver driver(simulation, {{}, safety, 1}, silent);
    simulation.compute_forces(true);
    Burst result;
    result.elastic = simulation.energy().elastic_normal;
    const double before = simulation.energy().closing();
    try {
        while (simulation.time() < time) {
            const bool look = simulation.steps() % look_interval == 0;
            driver.step(look, [&](double step) {
                if (result.step == 0) result.step = step;
                if (!look) return;
                const core::Energy energy = simulation.energy();
                result.closing = std::max(result.closing, std::abs(energy.closing() - before));
                result.kinetic_left = energy.kinetic + energy.rotational;
                const core::Vec3Column& v = simulation.spheres().velocity;
                for (std::size_t i = 0; i < v.size(); ++i)
                    result.speed = std::max(result.speed, v[i].norm());
            });
        }
        driver.watch();
    } catch (const SimulationError& error) {
        say(error.what());
        result.finite = false;
    }
    result.finite &= std::isfinite(result.closing) && std::isfinite(result.speed);
    result.steps = simulation.steps();
    return result;
}

constexpr const char* header =
    "overlap_percent,precision,isa,safety,finite,steps,first_step_s,elastic_energy_J,"
    "ledger_error_J,ledger_error_over_elastic,largest_speed_m_per_s,kinetic_left_over_elastic\n";

}  // namespace

void start_overlaps(const StabilityRun& run) {
    const double time = run.quick ? 0.01 : 0.1;  // [s]: the burst itself takes a tenth of it
    std::string csv = header;
    triaxial::report::DataBlock bursts;
    for (const NamedKernels& kernels : compared_kernels())
        for (const double safety : {0.8, 0.2}) {
            bursts.begin_part(fmt::format("{}-{}", kernels.name, safety));
            for (const double percent : {0.1, 0.5, 1.0, 2.0, 5.0}) {
                const core::Scene scene = inflated(run.small, 0.01 * percent);
                const Burst b = burst(scene, *kernels.table, safety, time);
                csv += fmt::format("{},{},{},{},{},{},{:.5g},{:.5g},{:.4g},{:.4g},{:.4g},{:.4g}\n",
                                   percent, kernels.name, kernels.table->isa, safety, b.finite,
                                   b.steps, b.step, b.elastic, b.closing, b.closing / b.elastic,
                                   b.speed, b.kinetic_left / b.elastic);
                bursts.row(percent, b.closing / b.elastic, b.speed);
            }
            say(fmt::format("overlap: {}, safety {}", kernels.name, safety));
        }
    write_results(run, "stability_overlap", csv, {1300, 600}, {{"bursts", bursts}});
}

}  // namespace grainfield::bench
