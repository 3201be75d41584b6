#include "core/drive/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace grainfield::core {
namespace {

/// Steps between two estimates. A contact that forms takes several steps to matter, and safety
/// leaves room for one more spring on the worst sphere.
std::int64_t estimate_interval(std::size_t spheres) {
    return spheres > 20000 ? 400 : 20;
}

/// Share of `safety` that local damping leaves. Its force, up to alpha times the load, turns round
/// with the velocity; close to the limit a strongly damped sphere is thrown to and fro by it for
/// ever. Measured: one sphere between a floor and a servo wall, and chains of up to eight, come to
/// rest from any start at 0.8 of the limit with alpha from 0.1 to 0.5, at 0.72 with up to 0.8.
double share_with_damping(const Damping& damping) {
    const double alpha = std::max(damping.force, damping.moment);
    return std::clamp(1.2 - 0.5 * alpha, 0.8, 1.0);
}

/// Steps between two looks at a fixed step.
constexpr std::int64_t fixed_interval = 200;
/// Among so few spheres a contact that lasts for a step or two, too short for the interval, may be
/// the only one that there is.
constexpr std::size_t few_spheres = 50;

constexpr int full_rounds = 5;                             // of Lanczos, from scratch
constexpr int update_rounds = 1;                           // starting from the last mode
constexpr int full_iterations = 8, update_iterations = 5;  // a round

/// Grows whenever there are other neighbours.
std::int64_t searches(const Simulation& simulation) {
    return simulation.stats().searches() + simulation.stats().partial_rebuilds();
}

}  // namespace

double StepControl::frequency(const Simulation& simulation, int rounds) {
    network_ = estimator_.estimate(simulation, rounds,
                                   rounds == full_rounds ? full_iterations : update_iterations);
    const double caged = caged_frequency(simulation, network_);
    caged_governs_ = caged > network_;
    searches_ = searches(simulation);
    return std::max(network_, caged);
}

double StepControl::next(Simulation& simulation) {
    const bool scaled = options_.mass_scaling > 1.0;
    if (watches()) {
        if (due(simulation)) watch_fixed_step(simulation);
        return *options_.step;
    }
    if (due(simulation)) {
        const bool first = next_estimate_ < 0;
        omega_ = frequency(simulation, first ? full_rounds : update_rounds);
        if (scaled && (first || omega_ > 1.05 * omega_target_)) scale_masses(simulation);
        next_estimate_ =
            simulation.steps() + (interval_ > 0 ? interval_ : estimate_interval(simulation.size()));
    } else if (caged_governs_ && searches_ != searches(simulation)) {
        // Other neighbours than those that the bound was found for.
        omega_ = std::max(network_, caged_frequency(simulation, network_));
        searches_ = searches(simulation);
    } else {
        return step_;
    }
    const double governing = scaled ? std::max(omega_, omega_target_) : omega_;
    const double safety = options_.safety * share_with_damping(simulation.scene().damping);
    step_ = options_.step ? *options_.step : safety * 2.0 / governing;
    return step_;
}

bool StepControl::other_contacts(const Simulation& simulation) const {
    return watches() && simulation.size() <= few_spheres &&
           simulation.contacts().count() != contacts_;
}

/// Leaves all of the state as it is, omega_ and limit() too: nothing follows from what is found.
void StepControl::watch_fixed_step(const Simulation& simulation) {
    const bool first = next_estimate_ < 0 || other_contacts(simulation);
    next_estimate_ = simulation.steps() + fixed_interval;
    contacts_ = simulation.contacts().count();
    const double omega = estimator_.estimate(simulation, first ? full_rounds : update_rounds,
                                             first ? full_iterations : update_iterations);
    const double limit = omega > 0 ? 2.0 / omega : 0.0;
    // The estimate is within a per cent.
    const bool above = limit > 0 && *options_.step > 1.01 * limit;
    if (above && (exceeded_ == 0 || limit < exceeded_)) exceeded_ = limit;
}

std::string StepControl::exceeded_text() const {
    if (!(exceeded_ > 0)) return {};
    return fmt::format(
        "the fixed time step of {:.4g} s is above the stability limit 2/omega_max of "
        "{:.4g} s",
        *options_.step, exceeded_);
}

void StepControl::scale_masses(Simulation& simulation) {
    const std::size_t n = simulation.size();
    std::vector<double> scale(n, 1.0);
    simulation.change().set_inertia_scale(scale);
    omega_target_ = frequency(simulation, full_rounds) / options_.mass_scaling;
    std::vector<double> local = local_square_frequencies(simulation);
    const std::vector<double> caged = caged_square_frequencies(simulation);
    for (std::size_t i = 0; i < n; ++i) local[i] = std::max(local[i], caged[i]);
    // A mode of the network is up to sqrt(2) faster than a sphere between fixed neighbours: find
    // the smallest margin that brings the scaled network under the target.
    for (double margin = 1.0; margin < 3.0; margin *= 1.1) {
        for (std::size_t i = 0; i < n; ++i)
            scale[i] = std::max(1.0, margin * local[i] / (omega_target_ * omega_target_));
        simulation.change().set_inertia_scale(scale);
        omega_ = frequency(simulation, full_rounds);
        if (omega_ <= omega_target_) break;
    }
    const auto& mass = simulation.spheres().mass;
    double scaled_mass = 0;
    for (std::size_t i = 0; i < n; ++i) scaled_mass += mass[i] * scale[i];
    inertia_ratio_ = scaled_mass / std::accumulate(mass.begin(), mass.end(), 0.0);
}

}  // namespace grainfield::core
