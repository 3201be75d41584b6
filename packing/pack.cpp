#include "packing/pack.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/stopwatch.hpp"
#include "core/drive/driver.hpp"
#include "core/kernel_choice.hpp"
#include "core/state/section_of.hpp"
#include "core/state/world_state.hpp"
#include "packing/flip.hpp"
#include "packing/isotropic.hpp"
#include "packing/settle.hpp"
#include "packing/sphere_count.hpp"

namespace grainfield::packing {
namespace {

core::Wall box_wall(const Material& material) {
    core::Wall wall;
    wall.friction_angle = material.wall_friction_angle;
    wall.normal_stiffness = material.normal_stiffness;
    wall.stiffness_ratio = material.wall_stiffness_ratio;
    return wall;
}

/// What has been done. A checkpoint that is made before is one of the state it begins with.
enum class Done : std::int32_t { nothing, block, settling };

template <class Archive>
void archive_packing(Archive& archive, Packing& p) {
    using core::bytes;
    archive(p.block.spheres, p.block.hanging, bytes(p.block.grading.diameter),
            p.block.grading.scale, bytes(p.block.size), bytes(p.block.range), p.block.porosity,
            p.block.settled_height, p.block.mean_stress, p.block.compaction_friction_angle,
            p.block.steps, bytes(p.box), bytes(p.fabric), p.block_seconds, p.settling_seconds);
    for (auto* column :
         {&p.profile.depth, &p.profile.vertical, &p.profile.horizontal_x, &p.profile.horizontal_z})
        archive(bytes(*column));
    archive(p.profile.unit_weight, p.profile.slope_ratio, p.profile.r2, p.profile.K0);
}

Block make_block(const PackingOptions& options, const Grading& grading, const Material& material,
                 const kernels::KernelTable& kernels, core::Monitor& monitor,
                 core::Checkpoint* checkpoint) {
    try {
        Block block = pack_block(options, grading, material, kernels, monitor);
        const std::vector<std::size_t> order = order_in_space(block.spheres, block.size);
        block.spheres = reordered(block.spheres, order);
        block.hanging = reordered(block.hanging, order);
        return block;
    } catch (const Interrupted&) {
        // A block takes seconds: it is made again.
        if (checkpoint != nullptr) checkpoint->save();
        throw;
    }
}

core::Scene flipped_scene(const Block& block, const PackingOptions& options,
                          const Material& material, const Vec3& size) {
    core::Scene scene;
    scene.spheres = flip(block.spheres, block.hanging, block.size, options.blocks);
    scene.stiffness_ratio = material.stiffness_ratio;
    scene.damping = material.damping;
    scene.walls = core::box_walls({Vec3::Zero(), size}, box_wall(material));
    scene.walls.erase(scene.walls.begin() + 3);  // no lid
    return scene;
}

void settle(Packing& packing, core::Driver& driver, const Vec3& size) {
    const PackingOptions& options = packing.options;
    core::Simulation& simulation = driver.simulation();
    driver.monitor().begin("settling the sample under gravity");
    settle_under_gravity(driver, 2, options.gravity, size.y());
    packing.box = {Vec3::Zero(),
                   Vec3(size.x(), core::bounding_box(simulation.spheres()).upper.y(), size.z())};
    packing.profile =
        measure_stress_profile(simulation, packing.box.upper.y(), size.x() * size.z(),
                               options.gravity, options.blocks[1] > 4 ? options.blocks[1] : 4);
    packing.fabric = core::measure_fabric(simulation);
}

void compress(Packing& packing, core::Driver& driver, const Material& material, bool resumed) {
    core::Simulation& simulation = driver.simulation();
    driver.monitor().begin("compressing the sample isotropically");
    if (!resumed) {
        simulation.change().set_gravity(Vec3::Zero());
        simulation.change().set_walls(core::box_walls(packing.box, box_wall(material)));
        driver.control().reset();
    }
    packing.isotropic_stress = *packing.options.isotropic_stress;
    compress_isotropically(driver, packing.isotropic_stress);
    for (int a = 0; a < 3; ++a) {
        packing.box.lower[a] = simulation.walls()[2 * a].point[a];
        packing.box.upper[a] = simulation.walls()[2 * a + 1].point[a];
    }
    packing.fabric = core::measure_fabric(simulation);
}

}  // namespace

Packing pack(const PackingOptions& options, const Grading& grading, const Material& material,
             const core::TimeOptions& time, core::Monitor& monitor,
             const core::SolverOptions& solver, core::Checkpoint* checkpoint) {
    options.validate();
    grading.validate();
    require_countable(options, grading);
    core::Stopwatch watch;
    Done done = Done::nothing;
    Packing packing;
    packing.options = options;
    packing.grading = grading;
    const auto section = core::section_of(checkpoint, "packing", [&](auto& archive) {
        archive(core::bytes(done), watch);
        if (done != Done::nothing) archive_packing(archive, packing);
    });
    if (done == Done::nothing) {
        monitor.note(sphere_count_text(options, grading));
        packing.block = make_block(options, grading, material, core::choose_kernels(solver),
                                   monitor, checkpoint);
        packing.block_seconds = watch.lap();
        done = Done::block;
    }
    const bool resumed = section.resumed() && checkpoint->resuming();
    const Vec3& block = packing.block.size;
    const Vec3 size(block.x() * options.blocks[0], block.y() * options.blocks[1],
                    block.z() * options.blocks[2]);
    core::Simulation simulation(
        resumed ? core::Scene{} : flipped_scene(packing.block, options, material, size),
        core::choose_kernels(solver));
    core::Driver driver(simulation, time, monitor, checkpoint);
    if (done == Done::block) {
        settle(packing, driver, size);
        packing.settling_seconds = watch.lap();
        done = Done::settling;
    }
    if (options.isotropic_stress) {
        compress(packing, driver, material, checkpoint != nullptr && checkpoint->resuming());
        packing.isotropic_seconds = watch.lap();
    }
    packing.steps = simulation.steps();
    packing.porosity = 1 - simulation.spheres().solid_volume() / packing.box.volume();
    packing.state_hash = simulation.state_hash();
    simulation.change().scale_velocities(0.0);
    packing.spheres = simulation.spheres();
    return packing;
}

}  // namespace grainfield::packing
