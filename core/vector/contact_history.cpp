#include "core/vector/contact_history.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "kernels/contact_law.hpp"

namespace grainfield::core {
namespace {

/// Contacts of a list that touch, those across a border in one of the two domains.
template <class T>
std::int64_t count_touching(const CandidateList<T>& list, const Domain<T>& domain) {
    std::int64_t count = 0;
    for (std::size_t k = 0; k < list.count(); ++k)
        count += list.touches(k) && domain.owns_record(list.first(k));
    return count;
}

}  // namespace

template <class T>
Vec3 ContactHistory<T>::present_position(std::size_t slot) const {
    return lists_.built().position[slot] + vec3(sample_.record(slot).u);
}

template <class T>
TouchingContact ContactHistory<T>::pair_contact(std::size_t d, std::size_t k) const {
    const Domain<T>& domain = sample_.domains[d];
    const CandidateList<T>& list = lists_.of(d).inner;
    const auto slot_a = static_cast<std::size_t>(domain.slot(list.first(k)));
    const auto slot_b = static_cast<std::size_t>(domain.slot(list.second(k)));
    const std::int32_t i = sample_.order.sphere[slot_a], j = sample_.order.sphere[slot_b];
    const ParticleStore& s = world_.spheres();
    const Vec3 branch = present_position(slot_b) - present_position(slot_a);
    const double distance = branch.norm(), reach = s.radius[i] + s.radius[j];
    const double kn =
        kernels::contact_stiffness(0.5 * reach, s.normal_stiffness[i], s.normal_stiffness[j]);
    const Vec3 shear = list.shear(k);
    const Vec3 force =
        -kn * std::max(0.0, reach - distance) / distance * branch + reach / distance * shear;
    return i < j ? TouchingContact{i, j, shear, force} : TouchingContact{j, i, -shear, -force};
}

template <class T>
TouchingContact ContactHistory<T>::wall_contact(const Domain<T>& domain, const WallList<T>& walls,
                                                std::size_t k) const {
    const auto slot = static_cast<std::size_t>(domain.slot(walls.list.first(k)));
    const std::int32_t i = sample_.order.sphere[slot];
    const ParticleStore& s = world_.spheres();
    const Wall& wall = world_.scene.walls[static_cast<std::size_t>(walls.wall)];
    const double overlap = s.radius[i] - wall.normal.dot(present_position(slot) - wall.point);
    const double kn =
        kernels::contact_stiffness(s.radius[i], s.normal_stiffness[i], wall.normal_stiffness);
    const Vec3 shear = walls.list.shear(k);
    return {i, -1 - walls.wall, shear, kn * std::max(0.0, overlap) * wall.normal + shear};
}

template <class T>
std::vector<TouchingContact> ContactHistory<T>::touching() const {
    std::vector<TouchingContact> pairs, walls;
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        const Domain<T>& domain = sample_.domains[d];
        const CandidateList<T>& inner = lists_.of(d).inner;
        for (std::size_t k = 0; k < inner.count(); ++k)
            if (inner.touches(k) && domain.owns_record(inner.first(k)))
                pairs.push_back(pair_contact(d, k));
        for (const WallList<T>& list : lists_.of(d).walls)
            for (std::size_t k = 0; k < list.list.count(); ++k)
                if (list.list.touches(k)) walls.push_back(wall_contact(domain, list, k));
    }
    std::sort(pairs.begin(), pairs.end(), [](const TouchingContact& x, const TouchingContact& y) {
        return std::tie(x.i, x.j) < std::tie(y.i, y.j);
    });
    std::sort(walls.begin(), walls.end(), [](const TouchingContact& x, const TouchingContact& y) {
        return std::tie(y.j, x.i) < std::tie(x.j, y.i);  // by wall, then by sphere
    });
    pairs.insert(pairs.end(), walls.begin(), walls.end());
    return pairs;
}

template <class T>
std::int64_t ContactHistory<T>::touching_count() const {
    std::int64_t count = 0;
    for (std::size_t d = 0; d < sample_.size(); ++d)
        count += count_touching(lists_.of(d).inner, sample_.domains[d]) + wall_count(d);
    return count;
}

