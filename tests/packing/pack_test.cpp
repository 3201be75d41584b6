// The whole packing: block, mirror images, settling under gravity.
#include "packing/pack.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/errors.hpp"
#include "core/drive/box.hpp"
#include "packing/isotropic.hpp"
#include "tests/packing/small_samples.hpp"
#include "tests/reliability/record.hpp"

namespace grainfield::packing {
namespace {

using testing::narrow_grading;

class Threads {
  public:
    explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
    ~Threads() { omp_set_num_threads(before_); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

  private:
    int before_;
};

TEST(Pack, SettledSampleFollowsItsWeightOnAnyNumberOfThreads) {
    PackingOptions options = testing::small_options();
    options.blocks = {2, 4, 2};
    core::Monitor monitor;
    const Packing p = pack(options, narrow_grading(), {}, {}, monitor);
    ASSERT_EQ(p.spheres.size(), p.block.spheres.size() * 16);
    // Under four times the weight a block as loose as this one (0.51) gives way a little: 0.004 to
    // 0.008 over versions of the block; twice that.
    EXPECT_NEAR(p.porosity, p.block.porosity, 0.016);
    EXPECT_EQ(p.box.lower, Vec3::Zero());
    EXPECT_NEAR(p.box.upper.x(), 0.4, 1e-15);
    EXPECT_NEAR(p.box.upper.z(), 0.4, 1e-15);
    EXPECT_NEAR(p.box.upper.y(), 0.8, 0.033 * 0.8);  // what that porosity is in height
    EXPECT_EQ(p.isotropic_stress, 0);

    // Four blocks of four spheres' height: layers are thin against the grains, the 2 % of the full
    // sample and 0.99 are those of the full sample.
    EXPECT_NEAR(p.profile.slope_ratio, 1, 0.05);
    EXPECT_GT(p.profile.r2, 0.99);
    // A sample without friction, one block of 65 spheres: over ten seeds and instruction sets K0 is
    // 0.83 with a standard deviation of 0.13, so one sample may well be above 1. Four deviations.
    EXPECT_NEAR(p.profile.K0, 0.83, 4 * 0.13);
    const double solid = p.spheres.solid_volume();
    EXPECT_NEAR(p.profile.unit_weight, 2600 * 9.81 * solid / p.box.volume(),
                1e-9 * p.profile.unit_weight);
    for (std::size_t i = 0; i < p.spheres.size(); ++i)
        ASSERT_EQ(p.spheres.velocity[i], Vec3::Zero()) << i;

    // Sphere n of every block is sphere n of the first.
    const std::size_t block = p.block.spheres.size();
    for (std::size_t i = 0; i < p.spheres.size(); ++i)
        ASSERT_EQ(p.spheres.radius[i], p.block.spheres.radius[i % block]) << i;

    const Threads three(3);
    const Packing again = pack(options, narrow_grading(), {}, {}, monitor);
    EXPECT_EQ(again.state_hash, p.state_hash);
    EXPECT_EQ(again.spheres.position, p.spheres.position);
}

TEST(Pack, IsotropicStressReplacesGravity) {
    PackingOptions options = testing::small_options();
    options.blocks = {1, 2, 1};
    options.isotropic_stress = 50e3;
    const Material material;
    core::Monitor monitor;
    const Packing p = pack(options, narrow_grading(), material, {}, monitor);
    EXPECT_EQ(p.isotropic_stress, 50e3);
    core::Simulation simulation(testing::box_scene(p.spheres, p.box, material),
                                kernels::reference_kernels());
    simulation.compute_forces(true);
    // Normal forces follow from the positions, so the walls' loads are those of the packing.
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(core::axis_stress(simulation, axis), 50e3, 3e-3 * 50e3) << axis;
    EXPECT_NEAR(p.porosity, 1 - p.spheres.solid_volume() / p.box.volume(), 1e-12);
}

struct Stopper : core::Monitor {
    std::int64_t left = 0;
    mutable std::int64_t asked = 0;
    bool stop_requested() const override { return ++asked > left; }
};

TEST(Pack, InterruptedAnywhereAndResumedIsTheSame) {
    namespace fs = std::filesystem;
    PackingOptions options = testing::small_options();
    options.blocks = {2, 2, 2};
    options.isotropic_stress = 20e3;
    const fs::path file =
        fs::temp_directory_path() / ("grainfield_pack_" + std::to_string(::getpid()) + ".bin");
    const auto run = [&](bool resume, std::int64_t left, std::int64_t* asked = nullptr) {
        core::Checkpoint checkpoint(file, {}, 0);
        if (resume) checkpoint.resume(*core::find_checkpoint(file));
        Stopper monitor;
        monitor.left = left;
        std::optional<Packing> packing;
        try {
            packing = pack(options, narrow_grading(), {}, {}, monitor, {}, &checkpoint);
        } catch (const Interrupted&) {
        }
        if (asked != nullptr) *asked = monitor.asked;
        return packing;
    };
    std::int64_t all = 0;
    const auto undisturbed = run(false, 1 << 30, &all);
    ASSERT_TRUE(undisturbed);
    // Of the block's steps, those of settling and those of compression, which come last.
    const std::int64_t sample_steps = undisturbed->steps;
    ASSERT_GT(all, sample_steps);
    const std::int64_t block = all - sample_steps;
    for (const std::int64_t stop :
         {block / 2, block, block + 1, block + sample_steps / 3, all - 200, all - 1}) {
        ASSERT_FALSE(run(false, stop)) << stop;
        const auto resumed = run(true, 1 << 30);
        ASSERT_TRUE(resumed) << stop;
        EXPECT_EQ(resumed->state_hash, undisturbed->state_hash) << stop;
        EXPECT_EQ(resumed->steps, undisturbed->steps) << stop;
        EXPECT_EQ(resumed->box.upper, undisturbed->box.upper) << stop;
        EXPECT_EQ(resumed->profile.K0, undisturbed->profile.K0) << stop;
        EXPECT_EQ(resumed->profile.depth, undisturbed->profile.depth) << stop;
        EXPECT_EQ(resumed->fabric.tensor, undisturbed->fabric.tensor) << stop;
        EXPECT_EQ(resumed->block.spheres.position, undisturbed->block.spheres.position) << stop;
        EXPECT_EQ(resumed->block.grading.scale, undisturbed->block.grading.scale) << stop;
        EXPECT_EQ(resumed->isotropic_stress, 20e3) << stop;
        reliability::record(
            "restarts",
            {{"of", stop <= block ? "pack, the block" : "pack, settling and compression"},
             {"kernels", "auto"},
             {"step", std::to_string(stop)},
             {"steps", std::to_string(all)},
             {"threads", std::to_string(omp_get_max_threads())},
             {"threads_after", std::to_string(omp_get_max_threads())},
             {"same", reliability::same(resumed->state_hash, undisturbed->state_hash)}});
    }
    fs::remove(file);
    fs::remove(core::file_before(file));
}

}  // namespace
}  // namespace grainfield::packing
