#pragma once
// Candidate contacts of a domain, in the order in which the kernels take them.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "kernels/vector/records.hpp"

namespace grainfield::core {

/// Candidates are sorted by how much of their reserves two bodies must use up before they can
/// meet: in the first stretch are those that may touch at once, the last may be left alone for
/// long. A step looks at the stretches that the motion since the build has brought into play.
inline constexpr std::size_t stretches = 8;

/// Stretch of a candidate that touches once the share `used` of its reserves is used up [-].
inline std::uint8_t stretch_of(double used) {
    // Truncation is rounding down: what overlaps already (used < 0) belongs to the first.
    const double stretch = used * static_cast<double>(stretches);
    return stretch > 0 ? static_cast<std::uint8_t>(std::min(stretch, stretches - 1.0))
                       : std::uint8_t{0};
}

/// What a candidate is made from.
template <class T>
struct Candidate {
    std::int32_t source;  ///< what tells it from others of the list; ascending
    std::int32_t a, b;    ///< records
    std::uint8_t stretch;
    kernels::BuiltSeparation<T> separation;
};

template <class T>
struct CandidateList {
    Aligned<std::int32_t> a, b;
    Aligned<kernels::BuiltSeparation<T>> separation;
    Aligned<kernels::ContactHistory<T>> history;
    Aligned<std::uint16_t> touching;
    std::vector<std::int32_t> source;
    std::array<std::size_t, stretches + 1> begin{};  ///< of each stretch, and the end of the last

    std::size_t count() const { return begin.back(); }  ///< without padding
    bool touches(std::size_t k) const {
        return (touching[k / kernels::most_lanes] >> (k % kernels::most_lanes) & 1u) != 0;
    }
    void set_touching(std::size_t k) {
        touching[k / kernels::most_lanes] |=
            static_cast<std::uint16_t>(1u << (k % kernels::most_lanes));
    }
    /// Replaces the list. A contact that touched keeps its history if a candidate has its source;
    /// padding gets the record `idle`.
    void build(std::span<const Candidate<T>> candidates, std::int32_t idle);
    /// Gives candidates other sources, e.g. where neighbours are numbered anew: that of candidate k
    /// becomes renumber(k), negative if it is gone.
    template <class Renumber>
    void renumber(const Renumber& renumber) {
        for (std::size_t k = 0; k < count(); ++k) source[k] = renumber(k);
    }
    /// The candidates that can touch while no more than `used` of any reserve is used up.
    kernels::Candidates<T> view(double used, Aligned<std::int32_t>& scratch);

  private:
    /// History of a contact on its way from one list to the next.
    struct Kept {
        std::int32_t source;
        kernels::ContactHistory<T> history;
    };
    std::vector<Kept> touching_contacts() const;
};

}  // namespace grainfield::core
