#include "packing/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/drive/driver.hpp"
#include "core/drive/measures.hpp"
#include "core/drive/servo.hpp"
#include "packing/deposit.hpp"
#include "packing/patience.hpp"

namespace grainfield::packing {
namespace {

// Shaking and lid (docs/method.md, section 4.2): 0.3-3 g and 10-25 Hz pack this block.
constexpr double shaking_acceleration = 2.0;  // share of gravity [-]
constexpr double shaking_frequency = 15.0;    // [1/s]
constexpr double bout = 0.25;                 // of shaking, between two looks at the lid [s]
constexpr double lid_stress_share = 1.0;      // lid stress over the block's own weight's [-]
// Without friction bouts differ in strength and pace.
constexpr double weakest = 0.3, strongest = 3.0;  // share of gravity [-]
constexpr double slowest = 10.0, fastest = 25.0;  // [1/s]
constexpr double friction_factor = 0.7;      // the friction angle goes down by this when stalled
constexpr double lowest_friction = 2e-3;     // below this: none [rad]
constexpr int most_looks_at_rest = 20;       // with too much stress, without friction [-]
constexpr double porosity_tolerance = 2e-3;  // of the block [-]
constexpr double rest_ratio = 1e-3;          // unbalanced force ratio of a settled state [-]
// From this ratio on, a look (50 steps) takes a share of all velocities away: loose spheres that
// bounce in their pores lose little by local damping alone, and what still falls goes on falling.
constexpr double damped_below = 0.05, damped_to = 0.95;  // [-]
// Blocks settle in 1 to 50 times sqrt(height/g), the time of a fall.
constexpr double longest_settling = 200;  // of these times [-]
constexpr double large_grain = 0.5;       // diameter, of the block's smallest side [-]

/// A wall deforms like half of the contact with a mirror image: infinitely stiff, it gives the
/// same force at the same overlap on this side of the mirror plane, so that the block stays in
/// equilibrium when its walls become mirror images (phase 2).
constexpr double mirror_stiffness_factor = 1e6;

constexpr std::size_t lid = 3;  // y high, in the order of box_walls()

class BlockPacker {
  public:
    BlockPacker(const PackingOptions& options, const Material& material, core::Scene scene,
                double lid_height, core::Monitor& monitor)
        : options_(options),
          material_(material),
          simulation_(std::move(scene), kernels::reference_kernels()),
          driver_(simulation_, core::TimeOptions{}, monitor),
          random_(options.seed, core::Stream::packing_shaking) {
        simulation_.change().set_wall_point(lid, Vec3(0, lid_height, 0));
    }

    /// Runs under gravity along -y (or +y: reversed) until at rest_ratio; the lid stays where it
    /// is.
    void settle(const char* stage, bool reversed = false) {
        driver_.monitor().begin(stage);
        simulation_.change().set_gravity(reversed ? Vec3(-gravity()) : gravity());
        simulation_.set_wall_velocity(lid, Vec3::Zero());
        const double deadline =
            simulation_.time() + longest_settling * std::sqrt(lid_height() / options_.gravity);
        double ratio = 1;
        double speed = 0;
        const double negligible = 1e-4 * std::sqrt(options_.gravity * options_.block.y());
        do {
            driver_.safe_point();
            const bool look = simulation_.steps() % 50 == 0;
            driver_.step(look, [&](double) {
                if (!look) return;
                ratio = simulation_.unbalanced_force_ratio();
                speed = mean_speed();
                if (ratio < damped_below) simulation_.change().scale_velocities(damped_to);
            });
            if (simulation_.steps() % 2000 == 0)
                driver_.monitor().progress(-1, simulation_.steps(),
                                           fmt::format("unbalanced force ratio {:.2g}", ratio));
            if (simulation_.time() > deadline)
                driver_.fail(fmt::format(
                    "the block does not come to rest: after {} times sqrt(height/g) the unbalanced "
                    "force ratio is {:.2g} ({:g} is rest) and the mean speed {:.2g} m/s, at a "
                    "porosity of {:.4f}; another packing.seed or more damping.force may help",
                    longest_settling, ratio, rest_ratio, speed, porosity(top_of_bed())));
        } while (ratio > rest_ratio || speed > negligible);
        simulation_.compute_forces(true);
    }

