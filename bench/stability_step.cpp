// The largest stable step of a random packing against the solver's estimate and cruder bounds.
//
// Undamped, a linear network is stable up to 2/omega_max. Local damping takes alpha |F| away where
// a sphere moves along F and adds it where it moves against it. In the mode that alternates from
// step to step the velocity at the time of the force is near zero, and damping holds it there: the
// mode neither dies nor grows while 1/(1 + alpha) < (omega h/2)^2 < 1/(1 - alpha), and grows above.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/stability.hpp"
#include "core/base/random.hpp"
#include "core/drive/frequency.hpp"
#include "core/drive/step_control.hpp"

namespace grainfield::bench {
namespace {

constexpr double perturbation = 3e-12;  // way of a sphere in the first step [m]
// Beyond the limit by 0.03 % the motion grows by more than this in so many steps. Undamped, some
// networks with friction are no stable equilibrium either: their motion grows whatever the step,
// several times slower.
constexpr double growth = 1e4;     // of the motion, that counts as boundless [-]
constexpr int steps = 260;         // [-]
constexpr double accuracy = 3e-4;  // of the bisection [-]

/// Largest motion of a sphere that alternates from step to step, by the fourth difference of its
/// velocity, times h = `step` [m], in the steps after a small perturbation; stops above `enough`
/// [m]. Slow modes do not show in it: one of omega h = 0.5 counts less than a hundredth.
double largest_alternation(const core::Simulation& still, double step, double enough) {
    constexpr int look_interval = 20;
    core::Simulation simulation = copy_of(still, double_kernels());
    const core::RandomStream random(1, core::Stream::perturbation);
    simulation.add_velocities([&](std::size_t i, const Vec3&) -> Vec3 {
        return perturbation / step *
               Vec3(random.normal(0, 3 * i), random.normal(0, 3 * i + 1),
                    random.normal(0, 3 * i + 2));
    });
    double largest = 0;
    for (int k = 0; k < steps && largest <= enough; k += look_interval) {
        for (int n = 5; n < look_interval; ++n) simulation.step(step, [] {});
        std::array<core::Vec3Column, 5> v;
        for (core::Vec3Column& velocity : v) {
            simulation.step(step, [] {});
            velocity = simulation.spheres().velocity;
        }
        for (std::size_t i = 0; i < still.size(); ++i) {
            const Vec3 fourth = (v[0][i] - 4 * v[1][i] + 6 * v[2][i] - 4 * v[3][i] + v[4][i]) / 16;
            const double way = step * fourth.norm();
            if (!std::isfinite(way)) return std::numeric_limits<double>::infinity();
            largest = std::max(largest, way);
        }
    }
    return largest;
}

/// Smallest step at which motion too small to open contacts grows without bound, by bisection [s].
double smallest_unstable_step(const core::Simulation& still, double estimate) {
    const double usual = largest_alternation(still, 0.5 * estimate, 1);
    const auto grows = [&](double step) {
        return largest_alternation(still, step, growth * usual) > growth * usual;
    };
    double low = 0.8 * estimate, high = 1.2 * estimate;
    while (grows(low)) low *= 0.8;
    while (!grows(high)) high *= 1.2;
    while (high - low > accuracy * estimate) {
        const double middle = 0.5 * (low + high);
        (grows(middle) ? high : low) = middle;
    }
    return high;
}

/// The usual bound: 2 sqrt(m/sum K), the smallest of the spheres [s].
double sum_bound(const core::Simulation& simulation) {
    std::vector<double> sum(simulation.size(), 0.0);
    for (const core::ContactSpring& spring : core::contact_springs(simulation)) {
        sum[static_cast<std::size_t>(spring.i)] += spring.kn;
        if (spring.j >= 0) sum[static_cast<std::size_t>(spring.j)] += spring.kn;
    }
    double largest = 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
        largest = std::max(largest, sum[i] * simulation.inverse_inertial_mass(i));
    return 2 / std::sqrt(largest);
}

constexpr const char* header =
    "field,contrast,damping,spheres,contacts,estimate_s,measured_limit_s,measured_over_estimate,"
    "theory_ratio,neighbours_fixed_s,sum_of_stiffness_s,caught_s,step_s,step_over_limit\n";

}  // namespace

void largest_stable_step(const StabilityRun& run) {
    const core::Scene& sample = run.quick ? run.small : run.large;
    const std::vector<double> contrasts =
        run.quick ? std::vector<double>{1, 100} : std::vector<double>{1, 10, 100, 1000, 10000};
    std::string csv = header;
    triaxial::report::DataBlock bounds;
    for (const double contrast : contrasts) {
        core::Simulation still = still_network(sample, contrast);
        const double estimate = 2 / core::FrequencyEstimator().estimate(still);
        const double step = core::StepControl({}).next(still);
        const std::vector<double> local = core::local_square_frequencies(still);
        const double fixed = 2 / std::sqrt(*std::max_element(local.begin(), local.end()));
        const double sum = sum_bound(still), caught = 2 / core::caught_frequency(still, 0);
        std::vector<double> limits;
        for (const core::Damping damping : {core::Damping{}, sample.damping}) {
            still.set_damping(damping);
            limits.push_back(smallest_unstable_step(still, estimate));
            csv += fmt::format(
                "lognormal,{},{},{},{},{:.6g},{:.6g},{:.5f},{:.5f},{:.6g},{:.6g},{:.6g},{:.6g},"
                "{:.4f}\n",
                contrast, damping.force, still.size(), still.touching_contacts(), estimate,
                limits.back(), limits.back() / estimate, 1 / std::sqrt(1 - damping.force), fixed,
                sum, caught, step, step / limits.back());
        }
        bounds.row(contrast, estimate / limits[0], limits[1] / limits[0], fixed / limits[0],
                   sum / limits[0], caught / limits[0], step / limits[0]);
        say(fmt::format("step: contrast {}: limit over estimate {:.4f} undamped, {:.4f} damped",
                        contrast, limits[0] / estimate, limits[1] / estimate));
    }
    write_results(run, "stability_step", csv, {1150, 620}, {{"bounds", bounds}});
}

}  // namespace grainfield::bench
