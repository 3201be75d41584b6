#include "core/vector/candidate_list.hpp"

#include <algorithm>
#include <numeric>

namespace grainfield::core {

/// Touching contacts, ascending by source.
template <class T>
std::vector<typename CandidateList<T>::Kept> CandidateList<T>::touching_contacts() const {
    std::vector<Kept> found;
    std::size_t first_stretch = 0;
    for (std::size_t k = 0; k < count(); ++k) {
        if (!touches(k) || source[k] < 0) continue;
        found.push_back({source[k], history[k]});
        first_stretch += k < begin[1];
    }
    // Those of the first stretch, nearly all, ascend as they are, unless they were renumbered.
    const auto less = [](const Kept& x, const Kept& y) { return x.source < y.source; };
    const auto later = found.begin() + static_cast<std::ptrdiff_t>(first_stretch);
    if (!std::is_sorted(found.begin(), later, less)) std::sort(found.begin(), later, less);
    std::sort(later, found.end(), less);
    std::inplace_merge(found.begin(), later, found.end(), less);
    return found;
}

template <class T>
void CandidateList<T>::build(std::span<const Candidate<T>> candidates, std::int32_t idle) {
    const std::vector<Kept> kept = touching_contacts();
    begin.fill(0);
    for (const Candidate<T>& c : candidates) ++begin[c.stretch + 1u];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::array<std::size_t, stretches> next{};
    std::copy_n(begin.begin(), stretches, next.begin());
    // The last entry is always padding.
    const std::size_t size = kernels::padded(count() + 1);
    for (auto* column : {&a, &b}) column->resize(size);
    separation.resize(size);
    source.resize(count());
    history.assign(size, {});
    touching.assign(size / kernels::most_lanes, 0);
    auto old = kept.begin();
    for (const Candidate<T>& c : candidates) {
        const std::size_t k = next[c.stretch]++;
        a[k] = c.a;
        b[k] = c.b;
        separation[k] = c.separation;
        source[k] = c.source;
        while (old != kept.end() && old->source < c.source) ++old;
        if (old == kept.end() || old->source != c.source) continue;
        history[k] = old->history;
        set_touching(k);
    }
    for (std::size_t k = count(); k < size; ++k) {
        a[k] = b[k] = idle;
        separation[k] = {{4, 0, 0}, -2};  // records that are idle have a radius of 1
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

template struct CandidateList<float>;
template struct CandidateList<double>;

}  // namespace grainfield::core
