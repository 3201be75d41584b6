#pragma once
// The Verlet lists of one domain. The outer list comes from a search of the whole sample with a
// wide buffer, and serves several inner lists. An inner list, chosen from the outer one, has the
// exact separations of its candidates; the kernels read it in every step.

#include <array>
#include <span>
#include <vector>

#include "core/vector/candidate_list.hpp"
#include "core/vector/domain.hpp"

namespace grainfield::core {

/// Candidates of one wall.
template <class T>
struct WallList {
    std::int32_t wall = 0;
    CandidateList<T> list;
};

template <class T>
struct DomainLists {
    /// Outer list: all pairs that can become candidates before the next search, ascending by slots.
    /// The pairs of one first record are a row. First come the rows of the ghosts whose slots are
    /// below those of the domain, then the rows of its own spheres.
    Proposals outer;
    Aligned<std::int32_t> row_end;  ///< of each row, among the outer pairs

    // Inner lists.
    CandidateList<T> inner;
    std::vector<WallList<T>> walls;

    /// Contacts on their way to the next inner list, where the outer one is newer than it.
    std::vector<KeptContact<T>> kept;
    bool outer_is_new = false;

    /// First record of the pairs of a row.
    std::int32_t row_record(const Domain<T>& domain, std::size_t row) const {
        const std::size_t low = row_end.size() - domain.own;
        return static_cast<std::int32_t>(row < low ? domain.ghost_begin() + row : row - low);
    }
    /// Calls use(a, b) with the records of all outer pairs.
    template <class Use>
    void for_outer_pairs(const Domain<T>& domain, const Use& use) const {
        std::size_t p = 0;
        for (std::size_t row = 0; row < row_end.size(); ++row)
            for (; p < static_cast<std::size_t>(row_end[row]); ++p)
                use(row_record(domain, row), outer.b[p]);
    }
};

/// Where a domain's own spheres are, and how far they reach.
struct DomainReach {
    Box centres;                  ///< when the inner list was built [m]
    double largest_reach = 0;     ///< radius and buffer [m]
    double reach_per_buffer = 0;  ///< the largest (radius + buffer)/buffer [-]
};

/// What inner lists are built from: where spheres and walls were at that time, and their buffers.
struct BuiltState {
    Vec3Column position;             ///< centres, by slot [m]
    Column<float> buffer;            ///< of a sphere, by slot: way beyond the box's strain [m]
    double wall_buffer = 0;          ///< of a wall: deviation from the box's strain [m]
    std::vector<Vec3> walls;         ///< their points [m]
    std::vector<DomainReach> reach;  ///< of each domain
    Vec3 middle = Vec3::Zero();      ///< of the spheres' centres [m]
};

/// Memory of a thread to build lists in.
template <class T>
struct ListScratch {
    Proposals near_wall;
    Aligned<std::int32_t> firsts;         ///< of proposals
    Aligned<kernels::BuiltPlace> places;  ///< of a domain, as its records
    Aligned<T> separation;                ///< of proposals, in blocks
    std::vector<KeptContact<T>> kept;
};

/// Gives the domain a new outer list: `pairs` as slots, ascending by (i, j), i < j, at least one of
/// the two its own. Contacts that touch keep their history. Ghosts' records are left to copy, and
/// the inner list has to be built.
template <class T>
void set_outer_list(Domain<T>& domain, DomainLists<T>& lists, std::span<const kernels::Pair> pairs);

/// Replaces the outer pairs of the spheres `slots` (ascending) by those of `pairs`, which are
/// theirs in all domains, in the order of set_outer_list(). A domain that has nothing to do with
/// these spheres stays as it is.
template <class T>
void exchange_outer_pairs(Domain<T>& domain, DomainLists<T>& lists,
                          std::span<const std::int32_t> slots,
                          std::span<const kernels::Pair> pairs);

/// Chooses the candidates among the outer pairs; contacts that touch keep their history.
template <class T>
void build_inner_list(const Domain<T>& domain, DomainLists<T>& lists, const BuiltState& state,
                      const SlotRadii& radii, const kernels::VectorKernels<T>& kernels,
                      ListScratch<T>& scratch);

/// Chooses the candidates of every wall; contacts that touch keep their history.
template <class T>
void build_wall_lists(const Domain<T>& domain, DomainLists<T>& lists, const BuiltState& state,
                      const DomainReach& reach, const SlotRadii& radii, std::span<const Wall> walls,
                      ListScratch<T>& scratch);

}  // namespace grainfield::core
