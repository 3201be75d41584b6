#include "core/reference/contact_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "core/neighbour_search.hpp"

namespace grainfield::core {
namespace {

void check_finite(const ParticleStore& spheres, const Vec3Column& before) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (spheres.position[i].allFinite()) continue;
        std::string what = fmt::format("the position of sphere {} is not a number", i);
        if (i < before.size())
            what += fmt::format(", it was near ({:g}, {:g}, {:g}) m", before.x[i], before.y[i],
                                before.z[i]);
        throw SimulationError(what);
    }
}

std::vector<kernels::WallPair> find_wall_pairs(const ParticleStore& spheres,
                                               std::span<const Wall> walls, double skin) {
    std::vector<kernels::WallPair> found;
    for (std::size_t w = 0; w < walls.size(); ++w)
        for (std::size_t i = 0; i < spheres.size(); ++i)
            if (walls[w].normal.dot(spheres.position[i] - walls[w].point) <
                spheres.radius[i] + skin)
                found.push_back({static_cast<std::int32_t>(w), static_cast<std::int32_t>(i)});
    return found;
}

/// Starts of the runs of equal `key` in a sorted list, and its end.
template <class Entry, class Key>
std::vector<std::size_t> ranges_of(const std::vector<Entry>& list, const Key& key) {
    std::vector<std::size_t> starts{0};
    for (std::size_t c = 1; c < list.size(); ++c)
        if (key(list[c]) != key(list[c - 1])) starts.push_back(c);
    if (!list.empty()) starts.push_back(list.size());
    return starts;
}

std::size_t chunk_of(std::int32_t sphere) {
    return static_cast<std::size_t>(sphere) / chunk_size;
}

}  // namespace

kernels::ContactColumns ContactList::columns(std::size_t first) {
    return {shear_.data() + first, touching_.data() + first, force_.data() + first,
            moment_.data() + first};
}

void ContactList::build(const ParticleStore& spheres, std::span<const Wall> walls, double skin) {
    check_finite(spheres, built_position_);
    const auto old_pairs = std::move(pairs_);
    const auto old_wall_pairs = std::move(wall_pairs_);
    const auto old_shear = std::move(shear_);
    const auto old_touching = std::move(touching_);

    pairs_ = find_pairs(spheres.position, spheres.radius, skin);
    wall_pairs_ = find_wall_pairs(spheres, walls, skin);
    pair_ranges_ = ranges_of(pairs_, [](const kernels::Pair& p) { return chunk_of(p.i); });
    wall_ranges_ = ranges_of(wall_pairs_, [](const kernels::WallPair& p) {
        return std::pair(p.wall, chunk_of(p.sphere));
    });
    shear_.assign(size(), Vec3::Zero());
    touching_.assign(size(), 0);
    force_.resize(size());
    moment_.assign(size(), Vec3::Zero());  // stays so for contacts without friction
    carry_history(old_pairs, old_wall_pairs, old_shear, old_touching);
    index_incidences(spheres.size());

    built_position_ = spheres.position;
    built_walls_.clear();
    for (const Wall& wall : walls) built_walls_.push_back(wall.point);
    skin_ = skin;
    stale_ = false;
    ++builds_;
}

void ContactList::carry_history(std::span<const kernels::Pair> old_pairs,
                                std::span<const kernels::WallPair> old_wall_pairs,
                                const Column<Vec3>& old_shear,
                                const Column<std::uint8_t>& old_touching) {
    // A touching pair is closer than any skin, so it is among the new candidates.
    const auto carry = [&](const auto& old_list, const auto& new_list, std::size_t old_first,
                           std::size_t new_first) {
        for_chunks(old_list.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                if (!old_touching[old_first + c]) continue;
                const auto at = std::lower_bound(new_list.begin(), new_list.end(), old_list[c]);
                if (at == new_list.end() || *at != old_list[c]) continue;
                const std::size_t to = new_first + static_cast<std::size_t>(at - new_list.begin());
                shear_[to] = old_shear[old_first + c];
                touching_[to] = 1;
            }
        });
    };
    carry(old_pairs, pairs_, 0, 0);
    carry(old_wall_pairs, wall_pairs_, old_pairs.size(), pairs_.size());
}

void ContactList::index_incidences(std::size_t spheres) {
    offsets_.assign(spheres + 1, 0);
    for (const auto& p : pairs_) {
        ++offsets_[static_cast<std::size_t>(p.i) + 1];
        ++offsets_[static_cast<std::size_t>(p.j) + 1];
    }
    for (const auto& p : wall_pairs_) ++offsets_[static_cast<std::size_t>(p.sphere) + 1];
    for (std::size_t i = 0; i < spheres; ++i) offsets_[i + 1] += offsets_[i];
    incidences_.resize(offsets_.back());
    std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
        const auto code = static_cast<kernels::Incidence>(2 * c);
        incidences_[next[static_cast<std::size_t>(pairs_[c].i)]++] = code;
        incidences_[next[static_cast<std::size_t>(pairs_[c].j)]++] = code + 1;
    }
    for (std::size_t c = 0; c < wall_pairs_.size(); ++c)
        incidences_[next[static_cast<std::size_t>(wall_pairs_[c].sphere)]++] =
            static_cast<kernels::Incidence>(2 * (pairs_.size() + c));
}

void ContactList::forget_walls() {
    wall_pairs_.clear();
    wall_ranges_ = {0};
    shear_.resize(pairs_.size());
    touching_.resize(pairs_.size());
    force_.resize(pairs_.size());
    moment_.resize(pairs_.size());
    stale_ = true;
    index_incidences(offsets_.empty() ? 0 : offsets_.size() - 1);
}

bool ContactList::restore(std::int32_t i, std::int32_t j, const Vec3& shear) {
    std::size_t contact = size();
    if (j >= 0) {
        const kernels::Pair key{std::min(i, j), std::max(i, j)};
        const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), key);
        if (at != pairs_.end() && *at == key)
            contact = static_cast<std::size_t>(at - pairs_.begin());
    } else {
        const kernels::WallPair key{-1 - j, i};
        const auto at = std::lower_bound(wall_pairs_.begin(), wall_pairs_.end(), key);
        if (at != wall_pairs_.end() && *at == key)
            contact = pairs_.size() + static_cast<std::size_t>(at - wall_pairs_.begin());
    }
    if (contact == size()) return false;
    shear_[contact] = shear;
    touching_[contact] = 1;
    return true;
}

}  // namespace grainfield::core
