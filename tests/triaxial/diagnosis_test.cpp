// Faults put into a running test: each must end it within 200 steps of the moment it can be known,
// with sphere or wall, step, time and place in the message, and the state told to the monitor.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include "core/base/errors.hpp"
#include "core/drive/box.hpp"
#include "core/kernel_choice.hpp"
#include "packing/isotropic.hpp"
#include "tests/kernels/kernel_tables.hpp"
#include "tests/reliability/record.hpp"
#include "tests/triaxial/small_test.hpp"
#include "triaxial/realization/shear.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;

/// Spoils the simulation at a step; remembers when it ended early.
struct Saboteur : core::Monitor {
    core::Simulation* simulation = nullptr;
    std::int64_t at = 0, spoilt_steps = 1;
    std::function<void(core::Simulation&)> spoil;
    std::int64_t told_at = -1;

    // Asked at every step.
    bool stop_requested() const override {
        const std::int64_t step = simulation->steps();
        if (step >= at && step < at + spoilt_steps) spoil(*simulation);
        return false;
    }
    void ended_early(const core::Simulation& s) override { told_at = s.steps(); }
};

class Diagnosis : public kernels::KernelTest {
  protected:
    Diagnosis() : sample_(testing::dense_sample(400)), config_(testing::small_config(sample_)) {
        config_.triaxial.max_axial_strain = 0.01;
    }
    /// Message of a test that is spoilt at that step; it must end within 200 steps.
    std::string failure(std::int64_t at, const std::function<void(core::Simulation&)>& spoil) {
        core::Simulation simulation(make_scene(sample_, config_), table());
        Saboteur saboteur;
        saboteur.simulation = &simulation;
        saboteur.at = at;
        saboteur.spoil = spoil;
        saboteur.spoilt_steps = spoilt_steps_;
        try {
            run_test(simulation, config_, saboteur);
        } catch (const SimulationError& error) {
            EXPECT_GE(simulation.steps(), at);
            EXPECT_LE(simulation.steps(), at + 200) << error.what();
            EXPECT_EQ(saboteur.told_at, simulation.steps());
            record(simulation.steps() - at, error.what());
            EXPECT_THAT(error.what(), HasSubstr("step "));
            EXPECT_THAT(error.what(), HasSubstr("time "));
            return error.what();
        }
        ADD_FAILURE() << "not noticed";
        return "";
    }
    /// Steps until it was noticed, and the message.
    static void record(std::int64_t steps, const std::string& message) {
        reliability::record(
            "diagnoses",
            {{"kernels", GetParam().name}, {"steps", std::to_string(steps)}, {"message", message}});
    }
    std::int64_t spoilt_steps_ = 1;
    Sample sample_;
    Config config_;
};

void add_velocity(core::Simulation& simulation, std::size_t sphere, const Vec3& velocity) {
    simulation.change().add_velocities(
        [&](std::size_t i, const Vec3&) { return i == sphere ? velocity : Vec3(Vec3::Zero()); });
}

TEST_P(Diagnosis, OfANumberThatIsNone) {
    const std::string what = failure(333, [](core::Simulation& s) {
        add_velocity(s, 123, Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0));
    });
    EXPECT_THAT(what, HasSubstr("not a number"));
    EXPECT_THAT(what, ::testing::ContainsRegex("(at|near) [(].*[)] m"));
}

TEST_P(Diagnosis, OfASphereThatIsLost) {
    const std::string what = failure(70, [](core::Simulation& s) {
        add_velocity(s, 17, Vec3(0, 0.7 * 0.025 / s.last_step(), 0));
    });
    EXPECT_THAT(what, ::testing::AnyOf(HasSubstr("lost"), HasSubstr("overlap"),
                                       HasSubstr("half its radius")));
    EXPECT_THAT(what, HasSubstr("(sphere "));
}

TEST_P(Diagnosis, OfAKineticEnergyThatExplodes) {
    // Energy that keeps coming from nowhere, as in a step that is too long. No sphere moves far in
    // a step: 2 m/s are a hundredth of a radius.
    spoilt_steps_ = 1000;
    for (const std::int64_t at : {60, 700}) {
        const std::string what = failure(at, [](core::Simulation& s) {
            s.change().add_velocities([](std::size_t i, const Vec3&) {
                return Vec3(i % 2 == 0 ? 2.0 : -2.0, i % 3 == 0 ? 2.0 : -1.0, 0);
            });
        });
        EXPECT_THAT(what, HasSubstr("unstable: the kinetic energy is "));
        EXPECT_THAT(what, HasSubstr("fastest sphere "));
    }
}

