#pragma once
// The spheres: a structure of arrays with cache-line aligned columns. Mutable state stands apart
// from properties; what a step computes and forgets (forces) does not live here.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/aligned.hpp"
#include "kernels/vec3.hpp"

namespace grainfield::core {

template <class T>
using Column = Aligned<T>;

/// A column of vectors, one array a component.
struct Vec3Column {
    Column<double> x, y, z;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t n, double value = 0.0) {
        x.resize(n, value);
        y.resize(n, value);
        z.resize(n, value);
    }
    Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const Vec3& v) {
        x[i] = v.x();
        y[i] = v.y();
        z[i] = v.z();
    }
    bool operator==(const Vec3Column&) const = default;
};

/// Block (i, j, k) of the flip technique a sphere was made in; -1 where there are no blocks [-].
using BlockIndex = std::array<std::int32_t, 3>;
inline constexpr BlockIndex no_block{-1, -1, -1};

/// [m3]; radius [m].
double sphere_volume(double radius);

struct ParticleStore {
    // State.
    Vec3Column position;  ///< centres [m]
    Vec3Column velocity;  ///< [m/s]
    Vec3Column spin;      ///< angular velocity [rad/s]

    // Properties.
    Column<double> radius;            ///< [m]
    Column<double> mass;              ///< [kg]
    Column<double> normal_stiffness;  ///< k_n, Eq. (4) of Tran et al. [Pa]
    Column<double> friction_angle;    ///< phi, Eq. (6) of Tran et al. [rad]
    Column<BlockIndex> block;         ///< block the sphere belongs to [-]

    std::size_t size() const { return radius.size(); }

    /// Resizes every column; new spheres are at rest at the origin, without block and properties.
    void resize(std::size_t n);
    /// Volume of all spheres [m3].
    double solid_volume() const;
    /// Sets every mass from radius and density [kg/m3].
    void set_density(double density);
};

/// An axis-aligned box.
struct Box {
    Vec3 lower = Vec3::Zero();  ///< [m]
    Vec3 upper = Vec3::Zero();  ///< [m]

    Vec3 size() const { return upper - lower; }
    double volume() const { return size().prod(); }
};

/// Smallest box that holds all spheres, radii included. Empty store: a box of size zero.
Box bounding_box(const ParticleStore& spheres);

}  // namespace grainfield::core
