#include "packing/flip.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace grainfield::packing {
namespace {

void copy_sphere(const core::ParticleStore& from, std::size_t i, core::ParticleStore& to,
                 std::size_t k) {
    to.position.set(k, from.position[i]);
    to.velocity.set(k, from.velocity[i]);
    to.spin.set(k, from.spin[i]);
    to.radius[k] = from.radius[i];
    to.mass[k] = from.mass[i];
    to.normal_stiffness[k] = from.normal_stiffness[i];
    to.friction_angle[k] = from.friction_angle[i];
    to.block[k] = from.block[i];
}

/// Z-order (Morton) code of a point in the unit cube, eight bits an axis.
std::uint32_t morton(const Vec3& unit) {
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::uint32_t>(std::clamp(unit[axis], 0.0, 0.999) * 256);
        for (int bit = 0; bit < 8; ++bit) code |= (cell >> bit & 1u) << (3 * bit + axis);
    }
    return code;
}

}  // namespace

core::ParticleStore flip(const core::ParticleStore& block, const core::ParticleStore& hanging,
                         const Vec3& size, const std::array<std::int32_t, 3>& blocks) {
    const std::size_t n = block.size();
    core::ParticleStore sample;
    sample.resize(n * static_cast<std::size_t>(blocks[0]) * static_cast<std::size_t>(blocks[1]) *
                  static_cast<std::size_t>(blocks[2]));
    std::size_t k = 0;
    for (std::int32_t bz = 0; bz < blocks[2]; ++bz)
        for (std::int32_t by = 0; by < blocks[1]; ++by)
            for (std::int32_t bx = 0; bx < blocks[0]; ++bx) {
                const core::BlockIndex index{bx, by, bz};
                const core::ParticleStore& original = by % 2 ? hanging : block;
                for (std::size_t i = 0; i < n; ++i, ++k) {
                    copy_sphere(original, i, sample, k);
                    Vec3 x = original.position[i];
                    for (int a = 0; a < 3; ++a) {
                        const std::int32_t b = index[static_cast<std::size_t>(a)];
                        if (b % 2) x[a] = size[a] - x[a];  // odd blocks are mirror images
                        x[a] += b * size[a];
                    }
                    sample.position.set(k, x);
                    sample.block[k] = index;
                }
            }
    return sample;
}

std::vector<std::size_t> order_in_space(const core::ParticleStore& block, const Vec3& size) {
    std::vector<std::size_t> order(block.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return morton(block.position[a].cwiseQuotient(size)) <
               morton(block.position[b].cwiseQuotient(size));
    });
    return order;
}

core::ParticleStore reordered(const core::ParticleStore& spheres,
                              const std::vector<std::size_t>& order) {
    core::ParticleStore result;
    result.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) copy_sphere(spheres, order[k], result, k);
    return result;
}

}  // namespace grainfield::packing