    /// Shakes for a bout with the lid pressing lightly; the lid never goes below b_y. Without
    /// friction strength and pace differ from bout to bout.
    void shake(double friction_angle) {
        simulation_.change().set_friction_angle(friction_angle);
        const double area = options_.block.x() * options_.block.z();
        core::WallServo servo(lid, {.stress = lid_stress_share * own_stress(),
                                    .max_speed = 0.2,
                                    .gain = 0.8,
                                    .integral = 0.02,
                                    .present = 1});
        const double start = simulation_.time();
        const double phase_x = 2 * std::numbers::pi * random_.uniform(0, bouts_);
        const double phase_z = 2 * std::numbers::pi * random_.uniform(1, bouts_);
        double acceleration = shaking_acceleration, frequency = shaking_frequency;
        if (friction_angle == 0.0) {
            acceleration = weakest + (strongest - weakest) * random_.uniform(2, bouts_);
            frequency = slowest + (fastest - slowest) * random_.uniform(3, bouts_);
        }
        ++bouts_;
        while (simulation_.time() < start + bout) {
            driver_.safe_point();
            const double angle = 2 * std::numbers::pi * frequency * (simulation_.time() - start);
            const double a = acceleration * options_.gravity;
            simulation_.change().set_gravity(gravity() + Vec3(a * std::sin(angle + phase_x),
                                                              0.5 * a * std::sin(2 * angle),
                                                              a * std::sin(angle + phase_z)));
            driver_.step(false, [&](double step) {
                servo.steer(simulation_, area, step);
                const double down = -simulation_.walls()[lid].velocity.y();
                const double room = std::max(0.0, (lid_height() - options_.block.y()) / step);
                if (down > room) simulation_.set_wall_velocity(lid, Vec3(0, -room, 0));
            });
        }
    }

    double lid_height() const { return simulation_.walls()[lid].point.y(); }
    double porosity(double height) const {
        return 1 - simulation_.spheres().solid_volume() /
                       (options_.block.x() * options_.block.z() * height);
    }
    /// Mean stress at mid-height of a block under its own weight [Pa].
    double own_stress() const {
        return 0.5 * bulk_unit_weight(material_, options_.porosity, options_.gravity) *
               options_.block.y();
    }
    double mean_stress() const {
        return core::mean_stress(simulation_, options_.block.prod()).trace() / 3;
    }
    double top_of_bed() const {
        double top = 0;
        for (std::size_t i = 0; i < simulation_.spheres().size(); ++i)
            top = std::max(top,
                           simulation_.spheres().position.y[i] + simulation_.spheres().radius[i]);
        return top;
    }
    core::Simulation& simulation() { return simulation_; }

  private:
    Vec3 gravity() const { return {0, -options_.gravity, 0}; }
    double mean_speed() const {
        double sum = 0;
        const core::ParticleStore& s = simulation_.spheres();
        for (std::size_t i = 0; i < s.size(); ++i) sum += s.velocity[i].norm();
        return sum / static_cast<double>(s.size());
    }

    const PackingOptions& options_;
    const Material& material_;
    core::Simulation simulation_;
    core::Driver driver_;
    core::RandomStream random_;
    std::uint64_t bouts_ = 0;
};

/// The spheres without the little motion that is left; all centres must be inside.
core::ParticleStore at_rest(core::ParticleStore spheres, const Vec3& size) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        spheres.velocity.set(i, Vec3::Zero());
        spheres.spin.set(i, Vec3::Zero());
        const Vec3 x = spheres.position[i];
        if ((x.array() < 0).any() || (x.array() > size.array()).any())
            throw SimulationError(fmt::format("sphere {} of the block is outside", i));
    }
    return spheres;
}

/// What may bring a block to a lower porosity.
std::string help(const PackingOptions& options, const GradingDraw& grading) {
    return fmt::format(
        "a higher porosity, another packing.seed, a larger packing.block (its smallest side is "
        "{:.1f} times the largest of {} grains){} or a finer grading may help",
        options.block.minCoeff() / grading.diameter.back(), grading.diameter.size(),
        options.spheres ? ", a larger packing.spheres" : "");
}

/// Grains that are too large for the block are refused; those that nearly are, are pointed out.
void check_largest(const PackingOptions& options, const GradingDraw& grading,
                   core::Monitor& monitor) {
    const double largest = grading.diameter.back(), side = options.block.minCoeff();
    const std::string what =
        fmt::format("the largest of {} grains, {:.4g} m (diameters are scaled by {:.4g}),",
                    grading.diameter.size(), largest, grading.scale);
    if (largest > side)
        throw InputError(fmt::format(
            "packing.block = [{:g}, {:g}, {:g}]: {} does not fit; give a larger packing.block, a "
            "finer grading or, where it fixes the count, a larger packing.spheres",
            options.block.x(), options.block.y(), options.block.z(), what));
    if (largest > large_grain * side)
        monitor.note(fmt::format(
            "warning: {} is {:.2f} of the block's smallest side: few grains decide the sample",
            what, largest / side));
}

}  // namespace

