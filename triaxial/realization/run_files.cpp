#include "triaxial/realization/run_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/files/energy_csv.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_file.hpp"

namespace grainfield::triaxial {
namespace {

const char* case_name(randomfield::Variable variable) {
    switch (variable) {
        case randomfield::Variable::friction:
            return "friction";
        case randomfield::Variable::stiffness:
            return "stiffness";
        case randomfield::Variable::both:
            return "both";
        case randomfield::Variable::none:
            break;
    }
    return "deterministic";
}

nlohmann::json field_json(const FieldRecord& field, const Config& config) {
    const Vec3& theta = config.field.correlation_length;
    nlohmann::json json = {{"realization", field.realization},
                           {"seed", config.field.seed},
                           {"gamma", field.gamma},
                           {"mean_ratio_expected", field.mean_ratio_expected},
                           {"mean_ratio_cells", field.mean_ratio_cells},
                           {"correlation_length", {theta.x(), theta.y(), theta.z()}}};
    if (field.covariance_error) json["covariance_error"] = *field.covariance_error;
    return json;
}

/// The ledger at the end [J].
nlohmann::json energy_json(const core::Energy& e) {
    return {{"work_put_in", e.work_put_in},
            {"external_work", e.external_work},
            {"friction_work", e.friction_work},
            {"damping_work", e.damping_work},
            {"elastic_normal", e.elastic_normal},
            {"elastic_shear", e.elastic_shear},
            {"kinetic", e.kinetic},
            {"rotational", e.rotational},
            {"gravity", e.gravity}};
}

}  // namespace

nlohmann::json run_summary(const TestResult& r, const FieldRecord& field, const Config& config,
                           const core::Simulation& simulation, const RunTimes& times, int threads) {
    const auto particles = simulation.spheres().size();
    const std::int64_t steps = r.isotropic_steps + r.shear_steps;
    const double stepping = r.isotropic_seconds + r.shear_seconds;
    nlohmann::json json = {
        {"case", case_name(field.variable)},
        {"particles", particles},
        {"contacts", r.contacts},
        {"porosity", r.porosity},
        {"porosity_at_shear", r.sheared_porosity},
        {"coordination_number", r.fabric.coordination_number},
        {"mechanical_coordination_number", r.fabric.mechanical_coordination_number},
        {"rattler_fraction", r.fabric.rattler_fraction},
        {"confining_stress_Pa", config.triaxial.confining_stress},
        {"strain_rate_per_s", config.triaxial.strain_rate},
        {"inertial_number", r.inertial_number},
        {"peak_deviator_stress_Pa", r.results.peak_deviator_stress},
        {"axial_strain_at_peak", r.results.axial_strain_at_peak},
        {"E50_Pa", r.results.E50},
        {"friction_angle_rad", r.results.friction_angle},
        {"smoothed_peak_deviator_stress_Pa", r.results.smoothed_deviator_stress},
        {"smoothed_E50_Pa", r.results.smoothed_E50},
        {"failure", failure_name(r.results.failure)},
        {"peak_found", r.results.failure == Failure::peak},
        {"end_reason", r.end_reason},
        {"lateral_stress_rms_error", r.lateral_rms_error},
        {"lateral_stress_max_error", r.lateral_max_error},
        {"lateral_stress_rms_error_to_E50", r.held.to_E50},
        {"lateral_stress_rms_error_to_peak", r.held.to_peak},
        {"quasi_static", r.quasi_static},
        {"warnings", r.warnings},
        {"first_q_minimum_ratio", r.lowest_start_ratio},
        {"isotropic_unbalanced_force_ratio", r.isotropic_unbalanced},
        {"isotropic_stress_error", r.isotropic_stress_error},
        {"inertia_ratio", r.inertia_ratio},
        {"steps", steps},
        {"isotropic_steps", r.isotropic_steps},
        {"shear_steps", r.shear_steps},
        {"time_step_s", r.mean_step},
        {"wall_seconds",
         {{"packing", times.packing},
          {"field", times.field},
          {"isotropic", r.isotropic_seconds},
          {"shear", r.shear_seconds},
          {"total", times.packing + times.field + stepping}}},
        {"particle_steps_per_second",
         static_cast<double>(particles) * static_cast<double>(steps) / stepping},
        {"state_hash", simulation.state_hash()},
        {"isa", kernels::name(simulation.stats().kernel_table().isa)},
        {"precision", simulation.stats().kernel_table().precision},
        {"threads", threads},
        {"version", GRAINFIELD_VERSION}};
    if (!r.energies.empty()) {
        json["energy_closing_error"] = r.energy_closing_error;
        json["energy_J"] = energy_json(r.energies.back().energy);
        json["shear_began_s"] = r.shear_began;
    }
    if (r.shear_energy) {
        json["damping_share"] = r.shear_energy->damping_share;
        json["kinetic_over_elastic_energy"] = r.shear_energy->kinetic_ratio;
    }
    if (field.variable != randomfield::Variable::none) json["field"] = field_json(field, config);
    return json;
}

std::string curve_csv(const std::vector<CurvePoint>& curve) {
    std::string text =
        "axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,lateral_stress_z_Pa,"
        "volumetric_strain,unbalanced_force_ratio,time_s,contacts\n";
    for (const CurvePoint& p : curve)
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", p.axial_strain,
                       p.deviator_stress, p.axial_stress, p.lateral_stress_x, p.lateral_stress_z,
                       p.volumetric_strain, p.unbalanced_force_ratio, p.time, p.contacts);
    return text;
}

std::string energy_csv(const std::vector<core::EnergyRow>& energies) {
    std::string text = fmt::format("{}\n", core::energy_header);
    for (const core::EnergyRow& row : energies)
        fmt::format_to(std::back_inserter(text), "{},{}\n", row.time,
                       fmt::join(core::energy_columns(row.energy), ","));
    return text;
}

void write_state(const std::filesystem::path& path, const core::Simulation& simulation,
                 const std::string& kind) {
    core::SphereFile file;
    file.spheres = simulation.spheres();
    file.has_normal_stiffness = file.has_friction_angle = file.has_velocity = true;
    file.has_block = file.spheres.size() > 0 && file.spheres.block[0] != core::no_block;
    file.kind = kind;
    const auto walls = simulation.walls();
    if (walls.size() >= 6)
        file.box = core::Box{Vec3(walls[0].point.x(), walls[2].point.y(), walls[4].point.z()),
                             Vec3(walls[1].point.x(), walls[3].point.y(), walls[5].point.z())};
    file.attributes = core::json_text({{"time_s", simulation.time()},
                                       {"steps", simulation.steps()},
                                       {"last_step_s", simulation.last_step()},
                                       {"state_hash", simulation.state_hash()}});
    // Touching contacts: i, j (or -1 - wall) and the shear force on i.
    core::ExtraArray contacts;
    for (const core::TouchingContact& c : simulation.contacts().touching())
        for (double value : {double(c.i), double(c.j), c.shear.x(), c.shear.y(), c.shear.z()})
            contacts.values.push_back(value);
    contacts.shape = {contacts.values.size() / 5, 5};
    if (!contacts.values.empty()) file.extra["contacts"] = std::move(contacts);
    core::write_spheres(path, file);
}

}  // namespace grainfield::triaxial
