#pragma once
// Lattices of equal spheres, just touching, in the box that just holds them: samples for the
// triaxial machinery whose stiffness and strength have closed forms. The major stress acts along y.

#include <cmath>
#include <vector>

#include "tests/packing/small_samples.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial::testing {

inline constexpr double lattice_radius = 0.025;  // [m]

inline Sample sample_of_places(const std::vector<Vec3>& places, const Vec3& size) {
    Sample sample;
    sample.spheres =
        packing::testing::spheres_of(std::vector<double>(places.size(), lattice_radius), {});
    for (std::size_t i = 0; i < places.size(); ++i) sample.spheres.position.set(i, places[i]);
    sample.box.upper = size;
    return sample;
}

/// n^3 spheres.
inline Sample simple_cubic(int n) {
    const double r = lattice_radius;
    std::vector<Vec3> places;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) places.push_back(r * Vec3(2 * i + 1, 2 * j + 1, 2 * k + 1));
    return sample_of_places(places, Vec3::Constant(2 * r * n));
}

/// FCC with its cube axes along x, y and z, `layers` layers a side.
inline Sample fcc_cube(int layers) {
    const double r = lattice_radius, spacing = std::sqrt(2.0) * r;
    std::vector<Vec3> places;
    for (int i = 0; i < layers; ++i)
        for (int j = 0; j < layers; ++j)
            for (int k = 0; k < layers; ++k)
                if ((i + j + k) % 2 == 0)
                    places.push_back(Vec3::Constant(r) + spacing * Vec3(i, j, k));
    return sample_of_places(places, Vec3::Constant(2 * r + (layers - 1) * spacing));
}

/// FCC turned by 45 degrees about y: square layers with rows along x and z, `layers` of them (odd),
/// n x n spheres and (n - 1) x (n - 1) in their hollows by turns, the smaller ones first and last.
/// Every sphere has its bonds in pairs whose moments balance, at walls, edges and corners too.
inline Sample fcc_square_layers(int n, int layers) {
    const double r = lattice_radius, rise = std::sqrt(2.0) * r;
    std::vector<Vec3> places;
    for (int l = 0; l < layers; ++l) {
        const int wide = l % 2, count = n - 1 + wide;
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < count; ++k)
                places.emplace_back(r * (2 * i + 2 - wide), r + rise * l, r * (2 * k + 2 - wide));
    }
    return sample_of_places(places, Vec3(2 * r * n, 2 * r + rise * (layers - 1), 2 * r * n));
}

/// Rhombic (simple hexagonal): `depth` hexagonal sheets in x-y one behind the other, touching along
/// z; horizontal rows of n and n - 1 spheres by turns, `rows` of them (odd), the shorter ones first
/// and last. Here too every sphere's bonds come in balanced pairs.
inline Sample rhombic(int n, int rows, int depth) {
    const double r = lattice_radius, rise = std::sqrt(3.0) * r;
    std::vector<Vec3> places;
    for (int j = 0; j < rows; ++j) {
        const int wide = j % 2, count = n - 1 + wide;
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < depth; ++k)
                places.emplace_back(r * (2 * i + 2 - wide), r + rise * j, r * (2 * k + 1));
    }
    return sample_of_places(places, Vec3(2 * r * n, 2 * r + rise * (rows - 1), 2 * r * depth));
}

}  // namespace grainfield::triaxial::testing
