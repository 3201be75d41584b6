#include "triaxial/realization/packing_files.hpp"

#include <nlohmann/json.hpp>

#include "core/files/atomic_file.hpp"
#include "core/files/sphere_file.hpp"
#include "triaxial/realization/given_packing.hpp"

namespace grainfield::triaxial {
namespace {

nlohmann::json grading_json(const packing::Packing& p) {
    const std::vector<double>& diameters = p.block.grading.diameter;
    return {{"sieve_diameter_m", p.grading.sieve_diameter},
            {"target_passing_percent", p.grading.passing},
            {"achieved_passing_percent",
             packing::achieved_passing(diameters, p.grading.sieve_diameter)},
            {"achieved_curve",
             {{"diameter_m", diameters},
              {"passing_percent", packing::achieved_passing(diameters, diameters)}}}};
}

nlohmann::json profile_json(const packing::StressProfile& profile) {
    std::vector<double> vertical, horizontal;
    for (double depth : profile.depth) {
        vertical.push_back(profile.unit_weight * depth);
        horizontal.push_back(profile.K0 * profile.unit_weight * depth);
    }
    return {{"depth_m", profile.depth},
            {"vertical_Pa", profile.vertical},
            {"horizontal_x_Pa", profile.horizontal_x},
            {"horizontal_z_Pa", profile.horizontal_z},
            {"theory_vertical_Pa", vertical},
            {"theory_horizontal_Pa", horizontal}};
}

}  // namespace

packing::Material packing_material(const Config& config) {
    return {.density = config.particle.density,
            .normal_stiffness = config.particle.normal_stiffness,
            .stiffness_ratio = config.particle.stiffness_ratio,
            .friction_angle = config.particle.friction_angle,
            .damping = config.damping,
            .wall_friction_angle = config.wall.friction_angle,
            .wall_stiffness_ratio = config.wall.poisson_ratio};
}

packing::Packing pack(const Config& config, core::Monitor& monitor, core::Checkpoint* checkpoint) {
    return packing::pack(config.packing, config.grading, packing_material(config), config.time,
                         monitor, config.solver, checkpoint);
}

nlohmann::json packing_json(const packing::Packing& p, double wall_seconds) {
    const Eigen::Matrix3d& fabric = p.fabric.tensor;
    const std::vector<double>& diameters = p.block.grading.diameter;
    return {{"particles", p.spheres.size()},
            {"porosity", p.porosity},
            {"block_spheres", p.block.spheres.size()},
            {"largest_grain_over_block", p.block.largest_grain()},
            {"ten_largest_grains_mass_fraction", packing::mass_share_of_largest(diameters, 10)},
            {"block_m", {p.block.size.x(), p.block.size.y(), p.block.size.z()}},
            {"block_porosity", p.block.porosity},
            {"relative_density", p.block.range.relative_density(p.block.porosity)},
            {"densest_porosity", p.block.range.densest},
            {"loosest_porosity", p.block.range.loosest},
            {"void_ratio_min", packing::void_ratio(p.block.range.densest)},
            {"void_ratio_max", packing::void_ratio(p.block.range.loosest)},
            {"block_settled_height_m", p.block.settled_height},
            {"block_mean_stress_Pa", p.block.mean_stress},
            {"compaction_friction_angle_rad", p.block.compaction_friction_angle},
            {"diameter_scale", p.block.grading.scale},
            {"blocks", p.options.blocks},
            {"seed", p.options.seed},
            {"gravity_m_s2", p.options.gravity},
            {"isotropic_stress_Pa", p.isotropic_stress},
            {"coordination_number", p.fabric.coordination_number},
            {"mechanical_coordination_number", p.fabric.mechanical_coordination_number},
            {"rattler_fraction", p.fabric.rattler_fraction},
            {"rattler_volume_fraction", p.fabric.rattler_volume_fraction},
            {"fabric_anisotropy", p.fabric.anisotropy},
            {"fabric_tensor_diagonal", {fabric(0, 0), fabric(1, 1), fabric(2, 2)}},
            {"vertical_stress_slope_ratio", p.profile.slope_ratio},
            {"vertical_stress_r2", p.profile.r2},
            {"K0", p.profile.K0},
            {"steps", p.steps},
            {"block_steps", p.block.steps},
            {"wall_seconds", wall_seconds},
            {"wall_seconds_by_stage",
             {{"block", p.block_seconds},
              {"settling", p.settling_seconds},
              {"isotropic", p.isotropic_seconds}}},
            {"state_hash", p.state_hash},
            {"version", GRAINFIELD_VERSION},
            {"grading", grading_json(p)},
            {"stress_profile", profile_json(p.profile)}};
}

std::filesystem::path json_beside(const std::filesystem::path& packing_file) {
    return std::filesystem::path(packing_file).replace_extension(".json");
}

void write_packing(const std::filesystem::path& path, const packing::Packing& p,
                   double wall_seconds) {
    core::SphereFile file;
    file.spheres = p.spheres;
    file.box = p.box;
    file.has_normal_stiffness = file.has_friction_angle = file.has_block = true;
    file.kind = "packing";
    file.attributes = packing_attributes(p);
    core::write_spheres(path, file);
    core::write_file_atomically(json_beside(path), packing_json(p, wall_seconds).dump(2) + "\n");
}

packing::Packing pack_into(const std::filesystem::path& path, const Config& config,
                           core::Monitor& monitor, core::Checkpoint* checkpoint) {
    packing::Packing packed = pack(config, monitor, checkpoint);
    write_packing(path, packed, packed.seconds());
    return packed;
}

}  // namespace grainfield::triaxial
