// Neighbour pairs against all pairs.

#include "core/neighbour_search.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/core/test_scenes.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::core {
namespace {

struct Cloud {
    Vec3Column position;
    Column<double> radius;

    void add(const Vec3& x, double r) {
        position.x.push_back(x.x());
        position.y.push_back(x.y());
        position.z.push_back(x.z());
        radius.push_back(r);
    }
    std::size_t size() const { return radius.size(); }
};

std::vector<kernels::Pair> all_pairs(const Cloud& cloud, double skin) {
    std::vector<kernels::Pair> pairs;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        for (std::size_t j = i + 1; j < cloud.size(); ++j) {
            const double reach = cloud.radius[i] + cloud.radius[j] + skin;
            if ((cloud.position[j] - cloud.position[i]).squaredNorm() < reach * reach)
                pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
        }
    return pairs;
}

/// Equality covers order (by i, then j) and uniqueness: all_pairs has both.
void expect_same(const Cloud& cloud, const std::string& name) {
    for (double skin : {0.0, 0.003, 0.1}) {
        const auto found = find_pairs(cloud.position, cloud.radius, skin);
        const auto all = all_pairs(cloud, skin);
        EXPECT_EQ(found, all) << name << ", skin " << skin;
        verify::record(
            {.scene = "Neighbour search",
             .quantity = fmt::format("pairs of {} spheres, {}, skin {}", cloud.size(), name, skin),
             .closed_form = "all pairs, one by one",
             .source = "O(N^2)",
             .tolerance = "none"},
            "any", static_cast<double>(all.size()), static_cast<double>(found.size()), 0);
    }
}

/// Radius between r and 20 r, many small ones.
double mixed_radius(std::uint64_t i) {
    return 0.01 * std::pow(20.0, std::pow(0.5 * (1 + random_vec(i, 7).x()), 3));
}

TEST(NeighbourSearch, NoneOneAndTwoSpheres) {
    Cloud cloud;
    EXPECT_TRUE(find_pairs(cloud.position, cloud.radius, 0.1).empty());
    cloud.add(Vec3(1, 2, 3), 0.5);
    EXPECT_TRUE(find_pairs(cloud.position, cloud.radius, 0.1).empty());
    cloud.add(Vec3(1, 2, 3.9), 0.5);
    EXPECT_EQ(find_pairs(cloud.position, cloud.radius, 0.0), (std::vector<kernels::Pair>{{0, 1}}));
    cloud.position.z[1] = 4.05;
    EXPECT_TRUE(find_pairs(cloud.position, cloud.radius, 0.0).empty());
    EXPECT_EQ(find_pairs(cloud.position, cloud.radius, 0.1).size(), 1u);
}

TEST(NeighbourSearch, RandomEqualSpheres) {
    Cloud cloud;
    for (std::uint64_t i = 0; i < 1500; ++i) cloud.add(random_vec(i), 0.06);
    expect_same(cloud, "random");
}

TEST(NeighbourSearch, TwentyToOneInSize) {
    Cloud cloud;
    for (std::uint64_t i = 0; i < 1500; ++i) cloud.add(0.6 * random_vec(i), mixed_radius(i));
    expect_same(cloud, "20:1");
    EXPECT_GT(all_pairs(cloud, 0.0).size(), 1500u);
}

TEST(NeighbourSearch, ClusteredSpheres) {
    Cloud cloud;
    for (std::uint64_t i = 0; i < 1200; ++i) {
        const Vec3 centre = 50.0 * random_vec(i % 7, 3);
        cloud.add(centre + 0.3 * random_vec(i, 4), mixed_radius(i));
    }
    expect_same(cloud, "clustered");
}

TEST(NeighbourSearch, CoincidentCoordinates) {
    Cloud grid;  // on cell borders, and pairs exactly at reach
    for (int a = 0; a < 9; ++a)
        for (int b = 0; b < 9; ++b)
            for (int c = 0; c < 9; ++c) grid.add(0.25 * Vec3(a, b, c), 0.125);
    expect_same(grid, "grid");
    Cloud heap;  // all at one point
    for (int i = 0; i < 60; ++i) heap.add(Vec3(0.1, 0.2, 0.3), 0.01);
    EXPECT_EQ(find_pairs(heap.position, heap.radius, 0.0).size(), 60u * 59u / 2u);
    Cloud line, sheet;
    for (std::uint64_t i = 0; i < 500; ++i) {
        line.add(Vec3(0, random_vec(i).y(), 0), 0.01);
        sheet.add(Vec3(random_vec(i).x(), 0, random_vec(i).z()), 0.05);
    }
    expect_same(line, "line");
    expect_same(sheet, "sheet");
}

TEST(NeighbourSearch, OneFarOutlier) {
    Cloud cloud;
    for (std::uint64_t i = 0; i < 800; ++i) cloud.add(random_vec(i), mixed_radius(i));
    cloud.add(Vec3(1e6, -2e5, 3e5), 0.02);
    cloud.add(Vec3(1e6, -2e5, 3e5 + 0.03), 0.02);
    expect_same(cloud, "outlier");
}

TEST(NeighbourSearch, OneGiantAmongDust) {
    Cloud cloud;
    for (std::uint64_t i = 0; i < 1000; ++i) cloud.add(random_vec(i), 1e-3);
    cloud.add(Vec3(0.1, 0, 0), 0.9);
    expect_same(cloud, "giant");
}

TEST(NeighbourSearch, NegativeAndLargeOffsets) {
    Cloud cloud;
    for (std::uint64_t i = 0; i < 600; ++i)
        cloud.add(Vec3(-1e4, 2e4, -3e4) + random_vec(i), mixed_radius(i));
    expect_same(cloud, "offset");
}

}  // namespace
}  // namespace grainfield::core
