// Which spheres of a sample are drawn, and in which colours.

#include <gtest/gtest.h>

#include "triaxial/report/colouring.hpp"
#include "triaxial/report/sample_view.hpp"

namespace grainfield::triaxial::report {
namespace {

/// n x n x n equal touching spheres.
core::ParticleStore lattice(int n) {
    core::ParticleStore spheres;
    spheres.resize(static_cast<std::size_t>(n * n * n));
    std::size_t at = 0;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                spheres.position.set(at, Vec3(i, j, k) + Vec3::Constant(0.5));
                spheres.block[at] = {i, j, k};
                spheres.normal_stiffness[at] = 1e8 * (1 + i);
                spheres.friction_angle[at] = 0.6;
                spheres.radius[at++] = 0.5;
            }
    return spheres;
}

TEST(SampleView, DrawsTheVisibleFacesOnlyAndBackToFront) {
    const int n = 12;
    const auto spheres = lattice(n);
    const Camera camera;
    const auto discs = visible_discs(spheres, core::bounding_box(spheres), camera);
    std::vector<int> drawn(spheres.size(), 0);
    for (std::size_t i = 0; i < discs.size(); ++i) {
        ++drawn[discs[i].sphere];
        if (i > 0) {
            EXPECT_LE(camera.nearness(spheres.position[discs[i - 1].sphere]),
                      camera.nearness(spheres.position[discs[i].sphere]));
        }
    }
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Vec3 from_face = Vec3::Constant(n - 0.5) - spheres.position[i];
        if (from_face.minCoeff() < 0.1) {
            EXPECT_EQ(drawn[i], 1) << "of a visible face";
        }
        if (from_face.minCoeff() > 2.1) {
            EXPECT_EQ(drawn[i], 0) << "deep inside";
        }
    }
    EXPECT_LT(discs.size(), 3U * n * n * 2);
}

TEST(SampleView, NeedsNoSpheres) {
    EXPECT_TRUE(visible_discs({}, {}, Camera()).empty());
    EXPECT_TRUE(colourings({}).empty());
}

TEST(Colouring, FollowsWhatVaries) {
    auto spheres = lattice(3);
    EXPECT_EQ(colourings(spheres), std::vector{ColourBy::stiffness});
    spheres.friction_angle[4] = 0.5;
    EXPECT_EQ(colourings(spheres), (std::vector{ColourBy::stiffness, ColourBy::friction}));
    spheres.friction_angle[4] = 0.6;
    for (auto& k : spheres.normal_stiffness) k = 9e8;
    EXPECT_EQ(colourings(spheres), std::vector{ColourBy::block});
    for (auto& block : spheres.block) block = core::no_block;
    EXPECT_EQ(colourings(spheres), std::vector{ColourBy::diameter});
}

TEST(Colouring, IsDarkerForLargerValues) {
    const auto spheres = lattice(10);
    const Colouring colouring(spheres, ColourBy::stiffness);
    EXPECT_DOUBLE_EQ(colouring.lowest(), 100);  // MPa
    EXPECT_DOUBLE_EQ(colouring.highest(), 1000);
    double last = 2;
    for (std::size_t i = 0; i < 10; ++i) {
        const Rgb c = colouring.colour(i);
        const double lightness = 0.21 * c.r + 0.72 * c.g + 0.07 * c.b;
        EXPECT_LT(lightness, last);
        last = lightness;
    }
}

TEST(Colouring, NeighbouringBlocksDiffer) {
    const auto spheres = lattice(3);
    const Colouring colouring(spheres, ColourBy::block);
    EXPECT_NE(colouring.colour(0).packed(), colouring.colour(1).packed());
    EXPECT_NE(colouring.colour(0).packed(), colouring.colour(3).packed());
    EXPECT_EQ(colouring.colour(0).packed(), colouring.colour(4).packed());
}

}  // namespace
}  // namespace grainfield::triaxial::report
