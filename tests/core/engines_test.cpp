// Every engine against the reference, and against itself by another way.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/vector/candidate_list.hpp"
#include "core/vector/spatial_order.hpp"
#include "tests/core/test_scenes.hpp"
#include "tests/larger.hpp"

namespace grainfield::core {
namespace {

/// A dense, frictional crowd in a box with a moving lid: several domains, every kind of contact.
Scene crowd(bool per_sphere) {
    std::vector<Ball> balls = loose_balls({20, 18, 20}, 0.98, 0.3);
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].w = 3.0 * random_vec(i, 9);
    if (per_sphere)
        for (std::size_t i = 0; i < balls.size(); i += 2) balls[i].stiffness *= 5;
    Scene scene = scene_of(balls, 0.4);
    scene.walls = box_walls(loose_box({20, 18, 20}, 0.98), plane(Vec3::Zero(), Vec3::UnitX(), 0.3));
    scene.walls[3].velocity = Vec3(0, -0.2, 0);
    scene.gravity = Vec3(0, -9.81, 0);
    scene.damping = {0.2, 0.1};
    return scene;
}

using Engines = KernelTest;

TEST_P(Engines, ForcesAndMotionAreThoseOfTheReference) {
    for (const bool per_sphere : {false, true}) {
        Simulation sim(crowd(per_sphere), table());
        Simulation reference(crowd(per_sphere), kernels::reference_kernels());
        ASSERT_GE(sim.size(), 7200u) << "not more than one domain";
        const double step = 1e-4;
        for (int k = 0; k < 5; ++k) {
            sim.compute_forces(true);
            reference.compute_forces(true);
            ASSERT_EQ(sim.contacts().count(), reference.contacts().count());
            // Overlaps of some 1e-2 of the radius come in with the round-off of the distance, the
            // shear forces with that of a step's motion; a few contacts a sphere add up.
            const double scale = 0.5 * test_radius * 5 * test_stiffness * 0.1 * test_radius;
            double worst = 0;
            for (std::size_t i = 0; i < sim.size(); ++i)
                worst = larger(
                    worst, (sim.sphere(i).resultant() - reference.sphere(i).resultant()).norm());
            EXPECT_LT(worst, roundoff(1000) * scale) << k;
            for (std::size_t w = 0; w < 6; ++w) {
                const kernels::WallLoad &a = sim.wall_loads()[w], &b = reference.wall_loads()[w];
                EXPECT_LT((a.force - b.force).norm(), roundoff(1000) * (scale + b.force.norm()));
                EXPECT_NEAR(a.stiffness, b.stiffness, roundoff(100) * b.stiffness);
                EXPECT_EQ(a.contacts, b.contacts);
            }
            const kernels::ContactSums &a = sim.contacts().sums(), &b = reference.contacts().sums();
            EXPECT_EQ(a.contacts, b.contacts);
            EXPECT_NEAR(a.normal_force, b.normal_force, roundoff(100) * b.normal_force);
            EXPECT_NEAR(a.elastic_normal, b.elastic_normal, roundoff(200) * b.elastic_normal);
            EXPECT_NEAR(a.elastic_shear, b.elastic_shear, roundoff(1e4) * b.elastic_shear);
            sim.advance(step);
            reference.advance(step);
        }
    }
}

TEST_P(Engines, PropertiesChangedBetweenForcesAndMotionKeepMomentum) {
    // Whatever forces move the spheres then, both of a pair feel the same one, across the borders
    // of domains too.
    Scene scene = crowd(true);
    scene.walls.clear();
    scene.gravity = Vec3::Zero();
    scene.damping = {0, 0};
    Simulation sim(std::move(scene), table());
    const auto momentum = [&] {
        Vec3 sum = Vec3::Zero();
        const ParticleStore& s = sim.spheres();
        for (std::size_t i = 0; i < s.size(); ++i) sum += s.mass[i] * s.velocity[i];
        return sum;
    };
    for (int k = 0; k < 5; ++k) {
        sim.compute_forces();
        sim.advance(1e-4);
    }
    sim.compute_forces();
    double impulse = 0, total = 0;  // what goes into the sums
    for (std::size_t i = 0; i < sim.size(); ++i) {
        impulse += 1e-4 * sim.sphere(i).resultant().norm();
        total += sim.spheres().mass[i] * sim.spheres().velocity[i].norm();
    }
    std::vector<double> stiffness(sim.size()), friction(sim.size(), 0.3);
    for (std::size_t i = 0; i < sim.size(); ++i)
        stiffness[i] = test_stiffness * static_cast<double>(1 + i % 7);
    const Vec3 before = momentum();
    sim.change().set_properties(stiffness, friction);
    sim.advance(1e-4);
    EXPECT_GT(impulse, 1e-4 * total) << "too few contacts";
    EXPECT_LT((momentum() - before).norm(), roundoff(10) * (impulse + total));
}

TEST_P(Engines, WhatAPairGetsDoesNotDependOnOthers) {
    // Vectors hold several pairs, and in float one that turns much goes another way than the rest.
    const double step = 1e-4, gap = 1.99 * test_radius;
    const auto balls = [&](double speed, double spin, double at) {
        return std::array{Ball{.x = Vec3(at, 0, 0), .w = Vec3(spin, -0.3 * spin, 0.5 * spin)},
                          Ball{.x = Vec3(at, gap, 0), .v = Vec3(speed, 0, -0.4 * speed)}};
    };
    const auto shear = [&](const std::vector<Ball>& all) {
        Simulation sim(scene_of(all, 0.4), table());
        for (int k = 0; k < 3; ++k) {
            sim.compute_forces();
            sim.advance(step);
        }
        sim.compute_forces();
        const std::vector<TouchingContact> touching = sim.contacts().touching();
        EXPECT_EQ(touching.size(), all.size() / 2);
        return touching.empty() ? Vec3::Zero().eval() : touching[0].shear;
    };
    std::vector<Ball> all;
    for (const Ball& ball : balls(0.01, 0.2, 0)) all.push_back(ball);  // 3e-5 rad a step
    const Vec3 alone = shear(all);
    EXPECT_GT(alone.norm(), 0);
    for (int k = 1; k < 20; ++k)  // up to 1e-2 rad
        for (const Ball& ball : balls(2, 100.0 * (k % 3), 4.0 * k * test_radius))
            all.push_back(ball);
    EXPECT_EQ(shear(all), alone);
}

TEST_P(Engines, StepsInOneGoGiveTheSameBits) {
    const auto hash = [&](bool one_go, bool ledger) {
        Simulation sim(crowd(true), table(), {.ledger = ledger});
        for (int k = 0; k < 60; ++k) {
            const auto steer = [&] { sim.set_wall_velocity(1, Vec3(-1e-3 * k, 0, 0)); };
            if (one_go) {
                sim.step(1e-4, steer);
            } else {
                sim.compute_forces(k % 7 == 0);
                steer();
                sim.advance(1e-4);
            }
        }
        sim.compute_forces();
        return sim.state_hash();
    };
    const std::string usual = hash(false, false);
    EXPECT_EQ(hash(true, false), usual);
    EXPECT_EQ(hash(true, true), usual);
}

TEST_P(Engines, ScaledVelocitiesAreScaled) {
    Simulation sim(crowd(false), table());
    const ParticleStore before = sim.spheres();
    sim.change().scale_velocities(0.5);
    for (std::size_t i = 0; i < sim.size(); i += 97) {
        EXPECT_EQ(sim.spheres().velocity[i], as_kept(0.5 * before.velocity[i]));
        EXPECT_EQ(sim.spheres().spin[i], as_kept(0.5 * before.spin[i]));
        EXPECT_EQ(sim.spheres().position[i], before.position[i]);
    }
}

GRAINFIELD_FOR_ALL_KERNELS(Engines);

TEST(SpatialOrder, IsAPermutationInEvenAndCompactDomains) {
    Vec3Column x;
    x.resize(10000);
    for (std::size_t i = 0; i < x.size(); ++i) x.set(i, random_vec(i));
    const SpatialOrder order = order_in_space(x, 700);
    EXPECT_EQ(std::set<std::int32_t>(order.sphere.begin(), order.sphere.end()).size(), x.size());
    ASSERT_EQ(order.first.size(), 14u + 1u);
    EXPECT_EQ(order.first.front(), 0u);
    EXPECT_EQ(order.first.back(), x.size());
    for (std::size_t d = 0; d + 1 < order.first.size(); ++d) {
        const std::size_t count = order.first[d + 1] - order.first[d];
        EXPECT_NEAR(static_cast<double>(count), 10000.0 / 14, 2.0);
        Vec3 lower = x[order.sphere[order.first[d]]], upper = lower;
        for (std::size_t k = order.first[d]; k < order.first[d + 1]; ++k) {
            lower = lower.cwiseMin(x[order.sphere[k]]);
            upper = upper.cwiseMax(x[order.sphere[k]]);
        }
        // A fourteenth of a cube of side 2; no side more than about two of the others.
        EXPECT_LT((upper - lower).prod(), 1.1 * 8 / 14);
        EXPECT_LT((upper - lower).maxCoeff(), 2.3 * (upper - lower).minCoeff());
    }
    EXPECT_EQ(order_in_space(x, 700).sphere, order.sphere);
}

TEST(SpatialOrder, TakesSpheresInOnePlaceAndNone) {
    Vec3Column same;
    same.resize(5000);
    EXPECT_EQ(order_in_space(same, 700).sphere.size(), 5000u);
    EXPECT_TRUE(order_in_space(Vec3Column{}, 700).sphere.empty());
}

TEST(CandidateList, KeepsHistoryThroughBuildsAndBins) {
    // Six proposals, of records 0 and 1, 1 and 2, ...; those of bin 8 are no candidates.
    const auto proposals = [](const std::array<std::uint8_t, 6>& bin) {
        Proposals p;
        p.resize(bin.size(), 99);
        for (std::size_t k = 0; k < bin.size(); ++k) {
            p.b[k] = static_cast<std::int32_t>(k) + 1;
            p.bin[k] = bin[k];
        }
        return p;
    };
    const std::array<std::int32_t, 6> firsts{0, 1, 2, 3, 4, 5};
    // Component c of the separation of proposal k is k + c/8.
    Aligned<float> separation(kernels::separation_size * kernels::most_lanes);
    for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t c = 0; c < kernels::separation_size; ++c)
            separation[kernels::in_block(k, c, kernels::separation_size)] =
                static_cast<float>(k) + static_cast<float>(c) / 8;
    CandidateList<float> list;
    const auto sources = [&] {
        std::vector<int> found;
        for (std::size_t k = 0; k < list.count(); ++k) {
            found.push_back(list.first(k));
            EXPECT_EQ(list.second(k), list.first(k) + 1);
            for (std::size_t c = 0; c < kernels::separation_size; ++c)
                EXPECT_EQ(list.separation[kernels::in_block(k, c, kernels::separation_size)],
                          static_cast<float>(list.first(k)) + static_cast<float>(c) / 8);
        }
        return found;
    };
    Proposals now = proposals({8, 8, 0, 1, 8, 0});
    list.build(firsts, now, separation, 99, {});
    EXPECT_EQ(sources(), (std::vector<int>{2, 5, 3}));
    EXPECT_EQ(list.a.back(), 99 * kernels::record_stride<float>) << "no padding at the end";
    for (std::size_t k : {1u, 2u}) {  // 5 and 3 touch
        list.set_touching(k);
        list.shear(k, 0) = static_cast<float>(list.first(k));
    }
    std::vector<KeptContact<float>> kept;
    list.keep(now, kept);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_TRUE(kept[0].proposal == 3 && kept[1].proposal == 5);
    EXPECT_TRUE(kept[0].shear[0] == 3.0f && kept[1].shear[0] == 5.0f);
    now = proposals({8, 0, 8, 0, 2, 7});
    list.build(firsts, now, separation, 99, kept);
    // 5 has come apart, and is looked at once more.
    EXPECT_EQ(sources(), (std::vector<int>{1, 3, 5, 4}));
    for (std::size_t k = 0; k < 4; ++k) {
        const bool there = list.first(k) == 3 || list.first(k) == 5;
        EXPECT_EQ(list.touches(k), there) << k;
        EXPECT_EQ(list.shear(k, 0), there ? static_cast<float>(list.first(k)) : 0.0f);
    }
    // Where a proposal is known by its first record, as with walls.
    kept.clear();
    list.keep_by_record(kept);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_EQ(kept[0].proposal, 3);
    EXPECT_EQ(kept[1].proposal, 5);
    // Proposals numbered anew: 3 is 0 now, and 5 is gone.
    kept.pop_back();
    kept[0].proposal = 0;
    now = proposals({0, 0, 8, 8, 8, 0});
    list.build(firsts, now, separation, 99, kept);
    EXPECT_EQ(sources(), (std::vector<int>{0, 1, 5}));
    EXPECT_EQ(list.shear(0, 0), 3.0f);
    EXPECT_TRUE(list.touches(0));
    EXPECT_FALSE(list.touches(1) || list.touches(2));
    Aligned<std::int32_t> scratch;
    EXPECT_EQ(list.view(0.0, scratch).close, 16u);
    EXPECT_EQ(list.view(0.99, scratch).size, 16u);
}

}  // namespace
}  // namespace grainfield::core
