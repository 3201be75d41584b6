// Scenes of `simulate`.
#include "triaxial/config/scene_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "tests/config/config_fixture.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Scene : public ConfigTest {};

constexpr std::string_view smallest = "[particles]\nfile = \"spheres.csv\"\n[time]\nend = 0.01\n";

TEST_F(Scene, DefaultsAreUndampedWeightlessAndWithoutWalls) {
    const SceneFile scene = load_scene(write("scene.toml", smallest));
    EXPECT_EQ(scene.spheres, folder_ / "spheres.csv");
    EXPECT_EQ(scene.step, std::nullopt);
    EXPECT_EQ(scene.safety, 0.8);
    EXPECT_EQ(scene.mass_scaling, 1);
    EXPECT_EQ(scene.end, 0.01);
    EXPECT_EQ(scene.gravity, Vec3::Zero());
    EXPECT_EQ(scene.particle.density, 2600);
    EXPECT_EQ(scene.particle.normal_stiffness, 9e8);
    EXPECT_EQ(scene.particle.stiffness_ratio, 0.1);
    EXPECT_EQ(scene.particle.friction_angle, 0.6);
    EXPECT_EQ(scene.damping.force, 0);
    EXPECT_EQ(scene.damping.moment, 0);
    EXPECT_EQ(scene.solver.precision, core::Precision::double_);
    EXPECT_EQ(scene.solver.isa, std::nullopt);
    EXPECT_TRUE(scene.walls.empty());
    EXPECT_EQ(scene.output_interval, 0.01 / 100);
}

