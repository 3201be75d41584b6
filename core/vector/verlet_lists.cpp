#include "core/vector/verlet_lists.hpp"

#include <omp.h>

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "core/neighbour_search.hpp"

namespace grainfield::core {
namespace {

// A partial rebuild searches for so many spheres at most, and this share of all; and only while
// strain has not taken more than so much of what a new search would give them.
constexpr double few_searched = 8, most_searched = 2e-3, most_strained = 0.5;

}  // namespace

template <class T>
VerletLists<T>::VerletLists(const World& world, Decomposition<T>& sample,
                            const kernels::VectorKernels<T>& kernels)
    : world_(world),
      sample_(sample),
      kernels_(kernels),
      lists_(sample.size()),
      buffers_(world, sample) {}

template <class T>
void VerletLists<T>::rebuild() {
    buffers_.take_positions(!invalid_);
    Shortage shortage;
    if (!invalid_) shortage = buffers_.choose_inner(buffers_.rules(true));
    if (invalid_ || !rebuild_partially(shortage)) {
        search();
        if (buffers_.choose_inner(buffers_.rules(true)).exhausted)
            throw SimulationError("the neighbour lists cannot keep up with the motion");
    }
    build_inner();
    buffers_.begin_inner();
    most_used_ = 0;
    ++builds_;
}

template <class T>
void VerletLists<T>::build_inner() {
    scratch_.resize(static_cast<std::size_t>(omp_get_max_threads()));
    for_pieces(lists_.size(), [&](std::size_t d) {
        const Domain<T>& domain = sample_.domains[d];
        ListScratch<T>& scratch = scratch_[static_cast<std::size_t>(omp_get_thread_num())];
        build_inner_list<T>(domain, lists_[d], built(), radii(), kernels_, scratch);
        build_wall_lists<T>(domain, lists_[d], built(), built().reach[d], radii(),
                            world_.scene.walls, scratch);
    });
}

template <class T>
void VerletLists<T>::forget_walls() {
    for (DomainLists<T>& lists : lists_) lists.walls.clear();
    invalid_ = true;
    buffers_.take_walls();  // until the next build every wall stands where it was built
}

// --- the outer list ------------------------------------------------------------------------------

/// Searches for all pairs that can become candidates until the next search.
template <class T>
void VerletLists<T>::search() {
    const BufferRules rules = buffers_.rules(false);
    buffers_.begin_outer();
    boxes_.resize(sample_.size());
    Column<double> reach(world_.size());
    for_pieces(sample_.size(), [&](std::size_t d) {
        const Domain<T>& domain = sample_.domains[d];
        double largest = 0;
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t slot = domain.first + k;
            reach[slot] = radii()[slot] + buffers_.choose_outer(domain, k, rules);
            largest = std::max(largest, reach[slot]);
        }
        const Box& centres = built().reach[d].centres;
        boxes_[d] = {centres.lower.array() - largest, centres.upper.array() + largest};
    });
    set_outer_lists(find_pairs(built().position, reach, 0.0));
    link_ghosts();
    invalid_ = false;
    ++searches_;
}

/// Deals out the pairs of the sample, ascending as slots.
template <class T>
void VerletLists<T>::set_outer_lists(std::span<const kernels::Pair> pairs) {
    // Pairs ascend by their first slot: a domain's own are contiguous. Those that reach into a
    // later domain are that domain's too.
    const std::vector<std::size_t>& first = sample_.order.first;
    std::vector<std::size_t> begin(sample_.size() + 1, pairs.size());
    std::vector<std::vector<kernels::Pair>> dealt(sample_.size());
    std::size_t at = 0;
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        begin[d] = at;
        const auto end = static_cast<std::int32_t>(first[d + 1]);
        for (; at < pairs.size() && pairs[at].i < end; ++at)
            if (pairs[at].j >= end)
                dealt[sample_.order.domain_of(pairs[at].j)].push_back(pairs[at]);
    }
    for_pieces(sample_.size(), [&](std::size_t d) {
        dealt[d].insert(dealt[d].end(), pairs.begin() + static_cast<std::ptrdiff_t>(begin[d]),
                        pairs.begin() + static_cast<std::ptrdiff_t>(begin[d + 1]));
        set_outer_list<T>(sample_.domains[d], lists_[d], dealt[d]);
        dealt[d] = {};
    });
}

template <class T>
void VerletLists<T>::link_ghosts() {
    for_pieces(sample_.size(), [&](std::size_t d) {
        Domain<T>& domain = sample_.domains[d];
        domain.ghost_sources.clear();
        domain.ghost_sources.reserve(domain.ghost_slots.size());
        const Domain<T>* home = nullptr;
        for (const std::int32_t slot : domain.ghost_slots) {
            if (home == nullptr || !home->owns(slot)) home = &sample_.domain_of(slot);
            domain.ghost_sources.push_back(
                &home->records[static_cast<std::size_t>(slot) - home->first]);
        }
    });
}