TEST_P(Diagnosis, OfAServoThatCannotHold) {
    // Shear at another stress than the sample was brought to, with side walls that a density far
    // above that of any soil allows to move at no more than 1e-4 of the axial rate.
    // 20 inertial times come to less strain than 0.1 % in one case, to more in the other.
    for (const auto& [share, inertial_strain] : {std::pair{10.0, 1e-5}, {0.1, 1e-4}}) {
        core::Simulation simulation(make_scene(sample_, config_), table());
        Saboteur saboteur;
        saboteur.simulation = &simulation;
        saboteur.at = -1;
        core::Driver driver(simulation, config_.time, saboteur);
        packing::compress_isotropically(driver, config_.triaxial.confining_stress);
        TriaxialOptions options = config_.triaxial;
        options.confining_stress *= share;
        const double speed =
            1e-4 * options.strain_rate * core::box_dimensions(simulation).minCoeff();
        const double inertial_time = inertial_strain / options.strain_rate;
        const std::int64_t begin = simulation.steps();
        ShearStage shear(driver, options, options.confining_stress / (speed * speed),
                         {.spheres = simulation.size(), .transient_strain = inertial_strain});
        std::string message;
        try {
            shear.run();
            ADD_FAILURE() << "not noticed";
        } catch (const SimulationError& error) {
            message = error.what();
        }
        EXPECT_THAT(message, HasSubstr("the side walls do not hold the confining stress"));
        EXPECT_THAT(message, HasSubstr(share > 1 ? "collapses" : "dilates"));
        EXPECT_EQ(saboteur.told_at, simulation.steps());
        // It counts from 0.1 % of strain on, and is given 20 inertial times and 0.1 % of strain.
        const double patience =
            std::max(std::log((1 - 1e-3) / (1 - 2e-3)) / options.strain_rate, 20 * inertial_time);
        const double end = std::log(1 / (1 - 1e-3)) / options.strain_rate + patience;
        EXPECT_NEAR(shear.time(), end, 0.01 * end);
        const std::int64_t known =
            begin +
            static_cast<std::int64_t>(end / shear.time() * static_cast<double>(shear.steps()));
        record(std::max<std::int64_t>(0, simulation.steps() - known), message);
    }
}

TEST_P(Diagnosis, LeavesASampleThatCollapsesAlone) {
    // Shaken so that its kinetic energy stays at a share of the confining stress times the volume
    // of the box: 0.5 is what a collapse may come to.
    for (const double share : {0.3, 0.7}) {
        core::Simulation simulation(make_scene(sample_, config_), table());
        Saboteur saboteur;
        saboteur.simulation = &simulation;
        saboteur.at = std::numeric_limits<std::int64_t>::max();
        core::Driver driver(simulation, config_.time, saboteur);
        packing::compress_isotropically(driver, config_.triaxial.confining_stress);
        const double energy =
            share * config_.triaxial.confining_stress * core::box_dimensions(simulation).prod();
        saboteur.at = simulation.steps();
        saboteur.spoilt_steps = std::numeric_limits<std::int32_t>::max();
        saboteur.spoil = [&](core::Simulation& s) {
            double present = 0;
            for (std::size_t i = 0; i < s.size(); ++i)
                present += 0.5 * s.spheres().mass[i] * s.spheres().velocity[i].squaredNorm();
            s.change().scale_velocities(std::sqrt(energy / present));
        };
        TriaxialOptions options = config_.triaxial;
        options.strain_rate = 0.02;  // some 500 steps: it is looked at every 200
        options.max_axial_strain = 4e-4;
        ShearStage shear(driver, options, config_.particle.density,
                         {.spheres = simulation.size(), .transient_strain = 1e-5});
        std::string message;
        try {
            shear.run();
        } catch (const SimulationError& error) {
            message = error.what();
        }
        EXPECT_EQ(message.find("unstable: the kinetic energy is ") == 0, share > 0.5) << message;
        EXPECT_EQ(message.empty(), share < 0.5) << message;
    }
}

TEST_P(Diagnosis, OfAStressThatWasNotHeld) {
    // Ten times the inertial number at which the walls just so follow: the curve would look sound.
    config_.triaxial.strain_rate *= 100;
    core::Simulation simulation(make_scene(sample_, config_), table());
    Saboteur saboteur;
    saboteur.simulation = &simulation;
    saboteur.at = -1;
    try {
        run_test(simulation, config_, saboteur);
        ADD_FAILURE() << "not noticed";
    } catch (const SimulationError& error) {
        EXPECT_THAT(error.what(), HasSubstr("was not held"));
        EXPECT_THAT(error.what(), HasSubstr("triaxial.strain_rate"));
        EXPECT_EQ(saboteur.told_at, simulation.steps());
    }
}

TEST_P(Diagnosis, LeavesASoundTestAlone) {
    for (const double rate : {0.01, 1.0}) {
        config_.triaxial.strain_rate = rate;
        config_.triaxial.max_axial_strain = 0.003;
        core::Simulation simulation(make_scene(sample_, config_), table());
        core::Monitor monitor;
        EXPECT_NO_THROW(run_test(simulation, config_, monitor)) << rate;
    }
}

GRAINFIELD_FOR_ALL_KERNELS(Diagnosis);

}  // namespace
}  // namespace grainfield::triaxial
