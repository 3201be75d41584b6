#pragma once
// Candidate contacts of a domain, in the order in which the kernels take them.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/scene/particle_store.hpp"
#include "kernels/vector/records.hpp"

namespace grainfield::core {

/// Distance bin (kernels::distance_bins) of a candidate that touches once the share `used` of its
/// buffers is used up [-].
inline std::uint8_t bin_of(double used) {
    if (used < kernels::first_bin) return 0;
    constexpr auto last = static_cast<double>(kernels::distance_bins - 1);
    return static_cast<std::uint8_t>(std::min(1 + used * last, last));
}

/// Pairs that a candidate list is chosen from. Their order stays the same from one build to the
/// next. Only second records stand here: pairs are grouped by their first record, which the caller
/// knows.
struct Proposals {
    Aligned<std::int32_t> b;    ///< second records
    Aligned<std::uint8_t> bin;  ///< kernels::distance_bins if it is no candidate
    std::size_t count = 0;      ///< without padding

    /// Makes room for `n` pairs, in no particular state, and padding: the record `idle`.
    void resize(std::size_t n, std::int32_t idle);
};

/// A contact on its way from one list to the next.
template <class T>
struct KeptContact {
    std::int32_t proposal;  ///< its place among the proposals
    T shear[kernels::history_size];
};

template <class T>
struct CandidateList {
    Aligned<std::int32_t> a, b;      ///< records, times kernels::record_stride
    Aligned<T> separation, history;  ///< in blocks
    Aligned<std::uint16_t> touching;
    std::array<std::size_t, kernels::distance_bins + 1> begin{};  ///< of each bin, and the end

    std::size_t count() const { return begin.back(); }  ///< without padding
    bool touches(std::size_t k) const {
        return (touching[k / kernels::most_lanes] >> (k % kernels::most_lanes) & 1u) != 0;
    }
    void set_touching(std::size_t k) {
        touching[k / kernels::most_lanes] |=
            static_cast<std::uint16_t>(1u << (k % kernels::most_lanes));
    }
    /// Records of a candidate.
    std::int32_t first(std::size_t k) const { return a[k] / kernels::record_stride<T>; }
    std::int32_t second(std::size_t k) const { return b[k] / kernels::record_stride<T>; }
    /// Component of the shear force on the first body [N].
    T& shear(std::size_t k, std::size_t component) {
        return history[kernels::in_block(k, component, kernels::history_size)];
    }
    Vec3 shear(std::size_t k) const {
        const auto at = [&](std::size_t c) {
            return double{history[kernels::in_block(k, c, kernels::history_size)]};
        };
        return {at(0), at(1), at(2)};
    }

    /// Appends the contacts that touch, ascending by proposal; the list was made from `proposals`,
    /// whose bins are still those of that time.
    void keep(const Proposals& proposals, std::vector<KeptContact<T>>& kept) const;
    /// The same where a proposal's place is the number of its first record.
    void keep_by_record(std::vector<KeptContact<T>>& kept) const;
    /// Replaces the list by those proposals that are candidates. `firsts` are the first records of
    /// the proposals, `separation` is theirs in blocks. Contacts in `kept` get their history and go
    /// into bin 0, even if they have come apart: the next step has to book the energy of their
    /// springs. Padding gets the record `idle`.
    void build(std::span<const std::int32_t> firsts, Proposals& proposals,
               const Aligned<T>& separation, std::int32_t idle,
               std::span<const KeptContact<T>> kept);
    /// The candidates that can touch while no more than `used` of any buffer is used up.
    kernels::Candidates<T> view(double used, Aligned<std::int32_t>& scratch);

  private:
    KeptContact<T> kept_contact(std::size_t k, std::size_t proposal) const;
};

}  // namespace grainfield::core
