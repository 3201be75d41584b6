// Lattices sheared to failure between smooth walls: FCC against Rowe (1962) and Thornton (1979),
// rhombic against the same stress dilatancy for rods.
//
// At failure all inclined bonds slide and the horizontal ones are open. An inclined bond, at the
// angle b to the horizontal, carries its force at b + phi. Virtual work: rows 2 R sin(b) apart with
// a spacing of 4 R cos(b) (rhombic, b = 60 deg) do sigma_1 4 R cos(b) d(2 R sin(b)) against
// sigma_3 2 R sin(b) d(4 R cos(b)); each bond's work is nothing but that of its friction, so that
// sigma_1/sigma_3 = tan(b) tan(b + phi). FCC compressed along a cube axis (b = 45 deg) spreads to
// both sides and has 2 tan(b + phi). The same follows from adding up the bonds across horizontal
// and vertical planes; at the walls of a block some bonds are missing and the box is larger than
// the lattice, which gives the factors below exactly.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/triaxial/lattice_run.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::triaxial {
namespace {

using namespace testing;  // lattices
using kernels::KernelTest;

constexpr double pi = 3.14159265358979323846;

/// Slow, for no inertia in the peak; K_n/(sigma R) = k_n/(2 sigma) = 45000, the rigid limit.
Config failing(double friction) {
    return lattice_config(friction, 10e3, 0.0025, 0.001);
}

/// 2 tan(45 deg + phi): 2 (1 + f)/(1 - f).
double fcc(double f) {
    return 2 * (1 + f) / (1 - f);
}

/// Square layers: 4 (n - 1)^2 bonds between two layers carry sigma_1 over (2 n R)^2; each gap
/// between layers brings 2 (n - 1) of them to a side wall over 2 n R times the height.
double fcc_block(double f, int n, int layers) {
    return fcc(f) * (n - 1) / n * (1 + std::sqrt(2.0) / (layers - 1));
}

/// tan(60 deg) tan(60 deg + phi).
double rhombic_lattice(double f) {
    return std::sqrt(3.0) * std::tan(pi / 3 + std::atan(f));
}

/// Two rows have 2 (n - 1) bonds between them, over 2 n R; one of them meets each side.
double rhombic_block(double f, int n, int rows) {
    return rhombic_lattice(f) * (n - 1) / n * (1 + 2 / (std::sqrt(3.0) * (rows - 1)));
}

const std::string failure_page = "Lattices at failure (triaxial test)";

using LatticeFailure = KernelTest;
class FccCube : public KernelTest {};

// In the smallest blocks the deformation is uniform up to the peak. What is left is the elastic
// strain up to there, 2e-4 to 6e-4, times up to 5 by the turn of the bonds, and that a point of the
// curve is the mean over 5e-5 of strain.
constexpr double uniform = 0.005;
const std::string uniform_why = "elastic strain up to the peak (5e-4) turns the bonds";

TEST_P(LatticeFailure, SmallFccBlockMeetsRoweAndThornton) {
    for (double f : {0.1, 0.2, 0.3, 0.4, 0.5}) {
        const double expected = fcc_block(f, 3, 5);
        verify::record({.scene = failure_page,
                        .quantity = fmt::format("FCC, f = {}: s1/s3", f),
                        .closed_form = "2 (1 + f)/(1 - f), times (2/3)(1 + sqrt(2)/4): the walls",
                        .source = "Rowe 1962, Thornton 1979",
                        .tolerance = uniform_why},
                       GetParam().name, expected,
                       stress_ratio_at_failure(fcc_square_layers(3, 5), failing(f), table()),
                       uniform * expected);
    }
}

// At f = 0.4 the bonds are 8 degrees from locking, where a turn changes tan(b + phi) by a factor of
// 7 and what they had at f = 0.3 (5 in all) doubles.
TEST_P(LatticeFailure, SmallRhombicBlockMeetsRowe) {
    for (double f : {0.1, 0.2, 0.3, 0.4}) {
        const double expected = rhombic_block(f, 3, 5);
        verify::record({.scene = failure_page,
                        .quantity = fmt::format("rhombic, f = {}: s1/s3", f),
                        .closed_form = "tan(60 deg) tan(60 deg + phi), times (2/3)(1 + 1/(2 "
                                       "sqrt(3))): the walls",
                        .source = "Rowe 1962, by virtual work",
                        .tolerance = f < 0.4 ? uniform_why : uniform_why + ", close to locking"},
                       GetParam().name, expected,
                       stress_ratio_at_failure(rhombic(3, 5, 3), failing(f), table()),
                       (f < 0.4 ? 1 : 2) * uniform * expected);
    }
}

// Friction is no associated flow rule: the uniform state is one way to fail. In larger blocks
// spheres begin to roll on each other before the last bonds slide (spins of some 5 times the strain
// rate, where the uniform state has none), and the peak stays below it, never above.
TEST_P(LatticeFailure, LargerBlocksRollBeforeTheLastBondsSlide) {
    for (double f : {0.2, 0.3}) {
        const double expected = fcc_block(f, 5, 7);
        verify::record({.scene = failure_page,
                        .quantity = fmt::format("FCC 5 x 7 x 5, f = {}: s1/s3", f),
                        .closed_form = "2 (1 + f)/(1 - f), times (4/5)(1 + sqrt(2)/6): the walls",
                        .source = "Rowe 1962, Thornton 1979",
                        .tolerance = "rolling, which the closed form excludes"},
                       GetParam().name, expected,
                       stress_ratio_at_failure(fcc_square_layers(5, 7), failing(f), table()),
                       0.01 * expected);
    }
}

// With its cube axes along the walls every other sheet has a sphere in its corners that holds on to
// one bond alone: nothing balances the moment of that bond's friction, the sphere rolls, and takes
// the friction of the diagonal row behind it. One row in n: the strength is lower by a share that
// falls as 1/n.
TEST_P(FccCube, NearsRoweAndThorntonAsOneOverItsSize) {
    for (double f : {0.3, 0.5}) {
        double last = 0, product[2] = {};
        for (int n : {7, 15}) {
            const double ratio = stress_ratio_at_failure(fcc_cube(n), failing(f), table());
            verify::record({.scene = failure_page,
                            .quantity = fmt::format("FCC cube of {} layers, f = {}: s1/s3", n, f),
                            .closed_form = "2 (1 + f)/(1 - f)",
                            .source = "Rowe 1962, Thornton 1979",
                            .tolerance = "1/n: spheres roll in the corners"},
                           GetParam().name, fcc(f), ratio, fcc(f) / n);
            EXPECT_GT(ratio, last);
            last = ratio;
            product[n == 15] = n * ratio;
        }
        verify::record(
            {.scene = failure_page,
             .quantity = fmt::format("FCC cube, 7 and 15 layers extrapolated, f = {}: s1/s3", f),
             .closed_form = "2 (1 + f)/(1 - f)",
             .source = "Rowe 1962, Thornton 1979",
             .tolerance = "next order of 1/n"},
            GetParam().name, fcc(f), (product[1] - product[0]) / 8, 0.02 * fcc(f));
    }
}

GRAINFIELD_FOR_ALL_KERNELS(LatticeFailure);
INSTANTIATE_TEST_SUITE_P(Kernels, FccCube, ::testing::ValuesIn(best_kernels()),
                         [](const auto& test_info) { return test_info.param.name; });

}  // namespace
}  // namespace grainfield::triaxial
