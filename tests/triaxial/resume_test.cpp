// A test that is interrupted at any step and resumed ends as if nothing had happened.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "core/base/errors.hpp"
#include "core/kernel_choice.hpp"
#include "tests/kernels/kernel_tables.hpp"
#include "tests/reliability/record.hpp"
#include "tests/triaxial/small_test.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

/// Asks to stop after so many safe points.
struct Stopper : core::Monitor {
    std::int64_t left = 0;
    mutable std::int64_t asked = 0;
    bool stop_requested() const override { return ++asked > left; }
};

class Resume : public kernels::KernelTest {
  protected:
    ~Resume() override {
        fs::remove(file_);
        fs::remove(core::file_before(file_));
        omp_set_num_threads(threads_);
    }
    /// Runs until it is done or `stop_after` steps were taken; nothing where it was interrupted.
    std::optional<testing::FinishedTest> run(const Sample& sample, const Config& config,
                                             bool resume, std::int64_t stop_after) {
        core::Checkpoint checkpoint(file_, {}, every_);
        if (resume) checkpoint.resume(*core::find_checkpoint(file_));
        core::Simulation simulation(resume ? core::Scene{} : make_scene(sample, config), table(),
                                    {.skin = 0, .ledger = true});
        Stopper monitor;
        monitor.left = stop_after;
        try {
            TestResult result = run_test(simulation, config, monitor, &checkpoint);
            steps_ = monitor.asked;
            return testing::FinishedTest{std::move(result), std::move(simulation)};
        } catch (const Interrupted&) {
            return std::nullopt;
        }
    }
    fs::path file_ = fs::temp_directory_path() / fmt::format("grainfield_{}.bin", ::getpid());
    int threads_ = omp_get_max_threads();
    double every_ = 0;
    std::int64_t steps_ = 0;
};

void expect_same(const testing::FinishedTest& a, const testing::FinishedTest& b) {
    EXPECT_EQ(a.simulation.state_hash(), b.simulation.state_hash());
    EXPECT_EQ(a.result.isotropic_steps, b.result.isotropic_steps);
    EXPECT_EQ(a.result.shear_steps, b.result.shear_steps);
    EXPECT_EQ(a.result.porosity, b.result.porosity);
    EXPECT_EQ(a.result.fabric.tensor, b.result.fabric.tensor);
    EXPECT_EQ(a.result.lateral_rms_error, b.result.lateral_rms_error);
    EXPECT_EQ(a.result.energy_closing_error, b.result.energy_closing_error);
    EXPECT_EQ(a.result.inertia_ratio, b.result.inertia_ratio);
    EXPECT_EQ(a.result.results.E50, b.result.results.E50);
    EXPECT_EQ(a.result.energies.size(), b.result.energies.size());
    ASSERT_EQ(a.result.curve.size(), b.result.curve.size());
    for (std::size_t k = 0; k < a.result.curve.size(); ++k) {
        EXPECT_EQ(a.result.curve[k].deviator_stress, b.result.curve[k].deviator_stress);
        EXPECT_EQ(a.result.curve[k].time, b.result.curve[k].time);
    }
}

TEST_P(Resume, AtRandomStepsEndsWithTheSameBits) {
    // Two domains of the vector engine.
    static const Sample sample = testing::dense_sample(1300);
    Config config = testing::small_config(sample);
    config.triaxial.max_axial_strain = 0.002;
    config.time.mass_scaling = is_mixed() ? 1.5 : 1.0;
    const auto undisturbed = run(sample, config, false, 1 << 30);
    ASSERT_TRUE(undisturbed);
    const std::int64_t steps = steps_;
    ASSERT_GT(undisturbed->result.isotropic_steps, 100);
    ASSERT_GT(undisturbed->result.shear_steps, 100);

    std::mt19937_64 random(std::hash<std::string>()(GetParam().name));
    std::vector<std::int64_t> stops{0, undisturbed->result.isotropic_steps};
    for (int k = 0; k < 3; ++k)
        stops.push_back(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(steps)));
    for (const std::int64_t stop : stops) {
        omp_set_num_threads(1 + static_cast<int>(stop % 2));
        ASSERT_FALSE(run(sample, config, false, stop)) << stop;
        // Once more on the way, with checkpoints every now and then besides.
        omp_set_num_threads(2 - static_cast<int>(stop % 2));
        every_ = stop % 3 == 0 ? 1e-3 : 0;
        ASSERT_FALSE(run(sample, config, true, (steps - stop) / 2)) << stop;
        const auto resumed = run(sample, config, true, 1 << 30);
        every_ = 0;
        ASSERT_TRUE(resumed);
        SCOPED_TRACE(stop);
        expect_same(*resumed, *undisturbed);
        const std::string same = reliability::same(resumed->simulation.state_hash(),
                                                   undisturbed->simulation.state_hash());
        const auto record = [&](std::int64_t at, std::int64_t threads) {
            const bool shear = at >= undisturbed->result.isotropic_steps;
            reliability::record("restarts",
                                {{"of", shear ? "triaxial, shear" : "triaxial, compression"},
                                 {"kernels", GetParam().name},
                                 {"step", std::to_string(at)},
                                 {"steps", std::to_string(steps)},
                                 {"threads", std::to_string(threads)},
                                 {"threads_after", std::to_string(2 - stop % 2)},
                                 {"same", same}});
        };
        record(stop, 1 + stop % 2);
        record(stop + (steps - stop) / 2, 2 - stop % 2);
    }
}

TEST_P(Resume, AfterAKillGoesOnFromTheLastCheckpoint) {
    const Sample sample = testing::dense_sample(300);
    Config config = testing::small_config(sample);
    config.triaxial.max_axial_strain = 0.001;
    const auto undisturbed = run(sample, config, false, 1 << 30);
    const std::int64_t steps = steps_;
    every_ = 1e-9;  // at every sixteenth step
    ASSERT_FALSE(run(sample, config, false, steps_ / 2));
    fs::remove(file_);  // as if the save on the interruption had never been
    every_ = 0;
    const auto resumed = run(sample, config, true, 1 << 30);
    ASSERT_TRUE(resumed);
    const std::int64_t begin = steps - steps_;
    EXPECT_LT(steps_, undisturbed->result.isotropic_steps + undisturbed->result.shear_steps);
    expect_same(*resumed, *undisturbed);
    reliability::record("restarts",
                        {{"of", "triaxial, the last checkpoint after a kill"},
                         {"kernels", GetParam().name},
                         {"step", std::to_string(begin)},
                         {"steps", std::to_string(steps)},
                         {"threads", std::to_string(threads_)},
                         {"threads_after", std::to_string(threads_)},
                         {"same", reliability::same(resumed->simulation.state_hash(),
                                                    undisturbed->simulation.state_hash())}});
}

GRAINFIELD_FOR_ALL_KERNELS(Resume);

}  // namespace
}  // namespace grainfield::triaxial
