// The kernels of one target and precision, for every combination of features.

#if defined(GRAINFIELD_TABLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_TABLES_INL
#undef GRAINFIELD_TABLES_INL
#else
#define GRAINFIELD_TABLES_INL
#endif

#include "kernels/vector/move_kernel-inl.hpp"
#include "kernels/vector/prune_kernel-inl.hpp"
#include "kernels/vector/wall_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

template <class T, bool Friction, bool PerSphere>
constexpr void set_contact_kernels(VectorKernels<T>& table) {
    // Without friction there are no shear forces to leave alone.
    constexpr bool replay = Friction;
    const auto set = [](auto& kernels, auto plain, auto with_sums, auto replayed) {
        kernels.computing[Friction][PerSphere][false] = plain;
        kernels.computing[Friction][PerSphere][true] = with_sums;
        kernels.replaying[Friction][PerSphere] = replayed;
    };
    set(table.pairs, pair_forces<T, Friction, PerSphere, false, false>,
        pair_forces<T, Friction, PerSphere, true, false>,
        pair_forces<T, Friction, PerSphere, false, replay>);
    set(table.walls, wall_forces<T, Friction, PerSphere, false, false>,
        wall_forces<T, Friction, PerSphere, true, false>,
        wall_forces<T, Friction, PerSphere, false, replay>);
}

template <class T, bool Gravity, bool Damping>
constexpr void set_motion_kernels(VectorKernels<T>& table) {
    auto& kernels = table.spheres.moving[Gravity][Damping];
    kernels[false][false] = move_records<T, Gravity, Damping, false, false>;
    kernels[false][true] = move_records<T, Gravity, Damping, false, true>;
    kernels[true][false] = move_records<T, Gravity, Damping, true, false>;
    kernels[true][true] = move_records<T, Gravity, Damping, true, true>;
}

/// Constant: code that fills it would be of this target, and run on CPUs that cannot.
template <class T>
const VectorKernels<T>& vector_kernels() {
    static constexpr VectorKernels<T> table = [] {
        VectorKernels<T> t{};
        set_contact_kernels<T, false, false>(t);
        set_contact_kernels<T, false, true>(t);
        set_contact_kernels<T, true, false>(t);
        set_contact_kernels<T, true, true>(t);
        set_motion_kernels<T, false, false>(t);
        set_motion_kernels<T, false, true>(t);
        set_motion_kernels<T, true, false>(t);
        set_motion_kernels<T, true, true>(t);
        t.prune = prune<T>;
        return t;
    }();
    return table;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
