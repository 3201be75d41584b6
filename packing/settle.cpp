#include "packing/settle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/drive/measures.hpp"
#include "core/drive/servo.hpp"
#include "core/state/section_of.hpp"

namespace grainfield::packing {
namespace {

constexpr double settled_ratio = 1e-2;    // unbalanced force ratio, loose spheres included [-]
constexpr double floor_tolerance = 1e-2;  // of the weight [-]
constexpr std::int64_t look_every = 20;   // steps between two looks
// Loose spheres that bounce in their pores lose little by local damping alone: once the floor
// carries nearly the whole weight, a look takes this share of all velocities away. What still falls
// goes on falling, at up to 0.06 m/s.
constexpr double calmed_within = 0.02;  // of the weight [-]
constexpr double calmed_to = 0.9;       // factor on the velocities [-]
constexpr std::int64_t most_settling_steps = 200000;

}  // namespace

void settle_under_gravity(core::Driver& driver, std::size_t floor_wall, double gravity,
                          double height) {
    core::Simulation& simulation = driver.simulation();
    const auto& mass = simulation.spheres().mass;
    const double total_mass = std::accumulate(mass.begin(), mass.end(), 0.0);
    const double weight = total_mass * gravity;
    const double negligible = 1e-5 * total_mass * gravity * height;  // kinetic energy [J]

    double ratio = 1, floor_error = 1;
    std::int64_t steps = 0;
    const auto section = core::section_of(driver.checkpoint(), "settling", [&](auto& archive) {
        archive(ratio, floor_error, steps);
    });
    if (!section.resumed()) simulation.change().set_gravity(Vec3(0, -gravity, 0));
    for (;; ++steps) {
        driver.safe_point();
        const bool look = steps % look_every == 0;
        driver.step(look, [&](double) {
            if (!look) return;
            ratio = simulation.unbalanced_force_ratio();
            floor_error = core::wall_compression(simulation, floor_wall) / weight - 1;
            if (std::abs(floor_error) < calmed_within)
                simulation.change().scale_velocities(calmed_to);
        });
        if (!look) continue;
        if (ratio < settled_ratio && std::abs(floor_error) < floor_tolerance &&
            core::kinetic_energy(simulation) < negligible)
            break;
        if (steps % 100 == 0)
            driver.monitor().progress(
                -1, steps,
                fmt::format("unbalanced force ratio {:.2g}, floor carries {:.1f} % of the weight",
                            ratio, 100 * (1 + floor_error)));
        if (steps > most_settling_steps)
            driver.fail(fmt::format(
                "the sample does not come to settled_ratio under gravity: unbalanced force ratio "
                "{:.2g} after {} steps",
                ratio, steps));
    }
    simulation.change().scale_velocities(0.0);
    simulation.compute_forces(true);
}

}  // namespace grainfield::packing
