#pragma once
// The Verlet lists of the fast engine, and when they are built. There are two, as in GROMACS:
//
//   outer list   pairs that may become candidates, found by a search of the whole sample;
//                a few spheres that fly off are searched for alone (partial rebuild)
//   inner list   candidates chosen from the outer list, with the exact separations of their
//                spheres at that time; the steps read this one
//
// Both hold while no sphere has used up its buffer (verlet_buffers.hpp). Candidates are sorted by
// the share of their buffers that they need to meet (CandidateList), and a step looks only at those
// that the motion since the build has brought into play.

#include "core/vector/verlet_buffers.hpp"

namespace grainfield::core {

template <class T>
class VerletLists {
  public:
    VerletLists(const World& world, Decomposition<T>& sample,
                const kernels::VectorKernels<T>& kernels);

    /// True if a contact could be missed, or nothing is known.
    bool outdated() const { return invalid_ || !(buffers_.used() < 1); }
    /// Builds the inner lists from the present positions, and before that, where it has to, the
    /// outer one or a part of it. Ghosts' records are left to copy. Throws SimulationError if a
    /// position is not a number.
    void rebuild();
    /// The next evaluation needs a search.
    void invalidate() { invalid_ = true; }
    /// The same, and the history of contacts with walls is gone.
    void forget_walls();

    /// Brings candidates into play for a force evaluation at the present positions. Once in play
    /// they stay so until the next build: contacts among them carry history.
    void bring_into_play() { most_used_ = std::max(most_used_, buffers_.used()); }
    /// Those in play of a list of ours, for the kernels; scratch of a thread.
    kernels::Candidates<T> in_play(CandidateList<T>& list, Aligned<std::int32_t>& scratch) const {
        return list.view(most_used_, scratch);
    }
    /// How many pairs of a domain are in play.
    std::size_t pairs_in_play(std::size_t domain) const {
        return lists_[domain].inner.begin[bin_of(most_used_) + 1u];
    }

    DomainLists<T>& of(std::size_t domain) { return lists_[domain]; }
    const DomainLists<T>& of(std::size_t domain) const { return lists_[domain]; }
    VerletBuffers<T>& buffers() { return buffers_; }
    const VerletBuffers<T>& buffers() const { return buffers_; }
    /// Where everything was when the inner lists were built.
    const BuiltState& built() const { return buffers_.built(); }

    /// The outer list: pairs of spheres, i < j in no particular order.
    std::vector<kernels::Pair> outer_pairs() const;
    std::int64_t candidate_count() const;  ///< in the inner lists, walls too [-]

    std::int64_t builds() const { return builds_; }                      ///< of inner lists [-]
    std::int64_t searches() const { return searches_; }                  ///< of outer lists [-]
    std::int64_t partial_rebuilds() const { return partial_rebuilds_; }  ///< of outer lists [-]

    /// Finds where ghosts are copied from; after a load.
    void link_ghosts();

    /// link_ghosts() has to follow a load of this and of the domains.
    template <class Archive>
    void serialize(Archive& archive) {
        archive(lists_, bytes(boxes_), buffers_, most_used_, invalid_, builds_, searches_,
                partial_rebuilds_);
    }

  private:
    SlotRadii radii() const { return {sample_.order.sphere, world_.spheres().radius}; }
    void build_inner();
    void search();
    void set_outer_lists(std::span<const kernels::Pair> pairs);
    bool rebuild_partially(const Shortage& shortage);
    std::vector<kernels::Pair> pairs_of(std::int32_t slot) const;

    const World& world_;
    Decomposition<T>& sample_;
    const kernels::VectorKernels<T>& kernels_;
    std::vector<DomainLists<T>> lists_;    // of each domain
    std::vector<Box> boxes_;               // what its spheres could reach since the search [m]
    std::vector<ListScratch<T>> scratch_;  // of each thread
    VerletBuffers<T> buffers_;
    double most_used_ = 0;  // of any inner buffer, at an evaluation since the build [-]
    bool invalid_ = true;
    std::int64_t builds_ = 0, searches_ = 0, partial_rebuilds_ = 0;
};

}  // namespace grainfield::core
