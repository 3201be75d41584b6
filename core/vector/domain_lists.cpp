#include "core/vector/domain_lists.hpp"

#include <algorithm>
#include <utility>

namespace grainfield::core {

namespace {

/// Gives kept contacts the places that their pairs have among `pairs`; drops those that are gone.
template <class T>
void renumber(std::vector<KeptContact<T>>& kept, const Domain<T>& domain,
              const DomainLists<T>& lists, std::span<const kernels::Pair> pairs) {
    auto at = pairs.begin();
    std::size_t left = 0, row = 0;
    for (const KeptContact<T>& contact : kept) {
        while (lists.row_end[row] <= contact.proposal) ++row;
        const auto p = static_cast<std::size_t>(contact.proposal);
        const kernels::Pair key{domain.slot(lists.row_record(domain, row)),
                                domain.slot(lists.outer.b[p])};
        at = std::lower_bound(at, pairs.end(), key);
        if (at == pairs.end() || !(*at == key)) continue;
        kept[left] = contact;
        kept[left++].proposal = static_cast<std::int32_t>(at - pairs.begin());
    }
    kept.resize(left);
}

}  // namespace

template <class T>
void set_outer_list(Domain<T>& domain, DomainLists<T>& lists,
                    std::span<const kernels::Pair> pairs) {
    if (!std::exchange(lists.outer_is_new, true)) {
        lists.kept.clear();
        lists.inner.keep(lists.outer, lists.kept);
    }
    renumber(lists.kept, domain, lists, pairs);
    auto& ghosts = domain.ghost_slots;
    ghosts.clear();
    for (const auto& [i, j] : pairs) {
        if (!domain.owns(i)) ghosts.push_back(i);
        if (!domain.owns(j)) ghosts.push_back(j);
    }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    ghosts.shrink_to_fit();
    resize_list(domain.records, domain.ghost_begin() + ghosts.size() + 1);
    kernels::SphereRecord<T>& idle = domain.records.back();
    idle = {};
    idle.radius = idle.compliance = 1;
    Proposals& outer = lists.outer;
    outer.resize(pairs.size(), domain.idle());
    const auto low =
        std::lower_bound(ghosts.begin(), ghosts.end(), static_cast<std::int32_t>(domain.first)) -
        ghosts.begin();
    resize_list(lists.row_end, static_cast<std::size_t>(low) + domain.own);
    std::size_t k = 0;
    for (std::size_t row = 0; row < lists.row_end.size(); ++row) {
        const std::int32_t slot = domain.slot(lists.row_record(domain, row));
        for (; k < pairs.size() && pairs[k].i == slot; ++k) outer.b[k] = domain.record(pairs[k].j);
        lists.row_end[row] = static_cast<std::int32_t>(k);
    }
}

template <class T>
void exchange_outer_pairs(Domain<T>& domain, DomainLists<T>& lists,
                          std::span<const std::int32_t> slots,
                          std::span<const kernels::Pair> pairs) {
    const auto renewed = [&](std::int32_t slot) {
        return std::binary_search(slots.begin(), slots.end(), slot);
    };
    std::vector<kernels::Pair> kept, added;
    for (const kernels::Pair& pair : pairs)
        if (domain.owns(pair.i) || domain.owns(pair.j)) added.push_back(pair);
    const bool known = std::any_of(slots.begin(), slots.end(),
                                   [&](std::int32_t slot) { return domain.knows(slot); });
    if (added.empty() && !known) return;
    kept.reserve(lists.outer.count);
    lists.for_outer_pairs(domain, [&](std::int32_t a, std::int32_t b) {
        const std::int32_t i = domain.slot(a), j = domain.slot(b);
        if (!renewed(i) && !renewed(j)) kept.push_back({i, j});
    });
    std::vector<kernels::Pair> all(kept.size() + added.size());
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(), all.begin());
    set_outer_list<T>(domain, lists, all);
}

namespace {

/// Where all spheres of a domain are, ghosts too; the record that is idle last.
template <class T>
void collect_places(const Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                    Aligned<kernels::BuiltPlace>& places) {
    places.resize(domain.records.size());
    const auto set = [&](std::size_t record, std::size_t slot) {
        const Vec3 x = state.position[slot];
        places[record] = {{x.x(), x.y(), x.z()}, radii[slot], double{state.buffer[slot]}, {}};
    };
    for (std::size_t k = 0; k < domain.own; ++k) set(k, domain.first + k);
    std::size_t record = domain.ghost_begin();
    for (const std::int32_t slot : domain.ghost_slots)
        set(record++, static_cast<std::size_t>(slot));
    places[record] = {{0, 0, 0}, 1, 1, {}};
}

/// First records of all outer pairs, padding too.
template <class T>
void collect_firsts(const Domain<T>& domain, const DomainLists<T>& lists,
                    Aligned<std::int32_t>& firsts) {
    resize_list(firsts, lists.outer.b.size());
    auto at = firsts.begin();
    lists.for_outer_pairs(domain, [&](std::int32_t a, std::int32_t) { *at++ = a; });
    std::fill(at, firsts.end(), domain.idle());
}

}  // namespace

