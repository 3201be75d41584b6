// The state at the end of a test is the same, bit for bit, for any number of threads.

#include <gtest/gtest.h>
#include <omp.h>

#include <string>
#include <vector>

#include "packing/flip.hpp"
#include "tests/triaxial/small_test.hpp"

namespace grainfield::triaxial {
namespace {

TEST(Threads, DoNotChangeTheFinalState) {
    // Mirror images of a small sample: more spheres than core::for_chunks() leaves to one thread.
    Sample sample = testing::dense_sample(600);
    for (std::size_t i = 0; i < sample.spheres.size(); ++i)
        sample.spheres.position.set(i, sample.spheres.position[i] - sample.box.lower);
    const Vec3 size = sample.box.size();
    sample.spheres = packing::flip(sample.spheres, sample.spheres, size, {2, 2, 2});
    sample.box = {Vec3::Zero(), 2 * size};
    Config config = testing::small_config(sample);
    config.triaxial.max_axial_strain = 0.0005;
    const int before = omp_get_max_threads();
    std::string hash;
    std::vector<CurvePoint> curve;
    for (const int threads : {1, 2, 3, 4}) {
        omp_set_num_threads(threads);
        const testing::FinishedTest run = testing::run(sample, config);
        if (threads == 1) hash = run.simulation.state_hash();
        EXPECT_EQ(run.simulation.state_hash(), hash) << threads;
        if (threads == 1) curve = run.result.curve;
        ASSERT_EQ(run.result.curve.size(), curve.size());
        for (std::size_t k = 0; k < curve.size(); ++k)
            EXPECT_EQ(run.result.curve[k].deviator_stress, curve[k].deviator_stress);
    }
    omp_set_num_threads(before);
    EXPECT_EQ(hash.size(), 16U);
}

}  // namespace
}  // namespace grainfield::triaxial
