// Placing without overlap, and the flip technique.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

#include "core/base/random.hpp"
#include "packing/flip.hpp"
#include "packing/size_grid.hpp"
#include "tests/packing/small_samples.hpp"

namespace grainfield::packing {
namespace {

using ::testing::HasSubstr;
using testing::spheres_of;

std::vector<double> many_radii(int n) {
    std::vector<double> radii;
    for (int i = 0; i < n; ++i)
        radii.push_back(0.01 + 0.03 * std::pow((i * 37 % n) / double(n), 4));
    return radii;
}

TEST(PlaceAtRandom, NothingOverlapsOrReachesOut) {
    for (const double start_height : {0.02, 0.6}) {  // too low for them: the box grows
        SCOPED_TRACE(start_height);
        core::ParticleStore s = spheres_of(many_radii(150), {});
        const double width = 0.25, depth = 0.2;
        const double height = place_at_random(s, width, depth, start_height, 3);
        EXPECT_GE(height, start_height);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec3 x = s.position[i];
            EXPECT_GE((x.array() - s.radius[i]).minCoeff(), 0) << i;
            EXPECT_GE((Vec3(width, height, depth) - x).minCoeff() - s.radius[i], -1e-15) << i;
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GE((x - s.position[j]).norm(), (1 - 1e-14) * (s.radius[i] + s.radius[j]));
        }
    }
}

TEST(PlaceAtRandom, IsAFunctionOfTheSeedAndKeepsTheOrder) {
    core::ParticleStore a = spheres_of(many_radii(40), {}), b = a, c = a;
    place_at_random(a, 0.3, 0.3, 0.5, 1);
    place_at_random(b, 0.3, 0.3, 0.5, 1);
    place_at_random(c, 0.3, 0.3, 0.5, 2);
    EXPECT_EQ(a.position, b.position);
    EXPECT_NE(a.position, c.position);
    EXPECT_TRUE(std::equal(a.radius.begin(), a.radius.end(), c.radius.begin()));
}

TEST(PlaceAtRandom, SphereWiderThanTheBoxIsRefused) {
    core::ParticleStore s = spheres_of({0.05, 0.11, 0.01}, {});
    const std::string message = message_of<InputError>([&] { place_at_random(s, 0.3, 0.2, 1, 1); });
    EXPECT_THAT(message, HasSubstr("packing.block"));
    EXPECT_THAT(message, HasSubstr("0.22"));
}

TEST(SizeGrid, FindsWhatALookAtEverySphereFinds) {
    // Radii over three orders of magnitude, from the largest down; probes of any smaller size.
    const core::RandomStream random(1, core::Stream::packing_position);
    std::vector<double> radii;
    for (int i = 0; i < 400; ++i) radii.push_back(0.1 * std::pow(10, -3.0 * i / 400));
    core::ParticleStore s = spheres_of(radii, {});
    SizeGrid grid(s);
    std::uint64_t drawn = 0;
    const auto place = [&] {
        const auto [u, v] = random.uniform_pair(0, drawn++);
        return Vec3(u, v, random.uniform(0, drawn++));
    };
    int overlapping = 0;
    for (std::size_t n = 0; n < s.size(); ++n) {
        for (int probe = 0; probe < 20; ++probe) {
            const Vec3 x = place();
            const double r = s.radius[n] * (probe % 2 ? 1.0 : 0.1);
            bool expected = false;
            for (std::size_t j = 0; j < n; ++j)
                expected |= (s.position[j] - x).norm() < r + s.radius[j];
            ASSERT_EQ(grid.overlaps(x, r), expected) << n << ' ' << probe;
            overlapping += expected;
        }
        s.position.set(n, place());
        grid.add(n);
    }
    EXPECT_GT(overlapping, 400);
    EXPECT_LT(overlapping, 7600);
}

TEST(PlaceAtRandom, ManySpheresOfManySizesTakeSeconds) {
    // A look at every sphere for each of the 5e5 places that are tried would be 1e10 distances.
    std::vector<double> radii;
    for (int i = 0; i < 40000; ++i) radii.push_back(0.05 / (1 + 0.002 * i));
    core::ParticleStore s = spheres_of(radii, {});
    const std::clock_t begin = std::clock();
    place_at_random(s, 0.5, 0.5, 1.2, 1);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 5);
}

