#include "triaxial/config/scene_file.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_reader.hpp"

namespace grainfield::triaxial {
namespace {

SceneWall read_wall(const toml::table& table, double particles_stiffness) {
    TomlReader reader(table, "", "wall.");
    SceneWall wall;
    wall.normal_stiffness = particles_stiffness;
    reader.require({"point", slot(wall.point, any_number), ""});
    reader.require({"normal", slot(wall.normal, any_number), ""});
    reader.read({"friction_angle", slot(wall.friction_angle, below_right_angle), ""});
    reader.read({"normal_stiffness", slot(wall.normal_stiffness, positive), ""});
    reader.read({"stiffness_ratio", slot(wall.stiffness_ratio, non_negative), ""});
    reader.read({"velocity", slot(wall.velocity, any_number), ""});
    reader.read({"stress", slot(wall.stress, positive), ""});
    reader.finish();
    if (reader.has("velocity"))
        reader.refuse("stress", "a wall has either a velocity or a stress, not both");
    const double length = wall.normal.stableNorm();  // no overflow: 1e200 is a fine length
    if (!(length > 0))
        throw reader.wrong_value("normal", *table.get("normal"), "a vector that is not zero");
    wall.normal /= length;
    wall.normal.normalize();  // a subnormal length has few digits
    return wall;
}

std::vector<SceneWall> read_walls(TomlReader& reader, double particles_stiffness) {
    std::vector<SceneWall> walls;
    const toml::node* value = reader.take("wall");
    if (value == nullptr) return walls;
    const toml::array* array = value->as_array();
    const auto is_table = [](const toml::node& one) { return one.is_table(); };
    if (array == nullptr || !std::ranges::all_of(*array, is_table))
        throw reader.wrong_value("wall", *value, "an array of tables [[wall]]");
    for (const toml::node& one : *array)
        walls.push_back(read_wall(*one.as_table(), particles_stiffness));
    return walls;
}

SceneFile read_scene(const toml::table& root, const std::filesystem::path& file) {
    SceneFile scene;
    core::TimeOptions time;
    Keys shared;
    add_keys(shared, scene.particle);
    add_keys(shared, scene.damping);
    add_keys(shared, scene.solver);
    add_keys(shared, time);

    TomlReader reader(root, file.string());
    std::string spheres;
    reader.require({"particles.file", text_slot(spheres, "the path of a sphere file"), ""});
    for (const ConfigKey& key : shared) reader.read(key);
    reader.require({"time.end", slot(scene.end, positive), ""});
    reader.read({"gravity.acceleration", slot(scene.gravity, any_number), ""});
    scene.output_interval = scene.end / 100;
    reader.read({"output.interval", slot(scene.output_interval, positive), ""});
    scene.walls = read_walls(reader, scene.particle.normal_stiffness);
    reader.finish();

    scene.spheres = file.parent_path() / spheres;  // an absolute path stays itself
    scene.density_given = reader.has("particle.density");
    scene.step = time.step;
    scene.safety = time.safety;
    scene.mass_scaling = time.mass_scaling;
    return scene;
}

}  // namespace

SceneFile load_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
    toml::table root = read_toml_file(file);
    for (const std::string& setting : overrides) put_override(root, setting);
    return read_scene(root, file);
}

SceneFile parse_scene(std::string_view text, const std::filesystem::path& file) {
    return read_scene(parse_toml(text, file.string()), file);
}

}  // namespace grainfield::triaxial
