#include "bench/stressed_sample.hpp"

#include <algorithm>

#include "core/files/sphere_file.hpp"
#include "packing/pack.hpp"
#include "triaxial/config/config.hpp"
#include "triaxial/realization/packing_files.hpp"

namespace grainfield::bench {
namespace {

core::Scene scene_in(core::ParticleStore spheres, const core::Box& box) {
    const triaxial::Config config;
    core::Scene scene;
    scene.spheres = std::move(spheres);
    std::fill(scene.spheres.normal_stiffness.begin(), scene.spheres.normal_stiffness.end(),
              config.particle.normal_stiffness);
    std::fill(scene.spheres.friction_angle.begin(), scene.spheres.friction_angle.end(),
              config.particle.friction_angle);
    scene.spheres.set_density(config.particle.density);
    scene.damping = config.damping;
    scene.stiffness_ratio = config.particle.stiffness_ratio;
    core::Wall wall;
    wall.normal_stiffness = config.particle.normal_stiffness;
    scene.walls = core::box_walls(box, wall);
    return scene;
}

core::Box box_of(const core::Scene& scene) {
    return {Vec3(scene.walls[0].point.x(), scene.walls[2].point.y(), scene.walls[4].point.z()),
            Vec3(scene.walls[1].point.x(), scene.walls[3].point.y(), scene.walls[5].point.z())};
}

}  // namespace

core::Scene stressed_sample(const std::filesystem::path& file,
                            const std::array<std::int32_t, 3>& blocks) {
    if (!std::filesystem::exists(file)) {
        triaxial::Config config;
        config.packing.blocks = blocks;
        config.packing.spheres = 351;
        config.packing.isotropic_stress = 100e3;
        core::Monitor silent;
        const packing::Packing packed =
            packing::pack(config.packing, config.grading, triaxial::packing_material(config),
                          config.time, silent);
        std::filesystem::create_directories(file.parent_path());
        triaxial::write_packing(file, packed, 0.0);
    }
    core::SphereFile read = core::read_spheres(file);
    return scene_in(std::move(read.spheres), read.box.value_or(core::bounding_box(read.spheres)));
}

core::Scene full_sample(const std::filesystem::path& file) {
    return stressed_sample(file, packing::PackingOptions{}.blocks);
}

core::Scene mirrored(const core::Scene& scene, const std::array<int, 3>& times) {
    const core::ParticleStore& s = scene.spheres;
    const core::Box box = box_of(scene);
    const Vec3 size = box.size();
    const auto images = static_cast<std::size_t>(times[0] * times[1] * times[2]);
    core::ParticleStore all;
    all.resize(images * s.size());
    std::size_t k = 0;
    for (int c = 0; c < times[2]; ++c)
        for (int b = 0; b < times[1]; ++b)
            for (int a = 0; a < times[0]; ++a)
                for (std::size_t i = 0; i < s.size(); ++i, ++k) {
                    const std::array<int, 3> image{a, b, c};
                    Vec3 x = s.position[i] - box.lower;
                    for (int axis = 0; axis < 3; ++axis) {
                        const int n = image[static_cast<std::size_t>(axis)];
                        if (n % 2) x[axis] = size[axis] - x[axis];
                        x[axis] += n * size[axis];
                    }
                    all.position.set(k, box.lower + x);
                    all.radius[k] = s.radius[i];
                }
    return scene_in(std::move(all),
                    {box.lower, box.lower + size.cwiseProduct(Vec3(times[0], times[1], times[2]))});
}

core::Scene part(const core::Scene& scene, const std::array<int, 3>& blocks) {
    const core::ParticleStore& s = scene.spheres;
    core::ParticleStore some;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < s.size(); ++i) {
        bool in = true;
        for (std::size_t a = 0; a < 3; ++a) in &= s.block[i][a] < blocks[a];
        if (in) chosen.push_back(i);
    }
    some.resize(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        some.position.set(k, s.position[chosen[k]]);
        some.radius[k] = s.radius[chosen[k]];
    }
    const core::Box box = core::bounding_box(some);
    return scene_in(std::move(some), box);
}

}  // namespace grainfield::bench