double bulk_unit_weight(const Material& material, double porosity, double gravity) {
    return material.density * (1 - porosity) * gravity;
}

Block pack_block(const PackingOptions& options, const Grading& grading, const Material& material,
                 core::Monitor& monitor) {
    Block block;
    block.grading = draw_diameters(grading, (1 - options.porosity) * options.block.prod(),
                                   options.seed, options.spheres, &monitor);
    check_largest(options, block.grading, monitor);
    const std::size_t n = block.grading.diameter.size();
    core::Scene scene;
    scene.spheres.resize(n);
    for (std::size_t i = 0; i < n; ++i) scene.spheres.radius[i] = 0.5 * block.grading.diameter[i];
    scene.spheres.set_density(material.density);
    std::fill(scene.spheres.normal_stiffness.begin(), scene.spheres.normal_stiffness.end(),
              material.normal_stiffness);
    std::fill(scene.spheres.friction_angle.begin(), scene.spheres.friction_angle.end(),
              material.friction_angle);
    scene.stiffness_ratio = material.stiffness_ratio;
    scene.damping = material.damping;
    monitor.begin("placing the spheres of one block");
    const double height = place_at_random(scene.spheres, options.block.x(), options.block.z(),
                                          2.5 * options.block.y(), options.seed, &monitor);
    core::Wall wall;
    wall.friction_angle = material.wall_friction_angle;
    wall.normal_stiffness = mirror_stiffness_factor * material.normal_stiffness;
    wall.stiffness_ratio = material.wall_stiffness_ratio;
    scene.walls =
        core::box_walls({Vec3::Zero(), {options.block.x(), height, options.block.z()}}, wall);

    // The block decides what sample it becomes, and shaking it is chaotic: the reference
    // kernels make it the same on every machine, whatever vectors that has.
    BlockPacker packer(options, material, std::move(scene), height, monitor);
    packer.settle("settling one block");
    block.settled_height = packer.top_of_bed();
    core::Simulation& simulation = packer.simulation();
    if (const double settled = packer.porosity(block.settled_height);
        settled < options.porosity - porosity_tolerance)
        throw InputError(
            fmt::format("packing.porosity = {:g}: cannot be reached with this grading and block; "
                        "under gravity alone it settles at {:.4f}; a lower porosity or, for a "
                        "looser bed, a larger particle.friction_angle may help",
                        options.porosity, settled));
    simulation.change().set_wall_point(
        lid, Vec3(0, std::max(block.settled_height, options.block.y()), 0));

    monitor.begin("compacting the block");
    const double limit = 2 * packer.own_stress();
    double friction = material.friction_angle;
    const auto lower_friction = [&] {
        friction = friction * friction_factor < lowest_friction ? 0.0 : friction * friction_factor;
    };
    Patience patience(options.block.y(), packer.lid_height());
    for (int failed_at_rest = 0;;) {
        packer.shake(friction);
        const double now = packer.lid_height();
        monitor.progress(
            -1, simulation.steps(),
            fmt::format("porosity {:.4f}, friction {:.3f} rad", packer.porosity(now), friction));
        if (now > options.block.y()) {
            const Patience::Verdict verdict = patience.after_bout(now, friction > 0.0);
            if (verdict == Patience::Verdict::lower_friction) lower_friction();
            if (verdict == Patience::Verdict::give_up)
                throw InputError(
                    fmt::format("packing.porosity = {:g}: cannot be reached with this grading and "
                                "block; shaking, "
                                "at last without friction, ended at {:.4f} after {} bouts; {}",
                                options.porosity, packer.porosity(patience.lowest()),
                                patience.bouts(), help(options, block.grading)));
            continue;
        }
        patience.reached(now);
        simulation.change().set_friction_angle(material.friction_angle);
        packer.settle("settling the compacted block");
        block.mean_stress = packer.mean_stress();
        if (block.mean_stress <= limit) break;
        if (friction == 0.0 && ++failed_at_rest > most_looks_at_rest)
            throw InputError(fmt::format(
                "packing.porosity = {:g}: cannot be reached without stress with this "
                "grading and block; it holds {:.3g} Pa, allowed is {:.3g} Pa; {}",
                options.porosity, block.mean_stress, limit, help(options, block.grading)));
        lower_friction();
    }
    block.compaction_friction_angle = friction;
    block.porosity = packer.porosity(options.block.y());
    block.spheres = at_rest(simulation.spheres(), options.block);
    packer.settle("settling the block on its head", true);
    block.hanging = at_rest(simulation.spheres(), options.block);
    block.steps = simulation.steps();
    return block;
}

}  // namespace grainfield::packing
