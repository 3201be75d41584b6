#include "packing/pack.hpp"

#include <fmt/format.h>

#include <chrono>

#include "core/driver.hpp"
#include "core/kernel_choice.hpp"
#include "packing/flip.hpp"
#include "packing/isotropic.hpp"
#include "packing/settle.hpp"

namespace grainfield::packing {
namespace {

class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

core::Wall box_wall(const Material& material) {
    core::Wall wall;
    wall.friction_angle = material.wall_friction_angle;
    wall.normal_stiffness = material.normal_stiffness;
    wall.stiffness_ratio = material.wall_stiffness_ratio;
    return wall;
}

}  // namespace

Packing pack(const PackingOptions& options, const Grading& grading, const Material& material,
             const core::TimeOptions& time, core::Monitor& monitor,
             const core::SolverOptions& solver) {
    options.validate();
    grading.validate();
    Stopwatch watch;
    Packing packing;
    packing.options = options;
    packing.grading = grading;
    packing.block = pack_block(options, grading, material, monitor);
    const std::vector<std::size_t> order = order_in_space(packing.block.spheres, options.block);
    packing.block.spheres = reordered(packing.block.spheres, order);
    packing.block.hanging = reordered(packing.block.hanging, order);
    packing.block_seconds = watch.lap();

    const Vec3 size(options.block.x() * options.blocks[0], options.block.y() * options.blocks[1],
                    options.block.z() * options.blocks[2]);
    core::Scene scene;
    scene.spheres =
        flip(packing.block.spheres, packing.block.hanging, options.block, options.blocks);
    scene.stiffness_ratio = material.stiffness_ratio;
    scene.damping = material.damping;
    scene.walls = core::box_walls({Vec3::Zero(), size}, box_wall(material));
    scene.walls.erase(scene.walls.begin() + 3);  // no lid
    core::Simulation simulation(std::move(scene), core::choose_kernels(solver));
    core::Driver driver(simulation, time, monitor);
    monitor.begin("settling the sample under gravity");
    settle_under_gravity(driver, 2, options.gravity, size.y());

    packing.box = {Vec3::Zero(),
                   Vec3(size.x(), core::bounding_box(simulation.spheres()).upper.y(), size.z())};
    const double base = size.x() * size.z();
    packing.profile =
        measure_stress_profile(simulation, packing.box.upper.y(), base, options.gravity,
                               options.blocks[1] > 4 ? options.blocks[1] : 4);
    packing.fabric = core::measure_fabric(simulation);
    packing.settling_seconds = watch.lap();

    if (options.isotropic_stress) {
        monitor.begin("compressing the sample isotropically");
        simulation.set_gravity(Vec3::Zero());
        simulation.set_walls(core::box_walls(packing.box, box_wall(material)));
        driver.control().reset();
        compress_isotropically(driver, *options.isotropic_stress);
        packing.isotropic_stress = *options.isotropic_stress;
        for (int a = 0; a < 3; ++a) {
            packing.box.lower[a] = simulation.walls()[2 * a].point[a];
            packing.box.upper[a] = simulation.walls()[2 * a + 1].point[a];
        }
        packing.fabric = core::measure_fabric(simulation);
        packing.isotropic_seconds = watch.lap();
    }
    packing.steps = simulation.steps();
    packing.porosity = 1 - simulation.spheres().solid_volume() / packing.box.volume();
    packing.state_hash = simulation.state_hash();
    simulation.scale_velocities(0.0);
    packing.spheres = simulation.spheres();
    return packing;
}

}  // namespace grainfield::packing
