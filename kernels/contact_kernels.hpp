#pragma once
// Loops over ranges of contacts and spheres: what a step computes, as pure functions on raw
// columns. They allocate nothing and know no store; core/ owns the memory and the threads.
//
// A kernel table is the seam for instruction sets and precisions: core asks for one at run time
// and calls through it.

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/instruction_set.hpp"
#include "kernels/vec3.hpp"

namespace grainfield::kernels {

/// Columns of the spheres that the kernels read; all of length `size`.
struct SphereColumns {
    const double *x, *y, *z;         ///< centres [m]
    const double *vx, *vy, *vz;      ///< velocity in the middle of the last step [m/s]
    const double *wx, *wy, *wz;      ///< spin in the middle of the last step [rad/s]
    const double* radius;            ///< [m]
    const double* normal_stiffness;  ///< k_n [Pa]
    const double* friction;          ///< tan(phi) [-]
};

/// Two candidates for a contact, i < j.
struct Pair {
    std::int32_t i, j;
    auto operator<=>(const Pair&) const = default;
};

/// A sphere that is near a plane wall.
struct WallPair {
    std::int32_t wall, sphere;
    auto operator<=>(const WallPair&) const = default;
};

/// A plane wall as the kernels see it.
struct PlaneWall {
    Vec3 point;               ///< on the plane [m]
    Vec3 normal;              ///< unit, towards the spheres [-]
    Vec3 velocity;            ///< during the last step [m/s]
    double friction;          ///< tan(phi) [-]
    double normal_stiffness;  ///< k_n [Pa]
    double stiffness_ratio;   ///< k_s/k_n [-]
};

/// Columns of contacts: shear force and state are carried from step to step, force and moment are
/// results. For a sphere pair they act on i (and, reversed, the force on j); for a wall contact on
/// the sphere.
struct ContactColumns {
    Vec3* shear;              ///< shear force [N]
    std::uint8_t* touching;   ///< 1 where the bodies overlap [-]
    Vec3* force;              ///< whole force on the first body; valid where touching [N]
    Vec3* moment_per_radius;  ///< times a sphere's radius: its moment; both spheres alike [N]
};

struct ContactParameters {
    double stiffness_ratio;    ///< k_s/k_n of the spheres [-]
    double uniform_stiffness;  ///< k_n of all spheres where it is the same [Pa]
    double uniform_friction;   ///< tan(phi) of all spheres where it is the same [-]
    double step;               ///< time since the last force evaluation; 0 at the first [s]
};

/// What a scene has; a kernel is compiled for each combination, and a term that is absent costs
/// nothing.
struct ContactFeatures {
    bool friction;    ///< shear forces, hence moments and rotation
    bool per_sphere;  ///< stiffness or friction differ from sphere to sphere
    bool sums;        ///< ContactSums are wanted in this step
};

/// Sums over contacts.
struct ContactSums {
    double normal_force = 0;    ///< of magnitudes [N]
    double elastic_normal = 0;  ///< energy in the normal springs [J]
    double elastic_shear = 0;   ///< energy in the shear springs [J]
    double friction_work = 0;   ///< dissipated by slip in the last step [J]
    std::int64_t contacts = 0;  ///< touching [-]

    ContactSums& operator+=(const ContactSums& o) {
        normal_force += o.normal_force;
        elastic_normal += o.elastic_normal;
        elastic_shear += o.elastic_shear;
        friction_work += o.friction_work;
        contacts += o.contacts;
        return *this;
    }
};

/// Load of a wall: what its contacts add up to.
struct WallLoad {
    Vec3 force = Vec3::Zero();  ///< on the wall [N]
    double stiffness = 0;       ///< sum of K_n of its contacts [N/m]
    std::int64_t contacts = 0;  ///< touching [-]

    WallLoad& operator+=(const WallLoad& o) {
        force += o.force;
        stiffness += o.stiffness;
        contacts += o.contacts;
        return *this;
    }
};

/// Forces of the candidate pairs begin <= c < end; columns are indexed by c.
using PairKernel = ContactSums (*)(const SphereColumns&, const Pair* pairs, ContactColumns,
                                   const ContactParameters&, std::size_t begin, std::size_t end);

/// Forces of the wall candidates begin <= c < end; adds the loads of the walls to `loads`.
using WallKernel = ContactSums (*)(const SphereColumns&, const PlaneWall* walls,
                                   const WallPair* pairs, ContactColumns, const ContactParameters&,
                                   WallLoad* loads, std::size_t begin, std::size_t end);

struct ReferenceKernels {
    PairKernel (*pairs)(ContactFeatures);
    WallKernel (*walls)(ContactFeatures);
};

template <class T>
struct VectorKernels;  // kernels/vector/

/// One set of kernels; exactly one of the three is there.
struct KernelTable {
    InstructionSet isa;
    const char* precision;  ///< "double", "mixed"
    const ReferenceKernels* reference;
    const VectorKernels<float>* mixed;
    const VectorKernels<double>* full;
};

/// The reference: scalar, double precision, written to be read. The oracle of all others.
const KernelTable& reference_kernels();

}  // namespace grainfield::kernels
