#include "triaxial/realization/shear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/errors.hpp"
#include "core/drive/box.hpp"
#include "core/state/section_of.hpp"
#include "packing/isotropic.hpp"

namespace grainfield::triaxial {
namespace {

constexpr std::size_t top_wall = 3;                // y high, in the order of box_walls()
constexpr double recording_interval = 5e-5;        // of axial strain [-]
constexpr std::size_t points_judged_at_once = 10;  // new ones, before an end is looked for
constexpr double settled_strain = 1e-3;            // from here the largest servo error counts [-]
// A lateral stress off by so much [-] ends a test once it has been for so many inertial times
// d sqrt(rho/sigma_3) and for so much axial strain [-]. A collapse, which a slow test takes as one
// moment, is over sooner; the walls follow it.
constexpr double servo_lost = 0.5;
constexpr double servo_patience_times = 20;
constexpr double servo_patience_strain = 1e-3;

/// Poisson's ratio of a random packing whose spheres move with the mean strain:
/// (1 - lambda)/(4 + lambda). Only the start of the test uses it.
double affine_poisson_ratio(double lambda) {
    return (1 - lambda) / (4 + lambda);
}

}  // namespace

ShearStage::ShearStage(core::Driver& driver, const TriaxialOptions& options, double density,
                       const FailureRule& rule)
    : driver_(driver),
      options_(options),
      start_size_(core::box_dimensions(driver.simulation())),
      rule_(rule),
      inertial_time_(rule.transient_strain / options.strain_rate) {
    // Nothing made of spheres follows the confining stress faster than this: the speed at which a
    // sphere that it pushes from rest has moved by its size, whatever the size.
    const double max_speed = std::sqrt(options.confining_stress / density);
    for (std::size_t wall : {0u, 1u, 4u, 5u})
        servos_.emplace_back(wall, core::WallServo::Options{.stress = options.confining_stress,
                                                            .max_speed = max_speed});
}

/// Gives every sphere and wall the velocity of the imposed strain field, so that the test does not
/// begin with a jolt from the top.
void ShearStage::start_affine() {
    core::Simulation& simulation = driver_.simulation();
    const double lateral =
        affine_poisson_ratio(simulation.scene().stiffness_ratio) * options_.strain_rate;
    const Vec3 low(simulation.walls()[0].point.x(), simulation.walls()[2].point.y(),
                   simulation.walls()[4].point.z());
    const Vec3 middle = low + 0.5 * start_size_;
    simulation.change().add_velocities([&](std::size_t, const Vec3& x) {
        return Vec3(lateral * (x.x() - middle.x()), -options_.strain_rate * (x.y() - low.y()),
                    lateral * (x.z() - middle.z()));
    });
    for (core::WallServo& servo : servos_)
        servo.set_speed(0.5 * lateral * start_size_[static_cast<int>(servo.wall()) / 2]);
}

double ShearStage::axial_strain() const {
    return 1 - core::box_dimensions(driver_.simulation()).y() / start_size_.y();
}

void ShearStage::steer(double step) {
    core::Simulation& simulation = driver_.simulation();
    const Vec3 size = core::box_dimensions(simulation);
    simulation.set_wall_velocity(top_wall, Vec3(0, -options_.strain_rate * size.y(), 0));
    for (core::WallServo& servo : servos_)
        servo.steer(simulation, core::wall_area(size, static_cast<int>(servo.wall()) / 2), step);
    const Vec3 stress(core::axis_stress(simulation, 0), core::axis_stress(simulation, 1),
                      core::axis_stress(simulation, 2));
    stress_sum_ += stress;
    ++stress_count_;
    double worst = 0;
    for (int axis : {0, 2}) {
        const double error = stress[axis] / options_.confining_stress - 1;
        square_error_sum_ += error * error;
        if (std::abs(error) > std::abs(worst)) worst = error;
    }
    time_ += step;
    watch_servos(worst, step);
}

/// Ends a test whose side walls cannot follow: what it would measure is another stress path.
void ShearStage::watch_servos(double error, double step) {
    if (std::abs(error) <= servo_lost || axial_strain() <= settled_strain) {
        time_off_ = 0;
        return;
    }
    if (time_off_ == 0) strain_when_off_ = axial_strain();
    time_off_ += step;
    if (time_off_ < servo_patience_times * inertial_time_ ||
        axial_strain() - strain_when_off_ < servo_patience_strain)
        return;
    const core::Simulation& simulation = driver_.simulation();
    throw SimulationError(fmt::format(
        "the side walls do not hold the confining stress of {:g} Pa: {}; the lateral stresses are "
        "{:g} and {:g} Pa now and were more than {:g} % off for {:.3g} s, {:.3g} times "
        "d*sqrt(rho/sigma_3) (step {}, time {:g} s, axial strain {:.3f} %)",
        options_.confining_stress,
        error > 0 ? "the sample dilates faster than they can give way"
                  : "the sample collapses faster than they can follow",
        core::axis_stress(simulation, 0), core::axis_stress(simulation, 2), 100 * servo_lost,
        time_off_, time_off_ / inertial_time_, simulation.steps(), simulation.time(),
        100 * axial_strain()));
}

/// What the sample's weight adds to the mean of top and bottom: it is no strength [Pa].
double ShearStage::own_weight_stress() const {
    const Vec3 size = core::box_dimensions(driver_.simulation());
    return 0.5 * weight_ / core::wall_area(size, 1);
}

/// Adds a point to the curve; true if the test may end.
bool ShearStage::record() {
    core::Simulation& simulation = driver_.simulation();
    const Vec3 mean = stress_sum_ / static_cast<double>(stress_count_);
    CurvePoint point;
    point.axial_strain = axial_strain();
    point.axial_stress = mean.y() - own_weight_stress();
    point.lateral_stress_x = mean.x();
    point.lateral_stress_z = mean.z();
    point.deviator_stress = point.axial_stress - 0.5 * (mean.x() + mean.z());
    point.volumetric_strain = 1 - core::box_dimensions(simulation).prod() / start_size_.prod();
    point.unbalanced_force_ratio = simulation.unbalanced_force_ratio();
    point.time = time_;
    point.contacts = simulation.contacts().sums().contacts;
    point.lateral_square_error = square_error_sum_ / (2 * static_cast<double>(stress_count_));
    curve_.push_back(point);
    if (point.axial_strain > settled_strain)
        for (int axis : {0, 2})
            max_error_ = std::max(max_error_, std::abs(mean[axis] / options_.confining_stress - 1));
    all_square_errors_ += square_error_sum_;
    stress_sum_.setZero();
    square_error_sum_ = 0;
    stress_count_ = 0;

    highest_ = std::max(highest_, point.deviator_stress);
    return may_end();
}

/// Whether the curve may end with its last point; sets end_reason_.
bool ShearStage::may_end() {
    if (options_.max_axial_strain) {
        if (curve_.back().axial_strain < *options_.max_axial_strain) return false;
        end_reason_ = ended_as_asked;
        return true;
    }
    if (curve_.size() % points_judged_at_once != 0 &&
        curve_.back().axial_strain < failure_strain_limit)
        return false;
    const std::optional<Failure> failure = reached_failure(curve_, rule_);
    if (failure) end_reason_ = failure_name(*failure);
    return failure.has_value();
}

template <class Archive>
void ShearStage::archive_state(Archive& archive) {
    using core::bytes;
    archive(bytes(start_size_), bytes(curve_), highest_, steps_, time_, bytes(stress_sum_),
            square_error_sum_, stress_count_, next_strain_, all_square_errors_, max_error_,
            time_off_, strain_when_off_);
    for (core::WallServo& servo : servos_) archive(servo);
}

void ShearStage::run() {
    const auto section = core::section_of(driver_.checkpoint(), "shear",
                                          [this](auto& archive) { archive_state(archive); });
    if (!section.resumed()) start_affine();
    const core::Simulation& simulation = driver_.simulation();
    const auto& mass = simulation.spheres().mass;
    weight_ =
        std::accumulate(mass.begin(), mass.end(), 0.0) * std::abs(simulation.scene().gravity.y());
    // A sample that collapses moves as fast as the side walls may follow: at that speed its kinetic
    // energy is half the confining stress times the volume of its solids, which is less than this.
    driver_.limit_kinetic_energy(
        core::most_kinetic_energy(simulation, options_.strain_rate, options_.confining_stress) +
        0.5 * options_.confining_stress * start_size_.prod());
    for (bool ended = false; !ended;) {
        driver_.safe_point();
        const bool due = axial_strain() >= next_strain_;
        driver_.step(due, [&](double step) {
            steer(step);
            if (!due) return;
            ended = record();
            next_strain_ += recording_interval;
        });
        ++steps_;
        if (steps_ % 50 == 0) {
            const CurvePoint& last = curve_.back();
            const double done =
                options_.max_axial_strain ? last.axial_strain / *options_.max_axial_strain : -1;
            driver_.monitor().progress(
                done, steps_,
                fmt::format("strain {:.3f} %, q {:.1f} kPa, peak {:.1f} kPa",
                            100 * last.axial_strain, last.deviator_stress / 1e3, highest_ / 1e3));
        }
    }
    driver_.simulation().compute_forces(true);
}

double ShearStage::lateral_rms_error() const {
    return std::sqrt((all_square_errors_ + square_error_sum_) /
                     (2.0 * static_cast<double>(std::max<std::int64_t>(1, steps_))));
}

}  // namespace grainfield::triaxial
