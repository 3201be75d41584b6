// Networks of contacts at complete rest, for the largest stable step.

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/stability.hpp"
#include "core/base/random.hpp"
#include "core/drive/driver.hpp"
#include "packing/isotropic.hpp"

namespace grainfield::bench {
namespace {

// Below this unbalanced force ratio the motion left is far smaller than any overlap [-].
constexpr double complete_rest = 1e-8;
constexpr double least_load = 1e-2;    // of the mean a sphere carries: less is none [-]
constexpr double high_friction = 1.5;  // [rad]

/// Lognormal, drawn anew for each sphere; the mean stays.
void set_stiffness(core::ParticleStore& s, double contrast) {
    const core::RandomStream random(1, core::Stream::field_stiffness);
    std::vector<double> exponent(s.size());
    random.normals(0, 0, exponent);
    const auto [low, high] = std::minmax_element(exponent.begin(), exponent.end());
    const double scale = std::log(contrast) / (*high - *low);
    double before = 0, after = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        before += s.normal_stiffness[i];
        s.normal_stiffness[i] = std::exp(scale * exponent[i]);
        after += s.normal_stiffness[i];
    }
    for (double& k : s.normal_stiffness) k *= before / after;
}

/// Strong damping, and masses scaled so that all parts come to rest in few steps: statics do not
/// depend on mass. Returns true if the unbalanced force ratio fell to complete rest and stayed
/// there: with few contacts a sphere, some equilibria buckle.
bool come_to_rest(core::Simulation& simulation) {
    constexpr int look_interval = 500, most_looks = 200, calm_looks = 8;
    const core::Damping damping = simulation.scene().damping;
    simulation.change().set_damping({0.7, 0.7});
    simulation.compute_forces();
    // Contacts hardly change any more: one choice of masses and step serves to the end.
    const double step = core::StepControl({{}, 0.6, 10}).next(simulation);
    int calm = 0;
    for (int look = 0; look < most_looks && calm < calm_looks; ++look) {
        for (int k = 0; k < look_interval; ++k) simulation.step(step, [] {});
        simulation.compute_forces(true);
        calm = simulation.unbalanced_force_ratio() < complete_rest ? calm + 1 : 0;
        // Spheres that spin freely between two others lose nothing by local damping.
        if (calm == 0 && look % 5 == 0) simulation.change().scale_velocities(0);
    }
    simulation.change().scale_velocities(0);
    simulation.change().set_inertia_scale(std::vector<double>(simulation.size(), 1.0));
    simulation.change().set_damping(damping);
    simulation.compute_forces(true);
    return calm == calm_looks;
}

/// Spheres that carry a share worth counting, in ascending order.
std::vector<std::size_t> load_bearing(const core::Simulation& simulation) {
    std::vector<double> carried(simulation.size(), 0.0);
    std::vector<int> contacts(simulation.size(), 0);
    double sum = 0;
    for (const core::TouchingContact& contact : simulation.contacts().touching())
        for (const std::int32_t i : {contact.i, contact.j}) {
            if (i < 0) continue;
            const auto k = static_cast<std::size_t>(i);
            carried[k] += contact.force.norm();
            ++contacts[k];
            sum += contact.force.norm();
        }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < simulation.size(); ++i)
        if (contacts[i] > 1 &&
            carried[i] > least_load * sum / static_cast<double>(simulation.size()))
            kept.push_back(i);
    return kept;
}

/// The same simulation with these spheres only, at rest.
core::Simulation reduced(const core::Simulation& simulation, const std::vector<std::size_t>& kept) {
    const core::ParticleStore& s = simulation.spheres();
    core::Scene scene = simulation.scene();
    core::ParticleStore& some = scene.spheres;
    std::vector<std::int32_t> number(s.size(), -1);
    some = {};
    some.resize(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const std::size_t i = kept[k];
        number[i] = static_cast<std::int32_t>(k);
        some.position.set(k, s.position[i]);
        some.radius[k] = s.radius[i];
        some.mass[k] = s.mass[i];
        some.normal_stiffness[k] = s.normal_stiffness[i];
        some.friction_angle[k] = s.friction_angle[i];
    }
    core::Simulation result(std::move(scene), simulation.stats().kernel_table());
    result.compute_forces();
    std::vector<core::ContactShear> contacts;
    for (const core::TouchingContact& contact : simulation.contacts().touching()) {
        const std::int32_t i = number[static_cast<std::size_t>(contact.i)];
        const std::int32_t j =
            contact.j < 0 ? contact.j : number[static_cast<std::size_t>(contact.j)];
        const bool both = i >= 0 && (contact.j < 0 || j >= 0);
        if (both) contacts.push_back({i, j, contact.shear});
    }
    result.change().restore_shear(contacts);
    return result;
}

}  // namespace

core::Simulation still_network(core::Scene scene, double contrast) {
    constexpr int most_rounds = 30;
    constexpr double least_left = 0.2;  // of all spheres: less is another sample [-]
    const auto all = static_cast<double>(scene.spheres.size());
    set_stiffness(scene.spheres, contrast);
    core::Simulation simulation(std::move(scene), double_kernels());
    core::Monitor silent;
    core::Driver driver(simulation, {{}, 0.5, 3}, silent);
    packing::compress_isotropically(driver, confining_stress);
    simulation.change().set_friction_angle(high_friction);
    for (int round = 0; round < most_rounds; ++round) {
        const bool rests = come_to_rest(simulation);
        const std::vector<std::size_t> kept = load_bearing(simulation);
        if (rests && kept.size() == simulation.size()) return simulation;
        if (static_cast<double>(kept.size()) < least_left * all) break;
        simulation = reduced(simulation, kept);
    }
    driver.fail("the network does not come to rest");
}

}  // namespace grainfield::bench
