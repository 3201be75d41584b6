#include "packing/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/errors.hpp"
#include "packing/compaction.hpp"
#include "packing/deposit.hpp"
#include "packing/shaken_box.hpp"

namespace grainfield::packing {
namespace {

constexpr double placing_height = 2.0;       // of the box that spheres fall in, of b_y [-]
constexpr double porosity_tolerance = 2e-3;  // of the block [-]
constexpr double chance_of_densest = 1e-2;  // so much denser one may come out that is shaken on [-]

/// The spheres without the little motion that is left; all centres must be inside.
core::ParticleStore at_rest(core::ParticleStore spheres, const Vec3& size) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        spheres.velocity.set(i, Vec3::Zero());
        spheres.spin.set(i, Vec3::Zero());
        const Vec3 x = spheres.position[i];
        if ((x.array() < 0).any() || (x.array() > size.array()).any())
            throw SimulationError(fmt::format("sphere {} of the block is outside", i));
    }
    return spheres;
}

/// What may bring a block to a lower porosity.
std::string help(const PackingOptions& options, const GradingDraw& grading) {
    return fmt::format(
        "a higher porosity, another packing.seed, a larger packing.block (its smallest side is "
        "{:.1f} times the largest of {} grains){} or a finer grading may help",
        options.block.minCoeff() / grading.diameter.back(), grading.diameter.size(),
        options.spheres ? ", a larger packing.spheres" : "");
}

/// Grains that are too large for the block are refused; those that nearly are, are pointed out.
void check_largest(const PackingOptions& options, const GradingDraw& grading,
                   core::Monitor& monitor) {
    const double largest = grading.diameter.back(), side = options.block.minCoeff();
    const std::string what =
        fmt::format("the largest of {} grains, {:.4g} m (diameters are scaled by {:.4g}),",
                    grading.diameter.size(), largest, grading.scale);
    if (largest > side)
        throw InputError(fmt::format(
            "packing.block = [{:g}, {:g}, {:g}]: {} does not fit; give a larger packing.block, a "
            "finer grading or, where it fixes the count, a larger packing.spheres",
            options.block.x(), options.block.y(), options.block.z(), what));
    if (largest > large_grain * side)
        monitor.note(fmt::format(
            "warning: {} is {:.2f} of the block's smallest side. Above {:g} walls and few grains "
            "decide how dense and how strong the sample is: use several packing.seed, or a larger "
            "packing.block",
            what, largest / side, large_grain));
}

void check_reachable(const PackingOptions& options, const Block& block) {
    const DensityRange& range = block.range;
    if (options.porosity >= range.densest - chance_of_densest &&
        options.porosity <= range.loosest + porosity_tolerance)
        return;
    throw InputError(fmt::format(
        "packing.porosity = {:g}: cannot be reached with this grading and block, which can have "
        "{:.4f} (shaken without friction) to {:.4f} (fallen and levelled); {}",
        options.porosity, range.densest, range.loosest, help(options, block.grading)));
}

/// Brings a block from its loosest state to the one that is asked for. Returns the box that holds
/// it: this one, or that of the densest state.
ShakenBox& bring_to_state(const PackingOptions& options, Block& block, ShakenBox& box,
                          ShakenBox& densest) {
    block.compaction_friction_angle = options.compaction_friction.value_or(0.0);
    if (options.compaction_friction) {
        shake_with(box, *options.compaction_friction);
        restore_friction(box);
        return box;
    }
    double height = options.block.y();
    if (options.relative_density) {
        if (!block.range.known())
            throw InputError(fmt::format(
                "packing.relative_density = {:g}: this grading and block have no range of density, "
                "{:.4f} (shaken without friction) to {:.4f} (fallen and levelled); a larger "
                "particle.friction_angle, packing.block or packing.spheres may help",
                *options.relative_density, block.range.densest, block.range.loosest));
        const double porosity = block.range.porosity(*options.relative_density);
        height = block.settled_height * (1 - block.range.loosest) / (1 - porosity);
        if (height <= densest.lid_height()) {
            restore_friction(densest);
            return densest;
        }
    } else {
        check_reachable(options, block);
    }
    block.compaction_friction_angle =
        compact_to(box, height, block.range, help(options, block.grading));
    return box;
}

core::ParticleStore spheres_of(const GradingDraw& grading, const Material& material) {
    core::ParticleStore spheres;
    spheres.resize(grading.diameter.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) spheres.radius[i] = 0.5 * grading.diameter[i];
    spheres.set_density(material.density);
    return spheres;
}

}  // namespace

double bulk_unit_weight(const Material& material, double porosity, double gravity) {
    return material.density * (1 - porosity) * gravity;
}

Block pack_block(const PackingOptions& options, const Grading& grading, const Material& material,
                 const kernels::KernelTable& kernels, core::Monitor& monitor) {
    Block block;
    block.grading = draw_diameters(grading, (1 - options.porosity) * options.block.prod(),
                                   options.seed, options.spheres, &monitor);
    check_largest(options, block.grading, monitor);
    core::ParticleStore placed = spheres_of(block.grading, material);
    monitor.begin("placing the spheres of one block");
    const double height =
        place_at_random(placed, options.block.x(), options.block.z(),
                        placing_height * options.block.y(), options.seed, &monitor);
    ShakenBox box(options, material, std::move(placed), height, kernels, monitor);
    let_fall(box);
    block.range.loosest = box.porosity();
    block.settled_height = box.lid_height();

    ShakenBox shaken(options, material, box.spheres(), box.lid_height(), kernels, monitor);
    shake_with(shaken, 0.0);
    block.range.densest = std::min(shaken.porosity(), block.range.loosest);

    ShakenBox& packed = bring_to_state(options, block, box, shaken);
    block.size = Vec3(options.block.x(), packed.lid_height(), options.block.z());
    block.porosity = packed.porosity();
    block.mean_stress = packed.mean_stress();
    block.spheres = at_rest(packed.spheres(), block.size);
    stand_on_head(packed);
    block.hanging = at_rest(packed.spheres(), block.size);
    block.steps = box.steps() + shaken.steps();
    return block;
}

}  // namespace grainfield::packing