/// A block of 20 spheres with every property its own; the first touches the wall x = b_x.
core::ParticleStore some_block(const Vec3& size, double overlap) {
    core::ParticleStore s = spheres_of(many_radii(20), {});
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double t = static_cast<double>(i);
        s.position.set(i, Vec3(0.2 + 0.03 * t, 0.9 - 0.04 * t, 0.1 + 0.02 * t).cwiseProduct(size));
        s.normal_stiffness[i] *= 1 + 0.1 * t;
        s.friction_angle[i] *= 1 + 0.01 * t;
    }
    s.position.x[0] = size.x() - s.radius[0] + overlap;
    return s;
}

TEST(Flip, EveryBlockIsTheMirrorImageOfItsNeighbour) {
    const Vec3 size(0.3, 0.25, 0.2);
    const std::array<std::int32_t, 3> blocks{3, 4, 2};
    const core::ParticleStore block = some_block(size, 1e-4);
    core::ParticleStore hanging = block;
    for (double& y : hanging.position.y) y += 0.01;
    const core::ParticleStore sample = flip(block, hanging, size, blocks);
    ASSERT_EQ(sample.size(), block.size() * 24);
    std::size_t at = 0;
    for (std::int32_t k = 0; k < blocks[2]; ++k)
        for (std::int32_t j = 0; j < blocks[1]; ++j)
            for (std::int32_t i = 0; i < blocks[0]; ++i)
                for (std::size_t n = 0; n < block.size(); ++n, ++at) {
                    const core::BlockIndex index{i, j, k};
                    EXPECT_EQ(sample.block[at], index);
                    Vec3 x = (j % 2 ? hanging : block).position[n];
                    for (int a = 0; a < 3; ++a) {
                        const std::int32_t b = index[static_cast<std::size_t>(a)];
                        x[a] = b * size[a] + (b % 2 ? size[a] - x[a] : x[a]);
                    }
                    // Positions are of the order of the sample: its round-off.
                    EXPECT_LE((sample.position[at] - x).cwiseAbs().maxCoeff(), 4e-16);
                    EXPECT_EQ(sample.radius[at], block.radius[n]);
                    EXPECT_EQ(sample.mass[at], block.mass[n]);
                    EXPECT_EQ(sample.normal_stiffness[at], block.normal_stiffness[n]);
                    EXPECT_EQ(sample.friction_angle[at], block.friction_angle[n]);
                }
    EXPECT_NEAR(sample.solid_volume(), 24 * block.solid_volume(), 1e-12 * sample.solid_volume());
}

TEST(Flip, ContactWithAWallBecomesContactWithTheImage) {
    const Vec3 size(0.3, 0.25, 0.2);
    const double overlap = 1e-4;
    const core::ParticleStore block = some_block(size, overlap);
    const core::ParticleStore sample = flip(block, block, size, {2, 1, 1});
    const Vec3 to_image = sample.position[block.size()] - sample.position[0];
    EXPECT_NEAR(2 * block.radius[0] - to_image.norm(), 2 * overlap, 1e-15);
    EXPECT_NEAR(sample.position.x[0] + sample.position.x[block.size()], 2 * size.x(), 1e-15);
    EXPECT_EQ(to_image.y(), 0);
    EXPECT_EQ(to_image.z(), 0);
}

TEST(OrderInSpace, IsAPermutationThatBringsNeighboursTogether) {
    core::ParticleStore s = spheres_of(many_radii(150), {});
    const double height = place_at_random(s, 0.25, 0.25, 0.25, 3);
    const Vec3 size(0.25, height, 0.25);
    const std::vector<std::size_t> order = order_in_space(s, size);
    std::vector<std::size_t> sorted = order, all(s.size());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(sorted, all);

    const core::ParticleStore moved = reordered(s, order);
    for (std::size_t k = 0; k < order.size(); ++k) {
        EXPECT_EQ(moved.position[k], s.position[order[k]]);
        EXPECT_EQ(moved.radius[k], s.radius[order[k]]);
        EXPECT_EQ(moved.mass[k], s.mass[order[k]]);
    }
    const auto path = [](const core::ParticleStore& store) {
        double sum = 0;
        for (std::size_t k = 1; k < store.size(); ++k)
            sum += (store.position[k] - store.position[k - 1]).norm();
        return sum;
    };
    EXPECT_LT(path(moved), 0.7 * path(s));
    EXPECT_EQ(order_in_space(moved, size), all);
}

}  // namespace
}  // namespace grainfield::packing
