#include "triaxial/scene/scene_output.hpp"

#include <cereal/archives/binary.hpp>
#include <nlohmann/json.hpp>

#include "core/files/energy_csv.hpp"
#include "core/files/folder.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_file.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/scene/contact_table.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

constexpr const char* trajectory_name = "trajectory.csv";
constexpr const char* energy_name = "energy.csv";
constexpr const char* trajectory_header = "time_s,id,x,y,z,vx,vy,vz,wx,wy,wz";

void write_contacts(const core::Simulation& simulation, const fs::path& path) {
    CsvStream table(path,
                    "i,j,overlap_m,normal_force_N,shear_force_x_N,shear_force_y_N,"
                    "shear_force_z_N,normal_stiffness_N_m");
    for (const ContactRow& row : contact_table(simulation)) {
        table.add(std::int64_t{row.i});
        table.add(std::int64_t{row.j});
        for (const double value : {row.overlap, row.normal_force, row.shear_force.x(),
                                   row.shear_force.y(), row.shear_force.z(), row.normal_stiffness})
            table.add(value);
        table.end_row();
    }
    table.commit();
}

std::string summary_text(const SceneSummary& s) {
    const nlohmann::ordered_json json = {
        {"particles", s.particles},
        {"walls", s.walls},
        {"contacts", s.contacts},
        {"steps", s.steps},
        {"time_step_s", s.time_step},
        {"time_s", s.time},
        {"energy_closing_error", s.energy_closing_error},
        {"wall_seconds", {{"total", s.wall_seconds}}},
        {"particle_steps_per_second", s.particle_steps_per_second},
        {"state_hash", s.state_hash},
        {"isa", s.isa},
        {"precision", s.precision},
        {"threads", s.threads},
        {"version", GRAINFIELD_VERSION},
        {"warnings", s.warnings},
    };
    return json.dump(2) + "\n";
}

}  // namespace

SceneOutput::SceneOutput(const fs::path& folder, bool begins) : folder_(folder) {
    core::create_folder(folder);
    if (!begins) return;
    trajectory_.emplace(folder / trajectory_name, trajectory_header);
    energy_.emplace(folder / energy_name, core::energy_header);
}

void SceneOutput::save(core::StateWriter& archive) {
    CsvStream::Mark trajectory = trajectory_->mark(), energy = energy_->mark();
    archive(core::bytes(trajectory), core::bytes(energy), closing_);
}

void SceneOutput::load(core::StateReader& archive) {
    CsvStream::Mark trajectory, energy;
    archive(core::bytes(trajectory), core::bytes(energy), closing_);
    trajectory_.emplace(folder_ / trajectory_name, trajectory);
    energy_.emplace(folder_ / energy_name, energy);
}

void SceneOutput::add(const core::Simulation& simulation, double time) {
    const core::Vec3Column& position = simulation.spheres().position;
    for (std::size_t i = 0; i < position.size(); ++i) {
        const kernels::OnStep motion = simulation.sphere(i).on_step();
        trajectory_->add(time);
        trajectory_->add(static_cast<std::int64_t>(i));
        for (const Vec3& v : {position[i], motion.velocity, motion.spin})
            for (const double component : v) trajectory_->add(component);
        trajectory_->end_row();
    }

    const core::Energy e = simulation.energy();
    energy_->add(time);
    for (const double value : core::energy_columns(e)) energy_->add(value);
    energy_->end_row();
    closing_.add(e);
}

void SceneOutput::finish(const core::Simulation& simulation, const SceneSummary& summary) {
    clear_earlier_run(folder_);
    trajectory_->commit();
    energy_->commit();
    write_contacts(simulation, folder_ / "contacts.csv");
    core::write_file_atomically(folder_ / "summary.json", summary_text(summary));
}

fs::path save_state(const core::Simulation& simulation, const fs::path& folder) {
    core::SphereFile file;
    file.spheres = simulation.spheres();
    file.kind = "state";
    file.has_normal_stiffness = file.has_friction_angle = file.has_velocity = true;
    file.attributes =
        core::json_text({{"time_s", simulation.time()}, {"steps", simulation.steps()}});
    core::ExtraArray walls{{simulation.walls().size(), 9}, {}};
    for (const core::Wall& wall : simulation.walls())
        for (const Vec3& v : {wall.point, wall.normal, wall.velocity})
            walls.values.insert(walls.values.end(), v.begin(), v.end());
    core::ExtraArray contacts{{0, 5}, {}};
    for (const ContactRow& row : contact_table(simulation)) {
        ++contacts.shape[0];
        contacts.values.insert(contacts.values.end(),
                               {double(row.i), double(row.j), row.shear_force.x(),
                                row.shear_force.y(), row.shear_force.z()});
    }
    file.extra = {{"walls_point_normal_velocity", walls}, {"contacts_i_j_shear_force", contacts}};
    const fs::path path = failed_state_file(folder);
    core::write_spheres(path, file);
    return path;
}

}  // namespace grainfield::triaxial
