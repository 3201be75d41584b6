// Sums over lanes that are the same to the last bit for every width of the vectors.

#if defined(GRAINFIELD_WIDE_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_WIDE_SUM_INL
#undef GRAINFIELD_WIDE_SUM_INL
#else
#define GRAINFIELD_WIDE_SUM_INL
#endif

#include "kernels/vector/lanes-inl.hpp"
#include "kernels/vector/records.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// Vectors that make up most_lanes lanes.
template <class T>
inline constexpr std::size_t slots = most_lanes / lanes<T>;
/// Which of them element k of a list belongs to; k is a multiple of the lanes.
template <class T>
HWY_INLINE std::size_t slot_of(std::size_t k) {
    return k / lanes<T> % slots<T>;
}

/// A sum in most_lanes partial sums, whatever the width of the vectors: number k of a list goes to
/// the partial sum k modulo most_lanes.
template <class T>
struct WideSum {
    Lane<T> part[slots<T>];

    HWY_INLINE WideSum() {
        for (Lane<T>& p : part) p = hn::Zero(Tag<T>());
    }
    HWY_INLINE void add(std::size_t slot, Lane<T> value) {
        part[slot] = hn::Add(part[slot], value);
    }
    HWY_INLINE void add_product(std::size_t slot, Lane<T> a, Lane<T> b) {
        part[slot] = hn::MulAdd(a, b, part[slot]);
    }
    /// In double, partial sum after partial sum.
    HWY_INLINE double total() const {
        alignas(64) T lane[lanes<T>];
        double sum = 0;
        for (const Lane<T>& p : part) {
            hn::Store(p, Tag<T>(), lane);
            for (T value : lane) sum += static_cast<double>(value);
        }
        return sum;
    }
};

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
