// Whatever a valid config asks for, a test ends with finite results, its ledger closed and its
// spheres inside, or says why it cannot (SimulationError, exit code 3).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/base/errors.hpp"
#include "core/kernel_choice.hpp"
#include "tests/kernels/kernel_tables.hpp"
#include "tests/larger.hpp"
#include "tests/triaxial/small_test.hpp"

namespace grainfield::triaxial {
namespace {

/// A case drawn from a seed.
struct RandomCase {
    explicit RandomCase(unsigned seed) : random(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }

    /// 30 to 250 spheres, the largest up to eight times the smallest, strewn into a box; stiffness
    /// and friction from sphere to sphere.
    Sample sample() {
        const int n = static_cast<int>(uniform(30, 250));
        const double contrast = log_uniform(1.01, 8), smallest = log_uniform(2e-3, 0.05);
        std::vector<double> radii;
        double volume = 0;
        for (int i = 0; i < n; ++i) {
            // By mass: few large ones.
            const double u = uniform(0, 1);
            radii.push_back(smallest *
                            std::pow(1 - u * (1 - std::pow(contrast, -3.0)), -1.0 / 3.0));
            volume += packing::testing::sphere_volume(2 * radii.back());
        }
        std::sort(radii.begin(), radii.end());
        Sample made{packing::testing::spheres_of(radii, {}), {}};
        const double width = std::max(std::cbrt(volume / 0.45), 4.5 * radii.back());
        const double height = packing::place_at_random(made.spheres, width, width, width, 3);
        made.box = {Vec3::Zero(), Vec3(width, height, width)};
        const double stiffness = log_uniform(1e7, 1e9), stiffness_contrast = log_uniform(1, 1e4);
        const double friction = uniform(0, 1.5), share = uniform(0, 1);
        for (int i = 0; i < n; ++i) {
            const auto k = static_cast<std::size_t>(i);
            made.spheres.normal_stiffness[k] =
                stiffness * std::pow(stiffness_contrast, uniform(0, 1));
            made.spheres.friction_angle[k] = uniform(0, 1) < share ? friction : uniform(0, 1.5);
        }
        return made;
    }

    Config config() {
        Config c;
        c.particle.stiffness_ratio = uniform(0, 1) < 0.2 ? 0 : uniform(0, 1);
        c.particle.normal_stiffness = log_uniform(1e7, 1e10);  // of the walls
        c.wall.friction_angle = uniform(0, 1) < 0.5 ? 0 : uniform(0, 1.5);
        c.damping = {uniform(0, 0.7), uniform(0, 0.7)};
        c.triaxial.confining_stress = log_uniform(1e3, 1e6);
        c.triaxial.strain_rate = log_uniform(1e-3, 10);
        c.triaxial.max_axial_strain = std::min(0.05, 0.2 * c.triaxial.strain_rate + 1e-4);
        c.triaxial.gravity = uniform(0, 1) < 0.3 ? 9.81 : 0;
        c.time.safety = uniform(0.2, 0.95);
        c.time.mass_scaling = uniform(0, 1) < 0.3 ? uniform(1, 3) : 1;
        return c;
    }

    std::mt19937 random;
};

class RandomConfigs : public kernels::KernelTest {};

TEST_P(RandomConfigs, EndWithFiniteResultsOrSayWhyNot) {
    int finished = 0, refused = 0;
    double worst_closing = 0;
    std::string reasons;
    // Other cases for every kernel.
    const auto first = static_cast<unsigned>(std::hash<std::string>()(GetParam().name) % 100000);
    for (unsigned seed = first; seed < first + 12; ++seed) {
        SCOPED_TRACE(seed);
        RandomCase one(seed);
        const Sample sample = one.sample();
        const Config config = one.config();
        core::Simulation simulation(make_scene(sample, config), table(),
                                    {.skin = 0, .ledger = true});
        struct : core::Monitor {
            bool told = false;
            void ended_early(const core::Simulation&) override { told = true; }
        } monitor;
        TestResult r;
        try {
            r = run_test(simulation, config, monitor);
        } catch (const SimulationError& error) {
            EXPECT_TRUE(monitor.told) << error.what();
            EXPECT_STRNE(error.what(), "");
            reasons += fmt::format("  {}: {}\n", seed, error.what());
            ++refused;
            continue;
        }
        ++finished;
        for (const double value :
             {r.results.peak_deviator_stress, r.results.E50, r.results.friction_angle, r.porosity,
              r.sheared_porosity, r.mean_step, r.lateral_rms_error, r.energy_closing_error})
            EXPECT_TRUE(std::isfinite(value))
                << value << "; peak " << r.results.peak_deviator_stress << " Pa, E50 "
                << r.results.E50 << " Pa, angle " << r.results.friction_angle;
        for (const CurvePoint& p : r.curve)
            EXPECT_TRUE(std::isfinite(p.deviator_stress) && std::isfinite(p.volumetric_strain));
        worst_closing = larger(worst_closing, r.energy_closing_error);
        // Second order in the step: 0.05 % at Tran et al.'s case, more where single contacts carry
        // all of the work.
        EXPECT_LT(r.energy_closing_error, 0.05);
        const core::ParticleStore& s = simulation.spheres();
        for (std::size_t i = 0; i < s.size(); ++i)
            for (const core::Wall& wall : simulation.walls())
                EXPECT_GT(wall.normal.dot(s.position[i] - wall.point), 0.5 * s.radius[i]) << i;
    }
    std::printf("%d finished, %d refused; ledgers close to %.2g at worst\n%s", finished, refused,
                worst_closing, reasons.c_str());
    RecordProperty("finished", finished);
    RecordProperty("refused", refused);
    EXPECT_GE(finished, 3);  // the draws are not all impossible: half of them finish
}

GRAINFIELD_FOR_ALL_KERNELS(RandomConfigs);

}  // namespace
}  // namespace grainfield::triaxial
