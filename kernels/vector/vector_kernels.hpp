#pragma once
// The vector kernels: one text for all instruction sets and both precisions (Highway), chosen at
// run time. They do what the reference kernels do, in the arithmetic of T.

#include "kernels/contact_kernels.hpp"
#include "kernels/sphere_kernels.hpp"
#include "kernels/vector/records.hpp"

namespace grainfield::kernels {

/// What a force pass over candidates yields beside the loads.
struct PassResult {
    ContactSums sums;           ///< with ContactFeatures::sums only; friction_work too
    std::int64_t contacts = 0;  ///< touching candidates of the list, counted or not [-]
    bool too_deep = false;      ///< an overlap exceeds half the smaller radius
};

/// Kernels of contacts: one for every combination of features, and of those without sums one that
/// finds the loads of an evaluation again, to the same bits: contacts have their new shear forces
/// by then, nothing has moved, and nothing changes.
inline constexpr std::size_t contact_variants = 12;

template <class T>
struct VectorKernels {
    /// Forces of all candidates of a list onto `loads` (both records of each contact).
    PassResult (*pairs[contact_variants])(const SphereRecord<T>*, Candidates<T>,
                                          SphereLoad<T>* loads, const PairParameters<T>&);
    /// Forces of one wall's candidates; adds to the wall's load.
    PassResult (*wall[contact_variants])(const SphereRecord<T>*, const WallPlane<T>&, Candidates<T>,
                                         SphereLoad<T>* loads, const PairParameters<T>&, WallLoad&);
    /// Moves records 0 <= k < n (n padded) by one step.
    MoveResult (*move[16])(SphereRecord<T>*, const SphereLoad<T>*, const BodyColumns<T>&,
                           const MoveParameters<T>&, std::size_t n);
    /// Separations and the stretch of each pair.
    void (*place_neighbours)(const BuiltPlace*, const Neighbours<T>&);
};

/// Place of a kernel in the tables above.
constexpr std::size_t variant(ContactFeatures f) {
    return (f.friction ? 1u : 0u) + (f.per_sphere ? 2u : 0u) + (f.sums ? 4u : 0u);
}
/// Of the one that finds the loads again.
constexpr std::size_t variant_again(ContactFeatures f) {
    return 8 + variant({f.friction, f.per_sphere, false});
}
constexpr std::size_t variant(MotionFeatures f) {
    return (f.gravity ? 1u : 0u) + (f.damping ? 2u : 0u) + (f.rotation ? 4u : 0u) +
           (f.ledger ? 8u : 0u);
}

/// Feature number `bit` of a variant, in the order in which variant() adds them up.
constexpr bool has(std::size_t variant, unsigned bit) {
    return (variant >> bit & 1u) != 0;
}
/// Whether a variant of the contacts finds loads again; without friction it does all the same.
template <std::size_t Variant>
inline constexpr bool again = has(Variant, 3) && has(Variant, 0);

}  // namespace grainfield::kernels
