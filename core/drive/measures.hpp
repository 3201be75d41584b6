#pragma once
// What a packing is like inside: stress, coordination, fabric. Forces must be current.

#include "core/simulation.hpp"

namespace grainfield::core {

/// Coordination and fabric of the touching contacts, walls included.
struct Fabric {
    double coordination_number = 0;  ///< Z: contacts a sphere [-]
    /// (2C - N1)/(N - N0 - N1) after Thornton (2000): C contacts, N0 and N1 spheres with none and
    /// with one. A contact with a wall counts as half a C: it has one sphere [-]
    double mechanical_coordination_number = 0;
    double rattler_fraction = 0;         ///< (N0 + N1)/N: spheres that carry nothing [-]
    double rattler_volume_fraction = 0;  ///< the same by volume [-]
    /// Fabric tensor <n n>; its trace is 1 [-]
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    /// Largest minus smallest eigenvalue of the fabric tensor; 0 is isotropic [-]
    double anisotropy = 0;
};
Fabric measure_fabric(const Simulation& simulation);

/// Kinetic energy of the spheres' translation in the middle of the last step [J].
double kinetic_energy(const Simulation& simulation);

/// Mean stress tensor in a volume that holds all contacts: sum of force times branch vector over
/// volume (Love, Weber); compression positive [Pa]. Branches to walls end at the wall.
Eigen::Matrix3d mean_stress(const Simulation& simulation, double volume);

/// One branch vector with its force, as stress averages need them.
struct Branch {
    Vec3 from, to;  ///< centre i; centre j, or the contact point on a wall [m]
    Vec3 force;     ///< compression positive: on j from i [N]
};
/// All touching contacts as branches.
std::vector<Branch> force_branches(const Simulation& simulation);

/// Sum over contacts of K_n l^2 over the volume, l the branch length: S of the bounds on the
/// elastic moduli of a packing (K <= S/9, G <= S (2 + 3 lambda)/30) [Pa].
double stiffness_sum(const Simulation& simulation, double volume);

}  // namespace grainfield::core
