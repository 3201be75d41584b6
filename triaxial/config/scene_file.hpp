#pragma once
// The file that `simulate` reads: spheres, plane walls, gravity (docs/interface.md, "A scene").

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/solver_options.hpp"
#include "kernels/vec3.hpp"
#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

/// A plane; either moving at a velocity or held at a stress by a servo.
struct SceneWall {
    Vec3 point = Vec3::Zero();              ///< any of the plane [m]
    Vec3 normal = Vec3::UnitY();            ///< unit vector towards the spheres [-]
    double friction_angle = 0;              ///< [rad]
    double normal_stiffness = 0;            ///< the particles' unless given [Pa]
    std::optional<double> stiffness_ratio;  ///< k_s/k_n; unset: the particles' [-]
    Vec3 velocity = Vec3::Zero();           ///< [m/s]
    std::optional<double> stress;           ///< of the servo, compression positive [Pa]
};

struct SceneFile {
    std::filesystem::path spheres;  ///< relative to the working folder, not to the scene's
    std::optional<double> step;     ///< unset: "auto" [s]
    double safety = 0.8;            ///< share of the stability limit, for an automatic step [-]
    double mass_scaling = 1;        ///< >= 1, see core::TimeOptions [-]
    double end = 0;                 ///< [s]
    Vec3 gravity = Vec3::Zero();    ///< acceleration [m/s2]
    ParticleOptions particle;
    bool density_given = false;  ///< particle.density stands in the scene
    core::Damping damping;
    /// Double unless asked otherwise: a scene is small, and more often than not a test of physics.
    core::SolverOptions solver{.precision = core::Precision::double_};
    std::vector<SceneWall> walls;
    double output_interval = 0;  ///< end/100 unless given [s]
};

/// Reads a scene, with overrides (`key.path=value`) over it. Throws InputError (file, line or
/// --set, key, value, what is allowed) and FileError where the scene cannot be read; whether the
/// sphere file is there is not looked at.
SceneFile load_scene(const std::filesystem::path& file,
                     std::span<const std::string> overrides = {});

/// The same from a text; `file` names it in messages and is where its spheres are looked for.
SceneFile parse_scene(std::string_view text, const std::filesystem::path& file);

}  // namespace grainfield::triaxial
