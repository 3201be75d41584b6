#pragma once
// Candidate contacts of a domain, in the order in which the kernels take them.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "kernels/vector/records.hpp"

namespace grainfield::core {

/// Stretch (kernels::stretches) of a candidate that touches once the share `used` of its reserves
/// is used up [-].
inline std::uint8_t stretch_of(double used) {
    if (used < kernels::first_stretch) return 0;
    constexpr auto last = static_cast<double>(kernels::stretches - 1);
    return static_cast<std::uint8_t>(std::min(1 + used * last, last));
}

/// Pairs that a candidate list is chosen from, in an order that lasts from one build to the next.
template <class T>
struct Proposals {
    Aligned<std::int32_t> a, b;  ///< records
    Aligned<kernels::BuiltSeparation<T>> separation;
    Aligned<std::uint8_t> stretch;  ///< kernels::stretches if it is no candidate
    std::size_t count = 0;          ///< without padding

    /// Makes room for `n` pairs, in no particular state, and padding: pairs of the record `idle`.
    void resize(std::size_t n, std::int32_t idle);
};

/// Memory to build a list in: histories on their way from one list to the next, by proposal.
template <class T>
struct CarriedHistory {
    std::vector<kernels::ContactHistory<T>> history;
    std::vector<std::uint8_t> touched;
    std::vector<std::int32_t> source;  ///< of the new candidates
};

template <class T>
struct CandidateList {
    Aligned<std::int32_t> a, b;
    Aligned<kernels::BuiltSeparation<T>> separation;
    Aligned<kernels::ContactHistory<T>> history;
    Aligned<std::uint16_t> touching;
    std::vector<std::int32_t> source;  ///< proposal that a candidate was made from; negative: gone
    std::array<std::size_t, kernels::stretches + 1> begin{};  ///< of each stretch, and the end

    std::size_t count() const { return begin.back(); }  ///< without padding
    bool touches(std::size_t k) const {
        return (touching[k / kernels::most_lanes] >> (k % kernels::most_lanes) & 1u) != 0;
    }
    void set_touching(std::size_t k) {
        touching[k / kernels::most_lanes] |=
            static_cast<std::uint16_t>(1u << (k % kernels::most_lanes));
    }
    /// Replaces the list by those proposals that are candidates. A contact that touched keeps its
    /// history if its proposal is there again, in the first stretch; padding gets the record
    /// `idle`. `carried` is memory to work in.
    void build(const Proposals<T>& proposals, std::int32_t idle, CarriedHistory<T>& carried);
    /// Gives proposals other numbers: that of k becomes number[k], negative if it is gone.
    void renumber(std::span<const std::int32_t> number);
    /// The candidates that can touch while no more than `used` of any reserve is used up.
    kernels::Candidates<T> view(double used, Aligned<std::int32_t>& scratch);
};

}  // namespace grainfield::core
