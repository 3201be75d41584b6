#include "packing/settle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/measures.hpp"
#include "core/parallel.hpp"
#include "core/servo.hpp"

namespace grainfield::packing {
namespace {

constexpr double rest = 1e-3;             // unbalanced force ratio [-]
constexpr double floor_tolerance = 2e-3;  // of the weight [-]
constexpr std::int64_t look_every = 10;   // steps between two looks at the kinetic energy
constexpr std::int64_t most_steps = 200000;

double kinetic_energy(const core::Simulation& simulation) {
    const core::ParticleStore& s = simulation.spheres();
    return core::sum_over<double>(
        s.size(), [&](std::size_t i) { return 0.5 * s.mass[i] * s.velocity[i].squaredNorm(); });
}

/// Period of the slowest vertical oscillation of a column on its floor, four times the travel time
/// of a wave. The modulus is that of the packing's springs, of which a loose packing keeps about a
/// half (the bound is an upper one, physics.md).
double oscillation_period(core::Simulation& simulation, double height, double volume) {
    const double lambda = simulation.scene().stiffness_ratio;
    const double constrained = core::stiffness_sum(simulation, volume) * (3 + 2 * lambda) / 15;
    const auto& mass = simulation.spheres().mass;
    const double density = std::accumulate(mass.begin(), mass.end(), 0.0) / volume;
    if (constrained <= 0) return 0.1;
    return 4 * height / std::sqrt(0.5 * constrained / density);
}

}  // namespace

void settle_under_gravity(core::Driver& driver, std::size_t floor_wall, double gravity, double height) {
    core::Simulation& simulation = driver.simulation();
    const auto& mass = simulation.spheres().mass;
    const double total_mass = std::accumulate(mass.begin(), mass.end(), 0.0);
    const double weight = total_mass * gravity;
    const double negligible = 1e-6 * total_mass * gravity * height;  // kinetic energy [J]

    simulation.set_gravity(Vec3::Zero());
    simulation.compute_forces(true);
    const core::Box box = core::bounding_box(simulation.spheres());
    const double ramp = oscillation_period(simulation, height, box.volume());
    const double start = simulation.time();
    const double drag = 4 * std::numbers::pi / ramp;  // critical for that oscillation [1/s]
    double last_look = start;
    double ratio = 1, floor_error = 1, energy = 0;
    for (std::int64_t steps = 0;; ++steps) {
        const double share = std::min(1.0, (simulation.time() - start) / ramp);
        const bool look = steps % look_every == 0;
        driver.step(look, [&](double) {
            simulation.set_gravity(Vec3(0, -share * gravity, 0));
            if (!look) return;
            simulation.scale_velocities(std::exp(-drag * (simulation.time() - last_look)));
            last_look = simulation.time();
            ratio = simulation.unbalanced_force_ratio();
            floor_error = core::wall_compression(simulation, floor_wall) / weight - 1;
        });
        if (!look) continue;
        energy = kinetic_energy(simulation);
        if (share == 1.0) {
            if (ratio < rest && std::abs(floor_error) < floor_tolerance && energy < negligible) break;
        }
        if (steps % 100 == 0)
            driver.monitor().progress(
                share < 1.0 ? 0.5 * share : -1, steps,
                fmt::format("gravity {:.0f} %, unbalanced force ratio {:.2g}, floor carries {:.1f} % of the weight",
                            100 * share, ratio, 100 * (1 + floor_error)));
        if (steps > most_steps)
            throw SimulationError(fmt::format("the sample does not come to rest under gravity: unbalanced force ratio "
                                              "{:.2g} after {} steps", ratio, steps));
    }
    simulation.scale_velocities(0.0);
    simulation.compute_forces(true);
}

}  // namespace grainfield::packing
