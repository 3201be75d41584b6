#include "triaxial/realization/triaxial_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/stopwatch.hpp"
#include "core/drive/box.hpp"
#include "core/state/section_of.hpp"
#include "packing/isotropic.hpp"
#include "triaxial/realization/shear.hpp"

namespace grainfield::triaxial {
namespace {

/// I = strain rate * d * sqrt(rho/p), d the mean diameter by volume, rho of the real masses.
double inertial_number(const core::ParticleStore& s, const Config& config) {
    double cubes = 0, fourths = 0;
    for (double r : s.radius) {
        cubes += r * r * r;
        fourths += r * r * r * r;
    }
    return config.triaxial.strain_rate * 2 * fourths / cubes *
           std::sqrt(config.particle.density / config.triaxial.confining_stress);
}

}  // namespace

core::Scene make_scene(Sample sample, const Config& config) {
    core::Scene scene;
    scene.spheres = std::move(sample.spheres);
    scene.stiffness_ratio = config.particle.stiffness_ratio;
    scene.damping = config.damping;
    scene.gravity = Vec3(0, -config.triaxial.gravity, 0);
    core::Wall wall;
    wall.friction_angle = config.wall.friction_angle;
    wall.normal_stiffness = config.particle.normal_stiffness;
    wall.stiffness_ratio = config.wall.poisson_ratio;
    scene.walls = core::box_walls(sample.box, wall);
    return scene;
}

core::Simulation make_simulation(Sample sample, const Config& config,
                                 const kernels::KernelTable& kernels, const std::string& name,
                                 const core::SimulationOptions& options) {
    const std::vector<core::ContactShear> contacts = std::move(sample.contacts);
    core::Scene scene = make_scene(std::move(sample), config);
    core::check_start(scene, name);
    core::Simulation simulation(std::move(scene), kernels, options);
    if (contacts.empty()) return simulation;
    simulation.compute_forces();
    // One that just so touched may be apart by round-off: it carried next to nothing.
    simulation.change().restore_shear(contacts);
    return simulation;
}

namespace {

/// What the isotropic stage leaves to the shear stage; the rest is found at the end.
template <class Archive>
void archive_result(Archive& archive, TestResult& r) {
    using core::bytes;
    archive(r.porosity, r.sheared_porosity, r.contacts, bytes(r.fabric), r.isotropic_steps,
            r.isotropic_unbalanced, r.isotropic_stress_error, r.isotropic_seconds,
            bytes(r.energies), r.shear_began);
}

void compress(TestResult& result, core::Driver& driver, const Config& config, double solid) {
    const core::Simulation& simulation = driver.simulation();
    driver.monitor().begin("isotropic compression");
    const packing::IsotropicResult isotropic =
        packing::compress_isotropically(driver, config.triaxial.confining_stress);
    result.isotropic_steps = isotropic.steps;
    result.isotropic_unbalanced = isotropic.unbalanced_force_ratio;
    result.isotropic_stress_error = isotropic.stress_error;
    if (simulation.keeps_ledger()) driver.log_energy();
    result.shear_began = simulation.time();
    result.sheared_porosity = 1 - solid / core::box_dimensions(simulation).prod();
    result.contacts = simulation.contacts().count();
    result.fabric = core::measure_fabric(simulation);
}

/// Ends a test whose confining stress was not held where its results come from: they are those of
/// another stress path.
void require_held_stress(const TestResult& r, core::Driver& driver, const Config& config) {
    if (r.held.worst() <= stress_not_held) return;
    driver.fail(fmt::format(
        "the confining stress of {:g} Pa was not held: the lateral stresses were off by {:.3g} % "
        "(RMS) up to where E50 is read ({:.3g} % of axial strain) and by {:.3g} % up to the "
        "largest deviator stress (at {:.3g} %), more than {:g} %; a slower test "
        "(triaxial.strain_rate, {:g} 1/s now) gives the walls time: the inertial number is {:.2g}",
        config.triaxial.confining_stress, 100 * r.held.to_E50,
        100 * 0.5 * r.results.peak_deviator_stress / r.results.E50, 100 * r.held.to_peak,
        100 * r.results.axial_strain_at_peak, 100 * stress_not_held, config.triaxial.strain_rate,
        r.inertial_number));
}

std::vector<std::string> warnings_of(const TestResult& r, const core::Driver& driver) {
    std::vector<std::string> warnings;
    if (r.held.worst() > stress_held_badly)
        warnings.push_back(fmt::format(
            "the confining stress was held within {:.3g} % (RMS) up to E50 and {:.3g} % up to the "
            "peak, aim: {:g} %; a slower test (triaxial.strain_rate) holds it better",
            100 * r.held.to_E50, 100 * r.held.to_peak, 100 * stress_held_badly));
    if (std::string text = not_quasi_static(r.inertial_number, r.shear_energy); !text.empty())
        warnings.push_back(std::move(text));
    if (std::string text = driver.control().exceeded_text(); !text.empty())
        warnings.push_back(std::move(text));
    return warnings;
}

/// What `shear` left behind, and what can be read off it.
void evaluate(TestResult& result, const ShearStage& shear, const FailureRule& rule,
              core::Driver& driver, const Config& config) {
    core::EnergyClosing closing;
    for (const core::EnergyRow& row : result.energies) closing.add(row.energy);
    result.energy_closing_error = closing.error();
    result.curve = shear.curve();
    result.end_reason = shear.end_reason();
    result.shear_steps = shear.steps();
    result.mean_step = shear.time() / static_cast<double>(shear.steps());
    result.lateral_rms_error = shear.lateral_rms_error();
    result.lateral_max_error = shear.lateral_max_error();
    result.inertia_ratio = driver.control().inertia_ratio();
    result.inertial_number = rule.transient_strain * std::sqrt(result.inertia_ratio);
    try {
        result.results = evaluate_curve(result.curve, config.triaxial.confining_stress, rule);
    } catch (const SimulationError& error) {
        driver.fail(error.what());  // its state is worth a look
    }
    for (const CurvePoint& p : result.curve) {
        if (p.deviator_stress > 0.5 * result.results.peak_deviator_stress) break;
        result.lowest_start_ratio = std::min(result.lowest_start_ratio,
                                             p.deviator_stress / config.triaxial.confining_stress);
    }
    result.held = held_stress(result.curve, result.results);
    require_held_stress(result, driver, config);
    const auto peak = std::ranges::lower_bound(result.curve, result.results.axial_strain_at_peak,
                                               {}, &CurvePoint::axial_strain);
    result.shear_energy = shear_energy(result.energies, result.shear_began, peak->time);
    result.quasi_static = not_quasi_static(result.inertial_number, result.shear_energy).empty();
    result.warnings = warnings_of(result, driver);
}

void shear(TestResult& result, core::Driver& driver, const Config& config) {
    driver.monitor().begin("shear");
    const core::ParticleStore& spheres = driver.simulation().spheres();
    // I is the axial strain within d sqrt(rho/sigma_3), the time in which a sphere under the
    // confining stress moves by its size: no sample has failed before.
    const FailureRule rule{.spheres = spheres.size(),
                           .transient_strain = inertial_number(spheres, config)};
    ShearStage shear(driver, config.triaxial, config.particle.density, rule);
    shear.run();
    if (driver.simulation().keeps_ledger()) driver.log_energy();
    evaluate(result, shear, rule, driver, config);
}

}  // namespace

TestResult run_test(core::Simulation& simulation, const Config& config, core::Monitor& monitor,
                    core::Checkpoint* checkpoint) {
    core::Driver driver(simulation, config.time, monitor, checkpoint);
    TestResult result;
    core::Stopwatch watch;
    bool compressed = false;
    const auto section = core::section_of(checkpoint, "triaxial test", [&](auto& archive) {
        archive(compressed, watch);
        archive_result(archive, result);
    });
    const double solid = simulation.spheres().solid_volume();
    if (!section.resumed()) result.porosity = 1 - solid / core::box_dimensions(simulation).prod();
    if (simulation.keeps_ledger()) driver.log_energies_to(result.energies);
    if (!compressed) {
        compress(result, driver, config, solid);
        result.isotropic_seconds = watch.lap();
        compressed = true;
    }
    shear(result, driver, config);
    result.shear_seconds = watch.lap();
    return result;
}

}  // namespace grainfield::triaxial
