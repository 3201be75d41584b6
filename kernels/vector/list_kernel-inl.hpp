// Brings the separations of neighbours up to date and sorts out which of them are candidates.

#if defined(GRAINFIELD_LIST_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_LIST_KERNEL_INL
#undef GRAINFIELD_LIST_KERNEL_INL
#else
#define GRAINFIELD_LIST_KERNEL_INL
#endif

#include "kernels/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

template <class T>
void place_neighbours(const SphereRecord<T>* records, const Neighbours<T>& list) {
    constexpr std::size_t n = lanes<T>;
    const Tag<T> d;
    const auto zero = hn::Zero(d), last = set<T>(T(stretches));
    // A little earlier than need be: round-off must not make a pair come too late.
    const auto early = set<T>(T(1 - 1e-5)), rest = set<T>(T(stretches - 1));
    const auto first = set<T>(T(first_stretch)), one = set<T>(1);
    for (std::size_t k = 0; k < list.size; k += n) {
        alignas(64) T rooms[n], used[n];
        for (std::size_t l = 0; l < n; ++l)
            rooms[l] = records[list.a[k + l]].reserve + records[list.b[k + l]].reserve;
        const Lane4<T> ua = load_places<T>(records, list.a + k);
        const Lane4<T> ub = load_places<T>(records, list.b + k);
        const Lane4<T> built = load_rows<T>(list.separation[k].x);
        const Lane3<T> moved = ub.xyz() - ua.xyz();
        const Lane3<T> branch = built.xyz() + moved;
        const auto before = hn::Sub(hn::Add(ua.w, ub.w), built.w);
        const auto now = hn::Sqrt(dot(branch, branch));
        const auto gap =
            hn::Sub(built.w, hn::Div(growth2<T>(built.xyz(), moved), hn::Add(now, before)));
        store_rows<T>({branch.x, branch.y, branch.z, gap}, list.separation[k].x);
        // Rounded down; pairs that overlap already belong to the first stretch.
        const auto share = hn::Mul(early, hn::Div(hn::Neg(gap), hn::Load(d, rooms)));
        const auto later = hn::Min(last, hn::MulAdd(rest, share, one));
        hn::Store(hn::IfThenElse(hn::Lt(share, first), zero, later), d, used);
        for (std::size_t l = 0; l < n; ++l)
            list.stretch[k + l] = static_cast<std::uint8_t>(used[l]);
    }
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
