// The energy ledger of a whole triaxial test.

#include <gtest/gtest.h>

#include "tests/kernels/kernel_tables.hpp"
#include "tests/triaxial/small_test.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::triaxial {
namespace {

using TriaxialLedger = kernels::KernelTest;

const Sample& sample() {
    static const Sample made = testing::dense_sample(900);
    return made;
}

testing::FinishedTest sheared(const kernels::KernelTable& table, double safety, bool ledger,
                              double strain) {
    Config config = testing::small_config(sample());
    config.time.safety = safety;
    config.triaxial.max_axial_strain = strain;
    return testing::run(sample(), config, table, {.ledger = ledger});
}

TEST_P(TriaxialLedger, ClosesAndBetterWithTheStep) {
    const TestResult coarse = sheared(table(), 0.8, true, 0.02).result;
    const TestResult fine = sheared(table(), 0.4, true, 0.02).result;
    const core::Energy& end = coarse.energies.back().energy;
    // Everything took part, and nothing but moving walls put energy in: no gravity.
    EXPECT_GT(end.friction_work, 0.1 * end.external_work);
    EXPECT_GT(end.damping_work, 0.05 * end.external_work);
    EXPECT_GT(end.elastic_normal, 0.05 * end.external_work);
    EXPECT_GT(end.elastic_shear, 0.01 * end.external_work);
    EXPECT_EQ(end.gravity, 0);
    // What is missing is lost where contacts form and open within a step: of second order.
    const auto recorded = [&](const char* quantity, const TestResult& r, double tolerance) {
        verify::record({.scene = "Energy ledger of a triaxial test, 900 spheres",
                        .quantity = quantity,
                        .closed_form = "sum of energies and works is constant",
                        .source = "conservation of energy",
                        .unit = "",
                        .tolerance = "contacts that form or open within a step: second order",
                        .scale = 1},
                       GetParam().name, 0, r.energy_closing_error, tolerance);
    };
    recorded("largest change over the work put in, default step", coarse, is_mixed() ? 5e-3 : 1e-3);
    recorded("largest change over the work put in, half the step", fine,
             0.4 * coarse.energy_closing_error);
}

TEST_P(TriaxialLedger, ChangesNothing) {
    const testing::FinishedTest with = sheared(table(), 0.8, true, 0.002);
    const testing::FinishedTest without = sheared(table(), 0.8, false, 0.002);
    EXPECT_EQ(with.simulation.state_hash(), without.simulation.state_hash());
    EXPECT_EQ(with.result.shear_steps, without.result.shear_steps);
    EXPECT_TRUE(without.result.energies.empty());
}

GRAINFIELD_FOR_ALL_KERNELS(TriaxialLedger);

}  // namespace
}  // namespace grainfield::triaxial
