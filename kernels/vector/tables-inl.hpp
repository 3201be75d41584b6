// The table of all variants of one target and precision.

#if defined(GRAINFIELD_TABLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_TABLES_INL
#undef GRAINFIELD_TABLES_INL
#else
#define GRAINFIELD_TABLES_INL
#endif

#include <utility>

#include "kernels/vector/list_kernel-inl.hpp"
#include "kernels/vector/move_kernel-inl.hpp"
#include "kernels/vector/wall_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

template <class T>
const VectorKernels<T>& vector_kernels() {
    static const VectorKernels<T> table = []<std::size_t... V, std::size_t... M>(
        std::index_sequence<V...>, std::index_sequence<M...>) {
        VectorKernels<T> t{};
        ((t.pairs[V] = pair_forces<T, has(V, 0), has(V, 1), has(V, 2), again<V>>), ...);
        ((t.wall[V] = wall_forces<T, has(V, 0), has(V, 1), has(V, 2), again<V>>), ...);
        ((t.move[M] = move_records<T, has(M, 0), has(M, 1), has(M, 2), has(M, 3)>), ...);
        t.place_neighbours = place_neighbours<T>;
        return t;
    }
    (std::make_index_sequence<contact_variants>(), std::make_index_sequence<16>());
    return table;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
