#include "core/vector/domain.hpp"

#include <algorithm>
#include <utility>

namespace grainfield::core {

template <class T>
std::int32_t Domain<T>::record(std::int32_t slot) const {
    if (owns(slot)) return slot - static_cast<std::int32_t>(first);
    const auto at = std::lower_bound(ghost_slots.begin(), ghost_slots.end(), slot);
    return static_cast<std::int32_t>(ghost_begin()) +
           static_cast<std::int32_t>(at - ghost_slots.begin());
}

namespace {

/// Gives kept contacts the places that their pairs have among `pairs`; drops those that are gone.
template <class T>
void renumber(std::vector<KeptContact<T>>& kept, const Domain<T>& domain,
              std::span<const kernels::Pair> pairs) {
    auto at = pairs.begin();
    std::size_t left = 0, row = 0;
    for (const KeptContact<T>& contact : kept) {
        while (domain.row_end[row] <= contact.proposal) ++row;
        const auto p = static_cast<std::size_t>(contact.proposal);
        const kernels::Pair key{domain.slot(domain.row_record(row)),
                                domain.slot(domain.neighbours.b[p])};
        at = std::lower_bound(at, pairs.end(), key);
        if (at == pairs.end() || !(*at == key)) continue;
        kept[left] = contact;
        kept[left++].proposal = static_cast<std::int32_t>(at - pairs.begin());
    }
    kept.resize(left);
}

}  // namespace

template <class T>
void set_neighbours(Domain<T>& domain, std::span<const kernels::Pair> pairs) {
    if (!std::exchange(domain.neighbours_are_new, true)) {
        domain.kept.clear();
        domain.pairs.keep(domain.neighbours, domain.kept);
    }
    renumber(domain.kept, domain, pairs);
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
    Proposals& neighbours = domain.neighbours;
    neighbours.resize(pairs.size(), domain.idle());
    const auto low =
        std::lower_bound(ghosts.begin(), ghosts.end(), static_cast<std::int32_t>(domain.first)) -
        ghosts.begin();
    resize_list(domain.row_end, static_cast<std::size_t>(low) + domain.own);
    std::size_t k = 0;
    for (std::size_t row = 0; row < domain.row_end.size(); ++row) {
        const std::int32_t slot = domain.slot(domain.row_record(row));
        for (; k < pairs.size() && pairs[k].i == slot; ++k)
            neighbours.b[k] = domain.record(pairs[k].j);
        domain.row_end[row] = static_cast<std::int32_t>(k);
    }
}

template <class T>
void exchange_neighbours(Domain<T>& domain, std::span<const std::int32_t> slots,
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
    kept.reserve(domain.neighbours.count);
    domain.for_neighbours([&](std::int32_t a, std::int32_t b) {
        const std::int32_t i = domain.slot(a), j = domain.slot(b);
        if (!renewed(i) && !renewed(j)) kept.push_back({i, j});
    });
    std::vector<kernels::Pair> all(kept.size() + added.size());
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(), all.begin());
    set_neighbours(domain, all);
}

namespace {

/// Where all spheres of a domain are, ghosts too; the record that is idle last.
template <class T>
void collect_places(const Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                    Aligned<kernels::BuiltPlace>& places) {
    places.resize(domain.records.size());
    const auto set = [&](std::size_t record, std::size_t slot) {
        const Vec3 x = state.position[slot];
        places[record] = {{x.x(), x.y(), x.z()}, radii[slot], double{state.reserve[slot]}, {}};
    };
    for (std::size_t k = 0; k < domain.own; ++k) set(k, domain.first + k);
    std::size_t record = domain.ghost_begin();
    for (const std::int32_t slot : domain.ghost_slots)
        set(record++, static_cast<std::size_t>(slot));
    places[record] = {{0, 0, 0}, 1, 1, {}};
}

/// First records of all neighbours, padding too.
template <class T>
void collect_firsts(const Domain<T>& domain, Aligned<std::int32_t>& firsts) {
    resize_list(firsts, domain.neighbours.b.size());
    auto at = firsts.begin();
    domain.for_neighbours([&](std::int32_t a, std::int32_t) { *at++ = a; });
    std::fill(at, firsts.end(), domain.idle());
}

}  // namespace

template <class T>
void build_pair_list(Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                     const kernels::VectorKernels<T>& kernels, ListScratch<T>& scratch) {
    Proposals& near = domain.neighbours;
    std::vector<KeptContact<T>>& kept = scratch.kept;
    kept.clear();
    if (std::exchange(domain.neighbours_are_new, false))
        kept = std::exchange(domain.kept, {});
    else
        domain.pairs.keep(near, kept);
    collect_places(domain, state, radii, scratch.places);
    collect_firsts(domain, scratch.firsts);
    resize_list(scratch.separation, kernels::separation_size * near.b.size());
    kernels.place_neighbours(scratch.places.data(),
                             {near.b.size(), scratch.firsts.data(), near.b.data(),
                              scratch.separation.data(), near.stretch.data()});
    domain.pairs.build(scratch.firsts, near, scratch.separation, domain.idle(), kept);
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
        const double room = double{state.reserve[slot]} + state.wall_reserve;
        near.b[k] = static_cast<std::int32_t>(k);
        for (std::size_t c = 0; c < kernels::separation_size; ++c)
            scratch.separation[kernels::in_block(k, c, kernels::separation_size)] =
                c == kernels::gap_component ? static_cast<T>(gap) : T(0);
        near.stretch[k] = gap < -room ? std::uint8_t{kernels::stretches} : stretch_of(-gap / room);
        any |= gap >= -room;
    }
    return any;
}

}  // namespace

template <class T>
void build_wall_lists(Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                      std::span<const Wall> walls, ListScratch<T>& scratch) {
    std::vector<WallList<T>> old = std::move(domain.walls);
    domain.walls.clear();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const Vec3& n = walls[w].normal;
        const Vec3 nearest = (n.array() < 0).select(domain.centres.upper, domain.centres.lower);
        if (n.dot(walls[w].point - nearest) < -(domain.largest_reach + state.wall_reserve))
            continue;
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
        domain.walls.push_back(std::move(made));
    }
}

template struct Domain<float>;
template struct Domain<double>;
template void set_neighbours(Domain<float>&, std::span<const kernels::Pair>);
template void set_neighbours(Domain<double>&, std::span<const kernels::Pair>);
template void exchange_neighbours(Domain<float>&, std::span<const std::int32_t>,
                                  std::span<const kernels::Pair>);
template void exchange_neighbours(Domain<double>&, std::span<const std::int32_t>,
                                  std::span<const kernels::Pair>);
template void build_pair_list(Domain<float>&, const BuiltState&, const SlotRadii&,
                              const kernels::VectorKernels<float>&, ListScratch<float>&);
template void build_pair_list(Domain<double>&, const BuiltState&, const SlotRadii&,
                              const kernels::VectorKernels<double>&, ListScratch<double>&);
template void build_wall_lists(Domain<float>&, const BuiltState&, const SlotRadii&,
                               std::span<const Wall>, ListScratch<float>&);
template void build_wall_lists(Domain<double>&, const BuiltState&, const SlotRadii&,
                               std::span<const Wall>, ListScratch<double>&);

}  // namespace grainfield::core
