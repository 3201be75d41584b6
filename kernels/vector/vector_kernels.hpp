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

/// Forces of all candidates of a list onto `loads` (both records of each contact).
template <class T>
using VectorPairKernel = PassResult (*)(const SphereRecord<T>*, Candidates<T>, SphereLoad<T>* loads,
                                        const PairParameters<T>&);
/// Forces of one wall's candidates; adds to the wall's load.
template <class T>
using VectorWallKernel = PassResult (*)(const SphereRecord<T>*, const WallPlane<T>&, Candidates<T>,
                                        SphereLoad<T>* loads, const PairParameters<T>&, WallLoad&);
/// Moves records 0 <= k < n (n padded) by one step.
template <class T>
using VectorMoveKernel = MoveResult (*)(SphereRecord<T>*, const SphereLoad<T>*,
                                        const BodyColumns<T>&, const MoveParameters<T>&,
                                        std::size_t n);
/// Finds separation and distance bin of every outer pair. Those that get a bin become the
/// candidates of the inner list; GROMACS calls this pruning.
template <class T>
using PruneKernel = void (*)(const BuiltPlace*, const OuterPairs<T>&);

/// The kernels of contacts, one for each combination of features.
template <class Kernel>
struct ContactKernels {
    Kernel computing[2][2][2];  ///< by friction, per_sphere, sums
    Kernel replaying[2][2];     ///< by friction, per_sphere

    /// Evaluates the contact law: shear forces take their step.
    Kernel compute(ContactFeatures f) const { return computing[f.friction][f.per_sphere][f.sums]; }
    /// Finds the loads of the last evaluation once more, to the same bits. Contacts have their new
    /// shear forces by then, and nothing may have moved. Changes nothing else.
    Kernel replay(ContactFeatures f) const { return replaying[f.friction][f.per_sphere]; }
};

/// The kernels of the motion, one for each combination of features.
template <class Kernel>
struct MotionKernels {
    Kernel moving[2][2][2][2];  ///< by gravity, damping, rotation, ledger

    Kernel move(MotionFeatures f) const {
        return moving[f.gravity][f.damping][f.rotation][f.ledger];
    }
};

template <class T>
struct VectorKernels {
    ContactKernels<VectorPairKernel<T>> pairs;
    ContactKernels<VectorWallKernel<T>> walls;
    MotionKernels<VectorMoveKernel<T>> spheres;
    PruneKernel<T> prune;
};

}  // namespace grainfield::kernels
