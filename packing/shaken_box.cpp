#include "packing/shaken_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/drive/measures.hpp"
#include "core/drive/servo.hpp"

namespace grainfield::packing {
namespace {

// Shaking and lid (docs/method.md, section 4.2): 0.3-3 g and 10-25 Hz pack this block.
constexpr double shaking_acceleration = 2.0;  // share of gravity [-]
constexpr double shaking_frequency = 15.0;    // [1/s]
constexpr double bout = 0.25;                 // of shaking, between two looks at the lid [s]
// Without friction bouts differ in strength and pace.
constexpr double weakest = 0.3, strongest = 3.0;  // share of gravity [-]
constexpr double slowest = 10.0, fastest = 25.0;  // [1/s]
constexpr double most_lid_speed = 0.2;            // [m/s]
// Between these ratios a look takes a share of all velocities away: loose spheres that bounce in
// their pores lose little by local damping alone, what still falls goes on falling, and the last
// that roll into their places are not slowed. What slides where nothing forces it would go on for
// ever.
constexpr double damped_below = 0.05, damped_above = 0.01, damped_to = 0.95;  // [-]
constexpr double speed_at_rest = 0.1;       // mean speed over sqrt(g height) and the ratio [-]
constexpr std::int64_t look_interval = 20;  // steps between two looks
// Blocks settle in 1 to 50 times sqrt(height/g), the time of a fall.
constexpr double longest_settling = 200;  // of these times [-]
constexpr double least_kappa = 2e4;       // k_n over stress, of softened springs [-]
constexpr double most_softened = 8;       // [-]
constexpr double lid_tolerance = 0.05;    // of its stress [-]
// The limit of the step is estimated anew after so many steps: blocks have spheres enough for the
// highest frequency to vary little. Of few spheres each counts.
constexpr int estimate_interval = 100;
constexpr std::size_t few_spheres = 50;

/// A wall deforms like half of the contact with a mirror image: infinitely stiff, it gives the
/// same force at the same overlap on this side of the mirror plane, so that the block stays in
/// equilibrium when its walls become mirror images (phase 2).
constexpr double mirror_stiffness_factor = 1e6;

core::Scene scene_of(const PackingOptions& options, const Material& material,
                     core::ParticleStore spheres, double lid_height) {
    core::Scene scene;
    scene.spheres = std::move(spheres);
    std::fill(scene.spheres.normal_stiffness.begin(), scene.spheres.normal_stiffness.end(),
              material.normal_stiffness);
    std::fill(scene.spheres.friction_angle.begin(), scene.spheres.friction_angle.end(),
              material.friction_angle);
    scene.stiffness_ratio = material.stiffness_ratio;
    scene.damping = material.damping;
    core::Wall wall;
    wall.friction_angle = material.wall_friction_angle;
    wall.normal_stiffness = mirror_stiffness_factor * material.normal_stiffness;
    wall.stiffness_ratio = material.wall_stiffness_ratio;
    scene.walls =
        core::box_walls({Vec3::Zero(), {options.block.x(), lid_height, options.block.z()}}, wall);
    return scene;
}

}  // namespace

ShakenBox::ShakenBox(const PackingOptions& options, const Material& material,
                     core::ParticleStore spheres, double lid_height,
                     const kernels::KernelTable& kernels, core::Monitor& monitor)
    : options_(options),
      material_(material),
      simulation_(scene_of(options, material, std::move(spheres), lid_height), kernels),
      monitor_(monitor),
      random_(options.seed, core::Stream::packing_shaking) {
    soften(1);
}

double ShakenBox::most_softening() const {
    return std::clamp(material_.normal_stiffness / own_stress() / least_kappa, 1.0, most_softened);
}

void ShakenBox::soften(double factor) {
    softening_ = factor;
    const std::vector<double> stiffness(simulation_.size(), material_.normal_stiffness / factor);
    const std::vector<double> friction(spheres().friction_angle.begin(),
                                       spheres().friction_angle.end());
    simulation_.change().set_properties(stiffness, friction);
    driver_.emplace(simulation_, core::TimeOptions{}, monitor_);
    if (simulation_.size() > few_spheres) driver_->control().estimate_every(estimate_interval);
}

void ShakenBox::set_friction_angle(double angle) {
    simulation_.change().set_friction_angle(angle);
}

template <class Steer, class AtRest>
void ShakenBox::run_until_rest(double rest, const Steer& steer, const AtRest& at_rest) {
    const double deadline =
        simulation_.time() + longest_settling * std::sqrt(lid_height() / options_.gravity);
    const double negligible =
        speed_at_rest * rest * std::sqrt(options_.gravity * options_.block.y());
    double ratio = 1, speed = 0;
    for (bool rests = false; !rests;) {
        driver_->safe_point();
        const bool look = simulation_.steps() % look_interval == 0;
        driver_->step(look, [&](double step) {
            steer(step);
            if (!look) return;
            ratio = simulation_.unbalanced_force_ratio();
            speed = mean_speed();
            rests = ratio < rest && speed < negligible && at_rest();
            const bool rolls = ratio <= damped_above && ratio >= rest;
            if (ratio < damped_below && !rolls) simulation_.change().scale_velocities(damped_to);
        });
        if (simulation_.steps() % 2000 == 0)
            monitor_.progress(
                -1, simulation_.steps(),
                fmt::format("unbalanced force ratio {:.2g}, mean speed {:.2g} m/s", ratio, speed));
        if (simulation_.time() > deadline)
            driver_->fail(fmt::format(
                "the block does not come to rest: after {} times sqrt(height/g) the unbalanced "
                "force ratio is {:.2g} ({:g} is rest) and the mean speed {:.2g} m/s, at a "
                "porosity of {:.4f}; another packing.seed or more damping.force may help",
                longest_settling, ratio, rest, speed, porosity()));
    }
    simulation_.compute_forces(true);
}

void ShakenBox::settle(double rest, bool reversed) {
    simulation_.change().set_gravity(reversed ? Vec3(-gravity()) : gravity());
    simulation_.set_wall_velocity(lid, Vec3::Zero());
    run_until_rest(
        rest, [](double) {}, [] { return true; });
}

void ShakenBox::press(double stress, double rest) {
    simulation_.change().set_gravity(gravity());
    core::WallServo servo(lid, {.stress = stress, .max_speed = most_lid_speed});
    double error = 1;
    run_until_rest(
        rest,
        [&](double step) {
            error = servo.steer(simulation_, options_.block.x() * options_.block.z(), step);
        },
        [&] { return std::abs(error) < lid_tolerance; });
    simulation_.set_wall_velocity(lid, Vec3::Zero());
}

void ShakenBox::shake(bool varied, double lowest) {
    core::WallServo servo(lid, {.stress = own_stress(),
                                .max_speed = most_lid_speed,
                                .gain = 0.8,
                                .integral = 0.02,
                                .present = 1});
    const double start = simulation_.time();
    const double phase_x = 2 * std::numbers::pi * random_.uniform(0, bouts_);
    const double phase_z = 2 * std::numbers::pi * random_.uniform(1, bouts_);
    double acceleration = shaking_acceleration, frequency = shaking_frequency;
    if (varied) {
        acceleration = weakest + (strongest - weakest) * random_.uniform(2, bouts_);
        frequency = slowest + (fastest - slowest) * random_.uniform(3, bouts_);
    }
    ++bouts_;
    const double area = options_.block.x() * options_.block.z();
    const double a = acceleration * options_.gravity;
    while (simulation_.time() < start + bout && lid_height() > lowest) {
        driver_->safe_point();
        const double angle = 2 * std::numbers::pi * frequency * (simulation_.time() - start);
        simulation_.change().set_gravity(gravity() + Vec3(a * std::sin(angle + phase_x),
                                                          0.5 * a * std::sin(2 * angle),
                                                          a * std::sin(angle + phase_z)));
        driver_->step(false, [&](double step) {
            servo.steer(simulation_, area, step);
            const double down = -simulation_.walls()[lid].velocity.y();
            const double room = std::max(0.0, (lid_height() - lowest) / step);
            if (down > room) simulation_.set_wall_velocity(lid, Vec3(0, -room, 0));
        });
    }
}

void ShakenBox::set_lid_height(double height) {
    simulation_.change().set_wall_point(lid, Vec3(0, height, 0));
}

double ShakenBox::porosity(double height) const {
    return 1 - spheres().solid_volume() / (options_.block.x() * options_.block.z() * height);
}

double ShakenBox::own_stress() const {
    return 0.5 * bulk_unit_weight(material_, options_.porosity, options_.gravity) *
           options_.block.y();
}

double ShakenBox::mean_stress() const {
    const double volume = options_.block.x() * lid_height() * options_.block.z();
    return core::mean_stress(simulation_, volume).trace() / 3;
}

double ShakenBox::top_of_bed() const {
    double top = 0;
    const core::ParticleStore& s = spheres();
    for (std::size_t i = 0; i < s.size(); ++i) top = std::max(top, s.position.y[i] + s.radius[i]);
    return top;
}

double ShakenBox::mean_speed() const {
    double sum = 0;
    const core::ParticleStore& s = spheres();
    for (std::size_t i = 0; i < s.size(); ++i) sum += s.velocity[i].norm();
    return sum / static_cast<double>(s.size());
}

}  // namespace grainfield::packing
