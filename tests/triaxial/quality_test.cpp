// What a result depends on beside the soil, on curves and ledgers written down by hand.

#include "triaxial/realization/quality.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

CurvePoint point_off_by(double strain, double error) {
    CurvePoint p;
    p.axial_strain = strain;
    p.lateral_square_error = error * error;
    return p;
}

TEST(HeldStress, CountsWhereE50AndThePeakComeFrom) {
    const std::vector<CurvePoint> curve{point_off_by(0.001, 0.3), point_off_by(0.002, 0.4),
                                        point_off_by(0.003, 0.0), point_off_by(0.004, 0.0),
                                        point_off_by(0.005, 9.0)};
    CurveResults results;
    results.peak_deviator_stress = 1e5;
    results.axial_strain_at_peak = 0.004;
    results.E50 = 0.5e5 / 0.002;
    const HeldStress held = held_stress(curve, results);
    EXPECT_DOUBLE_EQ(held.to_E50, std::sqrt((0.09 + 0.16) / 2));
    EXPECT_DOUBLE_EQ(held.to_peak, std::sqrt((0.09 + 0.16) / 4));
    EXPECT_EQ(held.worst(), held.to_E50);
    // E50 from before the first point is that point's.
    results.E50 = 0.5e5 / 0.0005;
    EXPECT_DOUBLE_EQ(held_stress(curve, results).to_E50, 0.3);
    // What came after the peak does not matter; a peak that was held worse than E50 does.
    results.axial_strain_at_peak = 0.005;
    EXPECT_EQ(held_stress(curve, results).worst(), held_stress(curve, results).to_peak);
}

/// A ledger with a row a second: 3 J to friction and 1 J to damping in each, 2 J kinetic, 8 J
/// elastic; from the tenth second on the other way round.
std::vector<core::EnergyRow> ledger() {
    std::vector<core::EnergyRow> rows;
    for (int second = 0; second <= 20; ++second) {
        const double early = std::min(second, 10), late = std::max(0, second - 10);
        core::EnergyRow row{.time = static_cast<double>(second), .energy = {}};
        row.energy.friction_work = 3 * early + late;
        row.energy.damping_work = 5 + early + 3 * late;
        row.energy.kinetic = second <= 10 ? 1.5 : 7;
        row.energy.rotational = second <= 10 ? 0.5 : 1;
        row.energy.elastic_normal = second <= 10 ? 6 : 1;
        row.energy.elastic_shear = second <= 10 ? 2 : 1;
        rows.push_back(row);
    }
    return rows;
}

TEST(ShearEnergy, IsThatOfShearUpToThePeak) {
    const auto rows = ledger();
    const auto early = shear_energy(rows, 4, 6);
    ASSERT_TRUE(early.has_value());
    EXPECT_DOUBLE_EQ(early->damping_share, 0.25);
    EXPECT_DOUBLE_EQ(early->kinetic_ratio, 0.25);
    EXPECT_DOUBLE_EQ(shear_energy(rows, 10, 10)->damping_share, 0.75);
    // The row after a peak between two rows closes the interval.
    EXPECT_DOUBLE_EQ(shear_energy(rows, 9, 1.5)->damping_share, 0.5);
}

TEST(ShearEnergy, IsNotKnownWithoutRowsOrDissipation) {
    EXPECT_FALSE(shear_energy({}, 0, 1).has_value());
    EXPECT_FALSE(shear_energy(ledger(), 20, 1).has_value());
    EXPECT_FALSE(shear_energy(ledger(), 30, 1).has_value());
    std::vector<core::EnergyRow> rows(3);
    for (int k = 0; k < 3; ++k) {
        rows[static_cast<std::size_t>(k)].time = k;
        rows[static_cast<std::size_t>(k)].energy.elastic_normal = 1;
    }
    EXPECT_FALSE(shear_energy(rows, 0, 2).has_value());
}

TEST(QuasiStatic, IsJudgedByInertiaAndByDampingWhereThatIsKnown) {
    const ShearEnergy little{.damping_share = 0.05, .kinetic_ratio = 1e-4};
    const ShearEnergy much{.damping_share = 0.5, .kinetic_ratio = 1e-4};
    EXPECT_THAT(not_quasi_static(1e-5, little), IsEmpty());
    EXPECT_THAT(not_quasi_static(1e-5, {}), IsEmpty());
    EXPECT_THAT(not_quasi_static(1e-2, little), HasSubstr("the inertial number is 0.01"));
    EXPECT_THAT(not_quasi_static(1e-2, little), Not(HasSubstr("damping")));
    EXPECT_THAT(not_quasi_static(1e-5, much), HasSubstr("numerical damping took 50 %"));
    EXPECT_THAT(not_quasi_static(1e-5, much), Not(HasSubstr("inertial")));
    EXPECT_THAT(not_quasi_static(1e-2, much), HasSubstr(" and numerical damping"));
}

TEST(QuasiStatic, LimitsAreThoseOfTheMethod) {
    // docs/method.md, section 8: an inertial number of 2e-4, a share of 15 %.
    EXPECT_THAT(not_quasi_static(1.99e-4, ShearEnergy{.damping_share = 0.149}), IsEmpty());
    EXPECT_THAT(not_quasi_static(2.01e-4, {}), Not(IsEmpty()));
    EXPECT_THAT(not_quasi_static(0, ShearEnergy{.damping_share = 0.151}), Not(IsEmpty()));
}

}  // namespace
}  // namespace grainfield::triaxial
