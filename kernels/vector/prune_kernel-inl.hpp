// Prunes the outer Verlet list to the inner one: separations of its pairs, and which are
// candidates.

#if defined(GRAINFIELD_PRUNE_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_PRUNE_KERNEL_INL
#undef GRAINFIELD_PRUNE_KERNEL_INL
#else
#define GRAINFIELD_PRUNE_KERNEL_INL
#endif

#include "kernels/vector/blocks-inl.hpp"
#include "kernels/vector/records.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// Computes in double for every T, because a separation is a difference of nearly equal numbers.
/// Only the result is rounded to T.
template <class T>
void prune(const BuiltPlace* places, const OuterPairs<T>& list) {
    using D = double;
    constexpr std::size_t n = lanes<D>;
    const Tag<D> d;
    const auto zero = hn::Zero(d), last = set<D>(distance_bins);
    // A little earlier than need be: round-off must not make a pair come too late.
    const auto early = set<D>(1 - 1e-5), rest = set<D>(distance_bins - 1);
    const auto first = set<D>(first_bin), one = set<D>(1);
    // b - a of the centres, a + b of radii and buffers.
    alignas(64) D signs[8] = {-1, -1, -1, 1, 1, 1, 1, 1};
    for (std::size_t k = 0; k < list.size; k += n) {
        std::array<Lane<D>, 8> column;
        for (std::size_t part = 0; part < 8; part += n) {
            for (std::size_t l = 0; l < n; ++l)
                column[part + l] = hn::MulAdd(hn::Load(d, places[list.a[k + l]].x + part),
                                              hn::Load(d, signs + part),
                                              hn::Load(d, places[list.b[k + l]].x + part));
            transpose_square<D>(column.data() + part);
        }
        const Lane3<D> branch{column[0], column[1], column[2]};
        const auto gap = hn::Sub(column[3], hn::Sqrt(dot(branch, branch)));
        const auto keep = [&](std::size_t component, Lane<D> value) HWY_ATTR {
            alignas(64) D kept[n];
            hn::Store(value, d, kept);
            T* to = list.separation + in_block(k, component, separation_size);
            for (std::size_t l = 0; l < n; ++l) to[l] = static_cast<T>(kept[l]);
        };
        keep(0, branch.x);
        keep(1, branch.y);
        keep(2, branch.z);
        keep(gap_component, gap);
        // Rounded down; pairs that overlap already belong to the first bin.
        const auto share = hn::Mul(early, hn::Div(hn::Neg(gap), column[4]));
        const auto later = hn::Min(last, hn::MulAdd(rest, share, one));
        alignas(64) D used[n];
        hn::Store(hn::IfThenElse(hn::Lt(share, first), zero, later), d, used);
        for (std::size_t l = 0; l < n; ++l) list.bin[k + l] = static_cast<std::uint8_t>(used[l]);
    }
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