template <class T>
std::int64_t ContactHistory<T>::wall_count(std::size_t d) const {
    std::int64_t count = 0;
    for (const WallList<T>& walls : lists_.of(d).walls)
        count += count_touching(walls.list, sample_.domains[d]);
    return count;
}

template <class T>
void ContactHistory<T>::clear_shear() {
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        DomainLists<T>& lists = lists_.of(d);
        std::fill(lists.inner.history.begin(), lists.inner.history.end(), T(0));
        for (WallList<T>& walls : lists.walls)
            std::fill(walls.list.history.begin(), walls.list.history.end(), T(0));
    }
}

/// Candidates of a list by their records.
template <class T>
class CandidateIndex {
  public:
    explicit CandidateIndex(CandidateList<T>& list) : list_(list) {
        for (std::size_t k = 0; k < list.count(); ++k)
            sorted_.push_back({list.first(k), list.second(k), k});
        std::sort(sorted_.begin(), sorted_.end());
    }
    /// False if the two are no candidates.
    bool set(std::int32_t a, std::int32_t b, const Vec3& on_a) {
        const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), Entry{a, b, 0});
        if (at == sorted_.end() || std::get<0>(*at) != a || std::get<1>(*at) != b) return false;
        const std::size_t k = std::get<2>(*at);
        for (std::size_t c = 0; c < 3; ++c)
            list_.shear(k, c) = static_cast<T>(on_a[static_cast<int>(c)]);
        list_.set_touching(k);
        return true;
    }

  private:
    using Entry = std::tuple<std::int32_t, std::int32_t, std::size_t>;
    CandidateList<T>& list_;
    std::vector<Entry> sorted_;
};

template <class T>
std::size_t ContactHistory<T>::restore(std::span<const ContactShear> contacts) {
    std::vector<std::int32_t> slot_of(world_.size());
    for (std::size_t slot = 0; slot < slot_of.size(); ++slot)
        slot_of[static_cast<std::size_t>(sample_.order.sphere[slot])] =
            static_cast<std::int32_t>(slot);
    std::vector<CandidateIndex<T>> pairs;
    std::vector<std::vector<CandidateIndex<T>>> walls(sample_.size());
    for (std::size_t d = 0; d < sample_.size(); ++d) {
        pairs.emplace_back(lists_.of(d).inner);
        for (WallList<T>& wall : lists_.of(d).walls) walls[d].emplace_back(wall.list);
    }
    const auto set_wall = [&](std::int32_t slot, std::int32_t wall, const Vec3& shear) {
        const std::size_t d = sample_.order.domain_of(slot);
        const std::int32_t record = sample_.domains[d].record(slot);
        for (std::size_t w = 0; w < walls[d].size(); ++w)
            if (lists_.of(d).walls[w].wall == wall) return walls[d][w].set(record, record, shear);
        return false;
    };
    const auto set_pair = [&](std::size_t d, std::int32_t low, std::int32_t high,
                              const Vec3& shear) {
        const Domain<T>& domain = sample_.domains[d];
        return domain.knows(low) && domain.knows(high) &&
               pairs[d].set(domain.record(low), domain.record(high), shear);
    };
    std::size_t found = 0;
    for (const auto& [i, j, shear] : contacts) {
        const std::int32_t slot_i = slot_of.at(static_cast<std::size_t>(i));
        if (j < 0) {
            found += set_wall(slot_i, -1 - j, shear);
            continue;
        }
        const std::int32_t slot_j = slot_of.at(static_cast<std::size_t>(j));
        const auto [low, high] = std::minmax({slot_i, slot_j});
        const Vec3 on_low = slot_i < slot_j ? shear : Vec3(-shear);
        // A contact across a border stands in both domains.
        const bool in_one = set_pair(sample_.order.domain_of(low), low, high, on_low);
        found += set_pair(sample_.order.domain_of(high), low, high, on_low) || in_one;
    }
    return found;
}

template class ContactHistory<float>;
template class ContactHistory<double>;

}  // namespace grainfield::core
