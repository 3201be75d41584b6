// Small-strain moduli of lattices in the triaxial machinery: isotropic compression, then shear at
// constant lateral stress. For simple cubic blocks the closed form holds with the walls; FCC and
// rhombic blocks, whose outer layers lack neighbours, are extrapolated from three sizes.
//
// Every sphere moving with the mean strain, the lattice sum over the contacts of a volume V is
//   C_ijkl = (1/V) sum of l^2 (K_n n_i n_j n_k n_l + K_s (n_j n_l d_ik - n_i n_j n_k n_l))
// (symmetrized in ij and kl), l = 2 R; moduli at constant lateral stress follow by inversion.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/triaxial/lattice_run.hpp"
#include "tests/verification/record.hpp"

namespace grainfield::triaxial {
namespace {

using namespace testing;  // lattices

class LatticeModuli : public kernels::KernelTest {};

const std::string moduli_page = "Lattice moduli (triaxial test)";
constexpr double stress = 2e5;  // compresses by 1e-3 [Pa]

/// Friction that never slips, an axial strain of less than half the compression's.
Config elastic() {
    return lattice_config(14.0, stress, 8e-3, 4e-4);
}

double normal_stiffness() {
    return 0.5 * lattice_radius * elastic().particle.normal_stiffness;
}
double shear_stiffness() {
    return elastic().particle.stiffness_ratio * normal_stiffness();
}

/// Value for an infinite block from blocks of three sizes, through a + b/n + c/n^2. Walls are in
/// series with the lattice: what is extrapolated are compliances.
double extrapolated(const double (&n)[3], const double (&value)[3]) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        // Lagrange's polynomial in 1/n at 0.
        sum += value[i] * n[i] * n[i] / ((n[i] - n[j]) * (n[i] - n[k]));
    }
    return sum;
}

constexpr double squeezed = 5e-3;  // walls' areas and lattice change by the compression, 1e-3
const std::string squeezed_why = "areas and lattice change with the compression before, 1e-3";

TEST_P(LatticeModuli, SimpleCubic) {
    for (int n : {3, 6}) {
        const SmallStrain s = small_strain(simple_cubic(n), elastic(), table());
        // Chains of n spheres with n + 1 contacts, walls as stiff as spheres.
        const double modulus = normal_stiffness() / (2 * lattice_radius) * n / (n + 1);
        verify::record({.scene = moduli_page,
                        .quantity = fmt::format("simple cubic, n = {}: E", n),
                        .closed_form = "K_n/(2 R) n/(n + 1)",
                        .source = "springs in series",
                        .unit = "Pa",
                        .tolerance = squeezed_why},
                       GetParam().name, modulus, s.modulus, squeezed * modulus);
        verify::record({.scene = moduli_page,
                        .quantity = fmt::format("simple cubic, n = {}: nu", n),
                        .closed_form = "sigma_3/E",
                        .source = "no bond couples the axes; side walls get less area to press on",
                        .tolerance = "servos, 0.03 % of the axial strain"},
                       GetParam().name, stress / modulus, 0.5 * s.lateral, 3e-4);
    }
}

/// Blocks of three sizes against the infinite lattice: modulus, and lateral strain of both axes.
void check_extrapolated(const std::string& name, const std::string& kernel, const double (&n)[3],
                        const SmallStrain (&block)[3], const SmallStrain& expected,
                        const std::string& modulus_form, const std::string& lateral_form) {
    double compliance[3], lateral[3];
    for (int i = 0; i < 3; ++i) {
        compliance[i] = 1 / block[i].modulus;
        lateral[i] = block[i].lateral * compliance[i];  // d epsilon/d sigma_y
    }
    const double modulus = 1 / extrapolated(n, compliance);
    const std::string why = "next order of 1/n; compression before, 1e-3";
    verify::record({.scene = moduli_page,
                    .quantity = name + ": E",
                    .closed_form = modulus_form,
                    .source = "affine lattice sum",
                    .unit = "Pa",
                    .tolerance = why},
                   kernel, expected.modulus, modulus, 0.02 * expected.modulus);
    verify::record({.scene = moduli_page,
                    .quantity = name + ": nu_x + nu_z",
                    .closed_form = lateral_form,
                    .source = "affine lattice sum",
                    .tolerance = "0.3 % of a block's lateral strain, by servos, times 9 by the "
                                 "extrapolation"},
                   kernel, expected.lateral, extrapolated(n, lateral) * modulus,
                   0.03 * expected.lateral);
}

TEST_P(LatticeModuli, Fcc) {
    const double kn = normal_stiffness(), ks = shear_stiffness(), r = lattice_radius;
    const double c11 = (kn + ks) / (std::sqrt(2.0) * r), c12 = (kn - ks) / (2 * std::sqrt(2.0) * r);
    const double n[3] = {6, 10, 14};
    SmallStrain block[3];
    for (int i = 0; i < 3; ++i)
        block[i] = small_strain(fcc_cube(static_cast<int>(n[i])), elastic(), table());
    check_extrapolated("FCC, extrapolated from 6, 10, 14 layers", GetParam().name, n, block,
                       {c11 - 2 * c12 * c12 / (c11 + c12), 2 * (kn - ks) / (3 * kn + ks)},
                       "C11 - 2 C12^2/(C11 + C12), C11 = (K_n + K_s)/(sqrt(2) R), C12 = (K_n - "
                       "K_s)/(2 sqrt(2) R)",
                       "2 (K_n - K_s)/(3 K_n + K_s)");
}

TEST_P(LatticeModuli, Rhombic) {
    const double kn = normal_stiffness(), ks = shear_stiffness(), r = lattice_radius;
    const double c11 = (9 * kn + 3 * ks) / (8 * std::sqrt(3.0) * r);
    const double c12 = 3 * (kn - ks) / (8 * std::sqrt(3.0) * r);
    const double n[3] = {6, 10, 14};
    SmallStrain block[3];
    for (int i = 0; i < 3; ++i) {
        const int k = static_cast<int>(n[i]);
        block[i] = small_strain(rhombic(k, 2 * k - 1, 3), elastic(), table());
    }
    check_extrapolated("rhombic, extrapolated from rows of 6, 10, 14", GetParam().name, n, block,
                       {c11 - c12 * c12 / c11, c12 / c11},
                       "C11 - C12^2/C11, C11 = (9 K_n + 3 K_s)/(8 sqrt(3) R), C12 = 3 (K_n - "
                       "K_s)/(8 sqrt(3) R)",
                       "(K_n - K_s)/(3 K_n + K_s) + 0");
}

INSTANTIATE_TEST_SUITE_P(Kernels, LatticeModuli, ::testing::ValuesIn(best_kernels()),
                         [](const auto& test_info) { return test_info.param.name; });

}  // namespace
}  // namespace grainfield::triaxial
