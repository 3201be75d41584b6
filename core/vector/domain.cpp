#include "core/vector/domain.hpp"

#include <algorithm>
#include <cmath>

namespace grainfield::core {

template <class T>
std::int32_t Domain<T>::record(std::int32_t slot) const {
    if (owns(slot)) return slot - static_cast<std::int32_t>(first);
    const auto at = std::lower_bound(ghost_slots.begin(), ghost_slots.end(), slot);
    return static_cast<std::int32_t>(ghost_begin()) +
           static_cast<std::int32_t>(at - ghost_slots.begin());
}

namespace {

/// Number that each neighbour of the domain will have among `pairs`; negative if it is not there.
template <class T>
std::vector<std::int32_t> new_numbers(const Domain<T>& domain,
                                      std::span<const kernels::Pair> pairs) {
    const Proposals<T>& old = domain.neighbours;
    std::vector<std::int32_t> number(old.count, -1);
    auto at = pairs.begin();
    for (std::size_t k = 0; k < old.count; ++k) {
        const kernels::Pair key{domain.slot(old.a[k]), domain.slot(old.b[k])};
        while (at != pairs.end() && *at < key) ++at;
        if (at != pairs.end() && *at == key)
            number[k] = static_cast<std::int32_t>(at - pairs.begin());
    }
    return number;
}

}  // namespace

template <class T>
void set_neighbours(Domain<T>& domain, std::span<const kernels::Pair> pairs,
                    const BuiltState& state) {
    domain.pairs.renumber(new_numbers(domain, pairs));
    auto& ghosts = domain.ghost_slots;
    ghosts.clear();
    for (const auto& [i, j] : pairs) {
        if (!domain.owns(i)) ghosts.push_back(i);
        if (!domain.owns(j)) ghosts.push_back(j);
    }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    resize_list(domain.records, domain.ghost_begin() + ghosts.size() + 1);
    kernels::SphereRecord<T>& idle = domain.records.back();
    idle = {};
    idle.radius = 1;
    idle.stiffness = 1;
    Proposals<T>& neighbours = domain.neighbours;
    neighbours.resize(pairs.size(), domain.idle());
    const Vec3Column& x = state.position;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [i, j] = pairs[k];
        neighbours.a[k] = domain.record(i);
        neighbours.b[k] = domain.record(j);
        const Vec3 branch = x[j] - x[i];
        kernels::BuiltSeparation<T>& s = neighbours.separation[k];
        for (int a = 0; a < 3; ++a) s.x[a] = static_cast<T>(branch[a]);
        s.gap = static_cast<T>(state.radius[i] + state.radius[j] - branch.norm());
    }
    domain.neighbours_are_new = true;
}

template <class T>
void exchange_neighbours(Domain<T>& domain, std::span<const std::int32_t> slots,
                         std::span<const kernels::Pair> pairs, const BuiltState& state) {
    const auto renewed = [&](std::int32_t slot) {
        return std::binary_search(slots.begin(), slots.end(), slot);
    };
    std::vector<kernels::Pair> kept, added;
    for (const kernels::Pair& pair : pairs)
        if (domain.owns(pair.i) || domain.owns(pair.j)) added.push_back(pair);
    const bool known = std::any_of(slots.begin(), slots.end(), [&](std::int32_t slot) {
        return domain.owns(slot) ||
               std::binary_search(domain.ghost_slots.begin(), domain.ghost_slots.end(), slot);
    });
    if (added.empty() && !known) return;
    kept.reserve(domain.neighbours.count);
    for (std::size_t k = 0; k < domain.neighbours.count; ++k) {
        const std::int32_t i = domain.slot(domain.neighbours.a[k]);
        const std::int32_t j = domain.slot(domain.neighbours.b[k]);
        if (!renewed(i) && !renewed(j)) kept.push_back({i, j});
    }
    std::vector<kernels::Pair> all(kept.size() + added.size());
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(), all.begin());
    set_neighbours(domain, all, state);
}

template <class T>
void build_wall_lists(Domain<T>& domain, const BuiltState& state, std::span<const Wall> walls,
                      ListScratch<T>& scratch) {
    std::vector<WallList<T>> old = std::move(domain.walls);
    domain.walls.clear();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const Vec3& n = walls[w].normal;
        const double offset = n.dot(walls[w].point);
        const Vec3 nearest = (n.array() < 0).select(domain.centres.upper, domain.centres.lower);
        if (offset - n.dot(nearest) < -(domain.largest_reach + state.wall_reserve)) continue;
        Proposals<T>& near = scratch.near_wall;
        near.resize(domain.own, domain.idle());
        bool any = false;
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t slot = domain.first + k;
            const double gap = state.radius[slot] + offset - n.dot(state.position[slot]);
            const double room = state.reserve[slot] + state.wall_reserve;
            near.a[k] = near.b[k] = static_cast<std::int32_t>(k);
            near.separation[k] = {{0, 0, 0}, static_cast<T>(gap)};
            near.stretch[k] =
                gap < -room ? std::uint8_t{kernels::stretches} : stretch_of(-gap / room);
            any |= gap >= -room;
        }
        if (!any) continue;
        const auto wall = static_cast<std::int32_t>(w);
        WallList<T> made{wall, {}};
        for (WallList<T>& before : old)
            if (before.wall == wall) made = std::move(before);
        made.list.build(near, domain.idle(), scratch.carried);
        domain.walls.push_back(std::move(made));
    }
}

template struct Domain<float>;
template struct Domain<double>;
template void set_neighbours(Domain<float>&, std::span<const kernels::Pair>, const BuiltState&);
template void set_neighbours(Domain<double>&, std::span<const kernels::Pair>, const BuiltState&);
template void exchange_neighbours(Domain<float>&, std::span<const std::int32_t>,
                                  std::span<const kernels::Pair>, const BuiltState&);
template void exchange_neighbours(Domain<double>&, std::span<const std::int32_t>,
                                  std::span<const kernels::Pair>, const BuiltState&);
template void build_wall_lists(Domain<float>&, const BuiltState&, std::span<const Wall>,
                               ListScratch<float>&);
template void build_wall_lists(Domain<double>&, const BuiltState&, std::span<const Wall>,
                               ListScratch<double>&);

}  // namespace grainfield::core
