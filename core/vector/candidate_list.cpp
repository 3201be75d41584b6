#include "core/vector/candidate_list.hpp"

#include <algorithm>
#include <numeric>

namespace grainfield::core {
namespace {

/// Records that are idle have a radius of 1: two that are so far apart never touch.
template <class T>
constexpr kernels::BuiltSeparation<T> far_apart{{4, 0, 0}, -2};

}  // namespace

template <class T>
void Proposals<T>::resize(std::size_t n, std::int32_t idle) {
    count = n;
    const std::size_t size = kernels::padded(n);
    for (auto* column : {&a, &b}) resize_list(*column, size);
    resize_list(separation, size);
    resize_list(stretch, size);
    for (std::size_t k = n; k < size; ++k) {
        a[k] = b[k] = idle;
        separation[k] = far_apart<T>;
    }
}

template <class T>
void CandidateList<T>::renumber(std::span<const std::int32_t> number) {
    for (std::size_t k = 0; k < count(); ++k)
        if (source[k] >= 0) source[k] = number[static_cast<std::size_t>(source[k])];
}

template <class T>
void CandidateList<T>::build(const Proposals<T>& proposals, std::int32_t idle,
                             CarriedHistory<T>& carried) {
    carried.touched.assign(proposals.count, 0);
    carried.history.assign(proposals.count, {});
    for (std::size_t k = 0; k < count(); ++k) {
        if (source[k] < 0) continue;
        const auto p = static_cast<std::size_t>(source[k]);
        carried.history[p] = history[k];
        carried.touched[p] = touches(k);
    }
    // Counting sort by stretch; no branches, which nobody could foresee. Those that are no
    // candidates come last and are dropped.
    std::array<std::size_t, kernels::stretches + 2> first{};
    for (std::size_t p = 0; p < proposals.count; ++p) ++first[proposals.stretch[p] + 1u];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::copy_n(first.begin(), begin.size(), begin.begin());
    carried.source.resize(proposals.count);
    for (std::size_t p = 0; p < proposals.count; ++p)
        carried.source[first[proposals.stretch[p]]++] = static_cast<std::int32_t>(p);
    resize_list(source, count());
    std::copy_n(carried.source.begin(), count(), source.begin());
    // The last entry is always padding.
    const std::size_t size = kernels::padded(count() + 1);
    for (auto* column : {&a, &b}) resize_list(*column, size);
    resize_list(separation, size);
    resize_list(history, size);
    touching.assign(size / kernels::most_lanes, 0);
    for (std::size_t k = 0; k < count(); ++k) {
        const auto p = static_cast<std::size_t>(source[k]);
        a[k] = proposals.a[p];
        b[k] = proposals.b[p];
        separation[k] = proposals.separation[p];
        // Beyond the first stretch a pair is apart by now: what it carried is gone, and nobody
        // would look at it before it is in play.
        const bool near = k < begin[1];
        history[k] = near ? carried.history[p] : kernels::ContactHistory<T>{};
        if (near && carried.touched[p] != 0) set_touching(k);
    }
    for (std::size_t k = count(); k < size; ++k) {
        a[k] = b[k] = idle;
        separation[k] = far_apart<T>;
        history[k] = {};
    }
}

template <class T>
kernels::Candidates<T> CandidateList<T>::view(double used, Aligned<std::int32_t>& scratch) {
    if (scratch.size() < a.size() + kernels::most_lanes)
        scratch.resize(a.size() + kernels::most_lanes);
    const std::size_t size = kernels::padded(begin[stretch_of(used) + 1u]);
    return {size,           std::min(size, kernels::padded(begin[1])),
            a.size() - 1,   a.data(),
            b.data(),       separation.data(),
            history.data(), touching.data(),
            scratch.data()};
}

template struct Proposals<float>;
template struct Proposals<double>;
template struct CandidateList<float>;
template struct CandidateList<double>;

}  // namespace grainfield::core