/// Searches anew for those spheres alone that have used up their outer buffers, and gives them new
/// ones. The outer pairs of all other spheres stay, with the positions of the last search. The few
/// get a position of that time, too (join_outer). False if they are too many, or if the strain of
/// the box has used up much of the outer buffers: then a search of all is due.
template <class T>
bool VerletLists<T>::rebuild_partially(const Shortage& shortage) {
    if (!shortage.exhausted) return true;
    // With them those that will be next.
    const std::vector<std::int32_t>& slots = shortage.scarce;
    const double most = few_searched + most_searched * static_cast<double>(world_.size());
    if (static_cast<double>(slots.size()) > most) return false;
    const BufferRules rules = buffers_.rules(true);
    for (const std::int32_t slot : slots) {
        const auto s = static_cast<std::size_t>(slot);
        const Domain<T>& domain = sample_.domain_of(slot);
        const double buffer = buffers_.choose_outer(domain, s - domain.first, rules);
        if (by_strain(rules.strain, radii()[s], buffer) > most_strained * buffer) return false;
        buffers_.join_outer(s, rules);
        const Vec3 x = buffers_.searched_position(s);
        const double reach = radii()[s] + buffer;
        Box& box = boxes_[sample_.order.domain_of(slot)];
        box.lower = box.lower.cwiseMin((x.array() - reach).matrix());
        box.upper = box.upper.cwiseMax((x.array() + reach).matrix());
    }
    std::vector<std::vector<kernels::Pair>> found(slots.size());
    for_pieces(slots.size(), [&](std::size_t e) { found[e] = pairs_of(slots[e]); });
    std::vector<kernels::Pair> pairs = joined(found);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for_pieces(sample_.size(), [&](std::size_t d) {
        exchange_outer_pairs<T>(sample_.domains[d], lists_[d], slots, pairs);
    });
    link_ghosts();
    for (const std::int32_t slot : slots) {
        const std::size_t d = sample_.order.domain_of(slot);
        const std::size_t k = static_cast<std::size_t>(slot) - sample_.order.first[d];
        if (buffers_.choose_inner(d, k, rules) == Remainder::none) return false;
    }
    ++partial_rebuilds_;
    return true;
}

/// All outer pairs of a sphere, at the positions of the last search.
template <class T>
std::vector<kernels::Pair> VerletLists<T>::pairs_of(std::int32_t slot) const {
    const auto s = static_cast<std::size_t>(slot);
    const Vec3 x = buffers_.searched_position(s);
    const double reach = radii()[s] + buffers_.outer(s);
    std::vector<kernels::Pair> pairs;
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        const Box& box = boxes_[d];
        if ((x.array() + reach < box.lower.array()).any() ||
            (x.array() - reach > box.upper.array()).any())
            continue;
        for (std::size_t other = sample_.order.first[d]; other < sample_.order.first[d + 1];
             ++other) {
            const double near = reach + radii()[other] + buffers_.outer(other);
            if ((buffers_.searched_position(other) - x).squaredNorm() < near * near && other != s) {
                const auto o = static_cast<std::int32_t>(other);
                pairs.push_back({std::min(slot, o), std::max(slot, o)});
            }
        }
    }
    return pairs;
}

// --- views ---------------------------------------------------------------------------------------

template <class T>
std::vector<kernels::Pair> VerletLists<T>::outer_pairs() const {
    std::vector<kernels::Pair> pairs;
    for (std::size_t d = 0; d < lists_.size(); ++d) {
        const Domain<T>& domain = sample_.domains[d];
        lists_[d].for_outer_pairs(domain, [&](std::int32_t a, std::int32_t b) {
            // Those across a border stand in both domains.
            if (!domain.owns_record(a)) return;
            const auto i = sample_.order.sphere[static_cast<std::size_t>(domain.slot(a))];
            const auto j = sample_.order.sphere[static_cast<std::size_t>(domain.slot(b))];
            pairs.push_back({std::min(i, j), std::max(i, j)});
        });
    }
    return pairs;
}

template <class T>
std::int64_t VerletLists<T>::candidate_count() const {
    std::size_t count = 0;
    for (const DomainLists<T>& lists : lists_) {
        count += lists.inner.count();
        for (const WallList<T>& walls : lists.walls) count += walls.list.count();
    }
    return static_cast<std::int64_t>(count);
}

template class VerletLists<float>;
template class VerletLists<double>;

}  // namespace grainfield::core
