#include "core/vector/candidate_list.hpp"

#include <algorithm>
#include <numeric>

namespace grainfield::core {
namespace {

/// Records that are idle have a radius of 1: two that are so far apart never touch.
template <class T>
constexpr T far_apart[kernels::separation_size] = {4, 0, 0, -2};

}  // namespace

void Proposals::resize(std::size_t n, std::int32_t idle) {
    count = n;
    const std::size_t size = kernels::padded(n);
    resize_list(b, size);
    resize_list(bin, size);
    for (std::size_t k = n; k < size; ++k) b[k] = idle;
}

template <class T>
KeptContact<T> CandidateList<T>::kept_contact(std::size_t k, std::size_t proposal) const {
    KeptContact<T> contact{static_cast<std::int32_t>(proposal), {}};
    for (std::size_t c = 0; c < kernels::history_size; ++c)
        contact.shear[c] = history[kernels::in_block(k, c, kernels::history_size)];
    return contact;
}

template <class T>
void CandidateList<T>::keep(const Proposals& proposals, std::vector<KeptContact<T>>& kept) const {
    kept.reserve(kept.size() + begin[1]);  // others seldom touch
    // Candidates of a bin stand in the order of their proposals.
    std::array<std::size_t, kernels::distance_bins + 1> next = begin;
    for (std::size_t p = 0; p < proposals.count; ++p) {
        const std::size_t s = proposals.bin[p], k = next[s]++;
        if (s < kernels::distance_bins && touches(k)) kept.push_back(kept_contact(k, p));
    }
}

template <class T>
void CandidateList<T>::keep_by_record(std::vector<KeptContact<T>>& kept) const {
    for (std::size_t k = 0; k < count(); ++k)
        if (touches(k)) kept.push_back(kept_contact(k, static_cast<std::size_t>(first(k))));
    std::sort(kept.begin(), kept.end(), [](const KeptContact<T>& x, const KeptContact<T>& y) {
        return x.proposal < y.proposal;
    });
}

template <class T>
void CandidateList<T>::build(std::span<const std::int32_t> firsts, Proposals& proposals,
                             const Aligned<T>& separations, std::int32_t idle,
                             std::span<const KeptContact<T>> kept) {
    using kernels::history_size, kernels::in_block, kernels::separation_size;
    for (const KeptContact<T>& contact : kept)
        proposals.bin[static_cast<std::size_t>(contact.proposal)] = 0;
    // Counting sort by bin, without branches: they would be mispredicted. Pairs that are no
    // candidates are written to the first place behind the list, which padding overwrites.
    std::array<std::size_t, kernels::distance_bins + 2> first{};
    for (std::size_t p = 0; p < proposals.count; ++p) ++first[proposals.bin[p] + 1u];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::copy_n(first.begin(), begin.size(), begin.begin());
    // The last entry is always padding.
    const std::size_t size = kernels::padded(count() + 1);
    for (auto* column : {&a, &b}) resize_list(*column, size);
    resize_list(separation, separation_size * size);
    resize_list(history, history_size * size);
    std::fill(history.begin(), history.end(), T(0));
    touching.assign(size / kernels::most_lanes, 0);
    auto contact = kept.begin();
    for (std::size_t p = 0; p < proposals.count; ++p) {
        const std::size_t bin = proposals.bin[p];
        const std::size_t k = std::min(first[bin]++, count());
        a[k] = firsts[p] * kernels::record_stride<T>;
        b[k] = proposals.b[p] * kernels::record_stride<T>;
        for (std::size_t c = 0; c < separation_size; ++c)
            separation[in_block(k, c, separation_size)] =
                separations[in_block(p, c, separation_size)];
        if (contact == kept.end() || static_cast<std::size_t>(contact->proposal) != p) continue;
        for (std::size_t c = 0; c < history_size; ++c) shear(k, c) = contact->shear[c];
        set_touching(k);
        ++contact;
    }
    for (std::size_t k = count(); k < size; ++k) {
        a[k] = b[k] = idle * kernels::record_stride<T>;
        for (std::size_t c = 0; c < separation_size; ++c)
            separation[in_block(k, c, separation_size)] = far_apart<T>[c];
    }
}

template <class T>
kernels::Candidates<T> CandidateList<T>::view(double used, Aligned<std::int32_t>& scratch) {
    if (scratch.size() < a.size() + kernels::most_lanes)
        scratch.resize(a.size() + kernels::most_lanes);
    const std::size_t size = kernels::padded(begin[bin_of(used) + 1u]);
    return {.size = size,
            .close = std::min(size, kernels::padded(begin[1])),
            .idle = a.size() - 1,
            .a = a.data(),
            .b = b.data(),
            .separation = separation.data(),
            .history = history.data(),
            .touching = touching.data(),
            .scratch = scratch.data()};
}

template struct CandidateList<float>;
template struct CandidateList<double>;

}  // namespace grainfield::core
