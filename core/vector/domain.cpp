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

template <class T>
void set_neighbours(Domain<T>& domain, std::span<const kernels::Pair> pairs) {
    // Contacts that touch are neighbours before and after: they get their new number.
    domain.pairs.renumber([&](std::size_t k) {
        if (!domain.pairs.touches(k)) return std::int32_t{-1};
        const kernels::Pair key{domain.slot(domain.pairs.a[k]), domain.slot(domain.pairs.b[k])};
        const auto at = std::lower_bound(pairs.begin(), pairs.end(), key);
        return at != pairs.end() && *at == key ? static_cast<std::int32_t>(at - pairs.begin())
                                               : std::int32_t{-1};
    });
    auto& ghosts = domain.ghost_slots;
    ghosts.clear();
    for (const auto& [i, j] : pairs) {
        if (!domain.owns(i)) ghosts.push_back(i);
        if (!domain.owns(j)) ghosts.push_back(j);
    }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    domain.records.resize(domain.ghost_begin() + ghosts.size() + 1);
    kernels::SphereRecord<T>& idle = domain.records.back();
    idle = {};
    idle.radius = 1;
    idle.stiffness = 1;
    domain.neighbours.clear();
    domain.neighbours.reserve(pairs.size());
    for (const auto& [i, j] : pairs)
        domain.neighbours.push_back({domain.record(i), domain.record(j)});
}

namespace {

template <class T>
void build_wall_lists(Domain<T>& domain, const BuiltState& state, std::span<const Wall> walls,
                      std::vector<Candidate<T>>& near) {
    std::vector<WallList<T>> old = std::move(domain.walls);
    domain.walls.clear();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        near.clear();
        const Vec3& n = walls[w].normal;
        const double offset = n.dot(walls[w].point);
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t slot = domain.first + k;
            const double gap = state.radius[slot] + offset - n.dot(state.position[slot]);
            const double room = state.reserve[slot] + state.wall_reserve;
            if (gap < -room) continue;
            const auto record = static_cast<std::int32_t>(k);  // own records never change
            near.push_back({record,
                            record,
                            domain.idle(),
                            stretch_of(-gap / room),
                            {{0, 0, 0}, static_cast<T>(gap)}});
        }
        if (near.empty()) continue;
        const auto wall = static_cast<std::int32_t>(w);
        WallList<T> made{wall, {}};
        for (WallList<T>& before : old)
            if (before.wall == wall) made = std::move(before);
        made.list.build(near, domain.idle());
        domain.walls.push_back(std::move(made));
    }
}

}  // namespace

template <class T>
void build_lists(Domain<T>& domain, const BuiltState& state, std::span<const Wall> walls,
                 std::vector<Candidate<T>>& candidates) {
    candidates.clear();
    candidates.reserve(domain.neighbours.size());
    const Vec3Column& x = state.position;
    for (std::size_t k = 0; k < domain.neighbours.size(); ++k) {
        const auto [a, b] = domain.neighbours[k];
        const std::int32_t i = domain.slot(a), j = domain.slot(b);
        const double dx = x.x[j] - x.x[i], dy = x.y[j] - x.y[i], dz = x.z[j] - x.z[i];
        const double reach = state.radius[i] + state.radius[j];
        const double room = state.reserve[i] + state.reserve[j];
        const double square = dx * dx + dy * dy + dz * dz;
        if (square >= (reach + room) * (reach + room)) continue;
        const double gap = reach - std::sqrt(square);
        candidates.push_back(
            {static_cast<std::int32_t>(k),
             a,
             b,
             stretch_of(-gap / room),
             {{static_cast<T>(dx), static_cast<T>(dy), static_cast<T>(dz)}, static_cast<T>(gap)}});
    }
    domain.pairs.build(candidates, domain.idle());
    build_wall_lists(domain, state, walls, candidates);
}

template struct Domain<float>;
template struct Domain<double>;
template void set_neighbours(Domain<float>&, std::span<const kernels::Pair>);
template void set_neighbours(Domain<double>&, std::span<const kernels::Pair>);
template void build_lists(Domain<float>&, const BuiltState&, std::span<const Wall>,
                          std::vector<Candidate<float>>&);
template void build_lists(Domain<double>&, const BuiltState&, std::span<const Wall>,
                          std::vector<Candidate<double>>&);

}  // namespace grainfield::core