TEST_F(Scene, ReadsEveryKey) {
    const SceneFile scene = load_scene(write("scene.toml", R"(
[particles]
file = "/data/spheres.csv"
[particle]
density = 2000
normal_stiffness = 1e6
stiffness_ratio = 0
friction_angle = 0.1
[damping]
force = 0.3
moment = 0.4
[solver]
precision = "mixed"
isa = "avx512"
[time]
step = 1e-6
safety = 0.5
mass_scaling = 3
end = 2
[gravity]
acceleration = [1, -9.81, 0]
[[wall]]
point = [0, -1, 0]
normal = [0, 3, 4]
friction_angle = 0.3
normal_stiffness = 5e6
stiffness_ratio = 0.7
velocity = [0, 0.1, 0]
[[wall]]
point = [0, 1, 0]
normal = [0, -1e-310, 0]   # a direction is all it is
stress = 100e3
[output]
interval = 1e-5
)"));
    EXPECT_EQ(scene.spheres, "/data/spheres.csv");
    EXPECT_EQ(scene.particle.density, 2000);
    EXPECT_EQ(scene.particle.normal_stiffness, 1e6);
    EXPECT_EQ(scene.particle.stiffness_ratio, 0);
    EXPECT_EQ(scene.particle.friction_angle, 0.1);
    EXPECT_EQ(scene.damping.force, 0.3);
    EXPECT_EQ(scene.damping.moment, 0.4);
    EXPECT_EQ(scene.solver.precision, core::Precision::mixed);
    EXPECT_EQ(scene.solver.isa, kernels::InstructionSet::avx512);
    EXPECT_EQ(scene.step, 1e-6);
    EXPECT_EQ(scene.safety, 0.5);
    EXPECT_EQ(scene.mass_scaling, 3);
    EXPECT_EQ(scene.end, 2);
    EXPECT_EQ(scene.gravity, Vec3(1, -9.81, 0));
    EXPECT_EQ(scene.output_interval, 1e-5);
    ASSERT_EQ(scene.walls.size(), 2U);
    const SceneWall& floor = scene.walls[0];
    EXPECT_EQ(floor.point, Vec3(0, -1, 0));
    // One rounding a component of a division of numbers near 1.
    EXPECT_LT((floor.normal - Vec3(0, 0.6, 0.8)).norm(), 4e-16);
    EXPECT_EQ(floor.friction_angle, 0.3);
    EXPECT_EQ(floor.normal_stiffness, 5e6);
    EXPECT_EQ(floor.stiffness_ratio, 0.7);
    EXPECT_EQ(floor.velocity, Vec3(0, 0.1, 0));
    EXPECT_EQ(floor.stress, std::nullopt);
    const SceneWall& lid = scene.walls[1];
    EXPECT_EQ(lid.normal, Vec3(0, -1, 0));
    EXPECT_EQ(lid.friction_angle, 0);
    EXPECT_EQ(lid.normal_stiffness, 1e6);  // the particles'
    EXPECT_EQ(lid.stiffness_ratio, std::nullopt);
    EXPECT_EQ(lid.velocity, Vec3::Zero());
    EXPECT_EQ(lid.stress, 100e3);
}

TEST_F(Scene, SettingsGoOverTheFile) {
    const std::vector<std::string> settings{"time.end=0.5", "particles.file=other.csv",
                                            "solver.isa=scalar"};
    const SceneFile scene = load_scene(write("scene.toml", smallest), settings);
    EXPECT_EQ(scene.end, 0.5);
    EXPECT_EQ(scene.output_interval, 0.005);
    EXPECT_EQ(scene.spheres, folder_ / "other.csv");
    EXPECT_EQ(scene.solver.isa, kernels::InstructionSet::scalar);
}

TEST_F(Scene, MistakesNameLineAndKey) {
    struct Mistake {
        const char* text;  ///< after the smallest scene, from line 5
        int line;
        const char* message;
    };
    const std::vector<Mistake> mistakes{
        {"ende = 3", 5, "time.ende is not a known key; did you mean time.end?"},
        {"step = 0", 5, "time.step = 0: \"auto\" or a number > 0 is expected"},
        {"[output]\ninterval = 0", 6, "output.interval = 0: a number > 0 is expected"},
        {"[gravity]\nacceleration = [0, 0]", 6, "an array of 3 numbers is expected"},
        {"[gravity]\nacceleration = [0, 'g', 0]", 6, "an array of 3 numbers is expected"},
        {"[packing]\nseed = 1", 5, "packing is not a known key"},
        {"[wall]\npoint = [0, 0, 0]", 5, "an array of tables [[wall]] is expected"},
        {"[[wall]]\nnormal = [0, 1, 0]", 5, "wall.point is missing: an array of 3 numbers"},
        {"[[wall]]\npoint = [0, 0, 0]", 5, "wall.normal is missing: an array of 3 numbers"},
        {"[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]", 7,
         "wall.normal = [0, 0, 0]: a vector that is not zero is expected"},
        {"[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nfrictoin_angle = 1", 8,
         "wall.frictoin_angle is not a known key; did you mean wall.friction_angle?"},
        {"[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nstress = 1e3\nvelocity = [0, 0, 0]", 8,
         "wall.stress = 1000: a wall has either a velocity or a stress, not both"},
        {"[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nstress = -1", 8,
         "wall.stress = -1: a number > 0 is expected"},
        {"[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nnormal_stiffness = 0", 8,
         "wall.normal_stiffness = 0: a number > 0 is expected"},
    };
    for (const auto& [text, line, message] : mistakes) {
        const auto file = write("scene.toml", std::string(smallest) + text + "\n");
        const std::string found = message_of<InputError>([&] { load_scene(file); });
        EXPECT_THAT(found, StartsWith(file.string() + ":" + std::to_string(line) + ": "));
        EXPECT_THAT(found, HasSubstr(message));
    }
}

TEST_F(Scene, WhatIsMissingIsNamed) {
    const auto no_file = write("a.toml", "[time]\nend = 1\n");
    EXPECT_EQ(
        message_of<InputError>([&] { load_scene(no_file); }),
        no_file.string() + ": particles.file is missing: the path of a sphere file is expected");
    const auto no_end = write("b.toml", "[particles]\nfile = 'a.csv'\n");
    EXPECT_EQ(message_of<InputError>([&] { load_scene(no_end); }),
              no_end.string() + ": time.end is missing: a number > 0 is expected");
    EXPECT_THAT(message_of<FileError>([] { load_scene("nowhere.toml"); }),
                StartsWith("cannot read nowhere.toml: "));
}

}  // namespace
}  // namespace grainfield::triaxial