template <class T>
void build_inner_list(const Domain<T>& domain, DomainLists<T>& lists, const BuiltState& state,
                      const SlotRadii& radii, const kernels::VectorKernels<T>& kernels,
                      ListScratch<T>& scratch) {
    Proposals& near = lists.outer;
    std::vector<KeptContact<T>>& kept = scratch.kept;
    kept.clear();
    if (std::exchange(lists.outer_is_new, false))
        kept = std::exchange(lists.kept, {});
    else
        lists.inner.keep(near, kept);
    collect_places(domain, state, radii, scratch.places);
    collect_firsts(domain, lists, scratch.firsts);
    resize_list(scratch.separation, kernels::separation_size * near.b.size());
    kernels.prune(scratch.places.data(), {near.b.size(), scratch.firsts.data(), near.b.data(),
                                          scratch.separation.data(), near.bin.data()});
    lists.inner.build(scratch.firsts, near, scratch.separation, domain.idle(), kept);
}

namespace {

/// Proposes all spheres of a domain as candidates of a wall; false if none can meet it before the
/// next lists.
template <class T>
bool propose_to_wall(const Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                     const Wall& wall, ListScratch<T>& scratch) {
    Proposals& near = scratch.near_wall;
    near.resize(domain.own, domain.idle());
    resize_list(scratch.separation, kernels::separation_size * near.b.size());
    const double offset = wall.normal.dot(wall.point);
    bool any = false;
    for (std::size_t k = 0; k < domain.own; ++k) {
        const std::size_t slot = domain.first + k;
        const double gap = radii[slot] + offset - wall.normal.dot(state.position[slot]);
        const double room = double{state.buffer[slot]} + state.wall_buffer;
        near.b[k] = static_cast<std::int32_t>(k);
        for (std::size_t c = 0; c < kernels::separation_size; ++c)
            scratch.separation[kernels::in_block(k, c, kernels::separation_size)] =
                c == kernels::gap_component ? static_cast<T>(gap) : T(0);
        near.bin[k] = gap < -room ? std::uint8_t{kernels::distance_bins} : bin_of(-gap / room);
        any |= gap >= -room;
    }
    return any;
}

}  // namespace

template <class T>
void build_wall_lists(const Domain<T>& domain, DomainLists<T>& lists, const BuiltState& state,
                      const DomainReach& reach, const SlotRadii& radii, std::span<const Wall> walls,
                      ListScratch<T>& scratch) {
    std::vector<WallList<T>> old = std::move(lists.walls);
    lists.walls.clear();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const Vec3& n = walls[w].normal;
        const Vec3 nearest = (n.array() < 0).select(reach.centres.upper, reach.centres.lower);
        if (n.dot(walls[w].point - nearest) < -(reach.largest_reach + state.wall_buffer)) continue;
        const auto wall = static_cast<std::int32_t>(w);
        WallList<T> made{wall, {}};
        std::vector<KeptContact<T>>& kept = scratch.kept;
        kept.clear();
        for (WallList<T>& before : old)
            if (before.wall == wall) {
                made = std::move(before);
                made.list.keep_by_record(kept);
            }
        if (!propose_to_wall(domain, state, radii, walls[w], scratch) && kept.empty()) continue;
        Proposals& near = scratch.near_wall;
        made.list.build(near.b, near, scratch.separation, domain.idle(), kept);
        lists.walls.push_back(std::move(made));
    }
}

template void set_outer_list(Domain<float>&, DomainLists<float>&, std::span<const kernels::Pair>);
template void exchange_outer_pairs(Domain<float>&, DomainLists<float>&,
                                   std::span<const std::int32_t>, std::span<const kernels::Pair>);
template void build_inner_list(const Domain<float>&, DomainLists<float>&, const BuiltState&,
                               const SlotRadii&, const kernels::VectorKernels<float>&,
                               ListScratch<float>&);
template void build_wall_lists(const Domain<float>&, DomainLists<float>&, const BuiltState&,
                               const DomainReach&, const SlotRadii&, std::span<const Wall>,
                               ListScratch<float>&);
template void set_outer_list(Domain<double>&, DomainLists<double>&, std::span<const kernels::Pair>);
template void exchange_outer_pairs(Domain<double>&, DomainLists<double>&,
                                   std::span<const std::int32_t>, std::span<const kernels::Pair>);
template void build_inner_list(const Domain<double>&, DomainLists<double>&, const BuiltState&,
                               const SlotRadii&, const kernels::VectorKernels<double>&,
                               ListScratch<double>&);
template void build_wall_lists(const Domain<double>&, DomainLists<double>&, const BuiltState&,
                               const DomainReach&, const SlotRadii&, std::span<const Wall>,
                               ListScratch<double>&);

}  // namespace grainfield::core
