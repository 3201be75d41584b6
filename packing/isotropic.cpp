#include "packing/isotropic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/drive/box.hpp"
#include "core/drive/servo.hpp"
#include "core/state/section_of.hpp"

namespace grainfield::packing {
namespace {

constexpr double isotropic_rest = 1e-3;    // unbalanced force ratio [-]
constexpr double stress_tolerance = 2e-3;  // of each wall [-]
constexpr double most_strain_rate = 0.5;   // cap of the walls' speed over the half dimension [1/s]
// Loose spheres that bounce in their pores lose little by local damping alone. Once the stress is
// nearly there, a look (20 steps) multiplies all velocities by this factor; smaller steps, of which
// as much motion takes more, by less.
constexpr double relaxed_within = 0.02;  // largest stress error of a wall [-]
constexpr double relaxed_to = 0.85;      // at the step below [-]
constexpr double relaxed_step = 0.8;     // of the stability limit [-]
constexpr std::int64_t most_isotropic_steps = 200000;

/// Whether spheres fall towards the wall: it stands, and carries their weight beside the stress.
bool carries_weight(const core::Simulation& simulation, std::size_t wall) {
    return simulation.scene().gravity.dot(simulation.walls()[wall].normal) < 0;
}

}  // namespace

IsotropicResult compress_isotropically(core::Driver& driver, double stress) {
    core::Simulation& simulation = driver.simulation();
    const Vec3 start = core::box_dimensions(simulation);
    std::vector<core::WallServo> servos;
    for (std::size_t w = 0; w < 6; ++w) {
        if (carries_weight(simulation, w)) continue;
        servos.emplace_back(
            w, core::WallServo::Options{
                   .stress = stress,
                   .max_speed = 0.5 * most_strain_rate * start[static_cast<int>(w) / 2]});
    }
    IsotropicResult result;
    const auto section =
        core::section_of(driver.checkpoint(), "isotropic compression", [&](auto& archive) {
            archive(core::bytes(result));
            for (core::WallServo& servo : servos) archive(servo);
        });
    driver.limit_kinetic_energy(core::most_kinetic_energy(simulation, most_strain_rate, stress));
    for (bool reached = false; !reached; ++result.steps) {
        driver.safe_point();
        const bool look = result.steps % 20 == 0;
        driver.step(look, [&](double step) {
            const Vec3 size = core::box_dimensions(simulation);
            double worst = 0;
            for (core::WallServo& servo : servos) {
                const double error = servo.steer(
                    simulation, core::wall_area(size, static_cast<int>(servo.wall()) / 2), step);
                worst = std::max(worst, std::abs(error));
            }
            if (!look) return;
            result.stress_error = worst;
            result.unbalanced_force_ratio = simulation.unbalanced_force_ratio();
            if (worst < relaxed_within) {
                const double limit = driver.control().limit();
                const double share = limit > 0 ? step / limit / relaxed_step : 1.0;
                simulation.change().scale_velocities(std::pow(relaxed_to, share));
            }
            reached = worst < stress_tolerance && result.unbalanced_force_ratio < isotropic_rest;
        });
        if (result.steps % 100 == 0)
            driver.monitor().progress(
                -1, result.steps,
                fmt::format("unbalanced force ratio {:.2g}, stress within {:.2g} %",
                            result.unbalanced_force_ratio, 100 * result.stress_error));
        if (result.steps > most_isotropic_steps)
            driver.fail(fmt::format(
                "the isotropic stress of {:g} Pa is not reached: after {} steps the walls are "
                "within {:.2g} % and the "
                "unbalanced force ratio is {:.2g}",
                stress, result.steps, 100 * result.stress_error, result.unbalanced_force_ratio));
    }
    for (std::size_t w = 0; w < 6; ++w) simulation.set_wall_velocity(w, Vec3::Zero());
    simulation.compute_forces(true);
    return result;
}

}  // namespace grainfield::packing
